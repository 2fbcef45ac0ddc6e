#include "collision/shape.h"

#include "client/c/given.h"
#include "client/c/guard.h"
#include "collision/collision.h"

using namespace collision::client;
using c::Guarded;
using c::Require;

void collision_geometry_init(collision_geometry* geometry, size_t size) {
  c::Initialize(c::DefaultGeometry(), geometry, size);
}

collision_result collision_shape_create(const collision_geometry* geometry,
                                        collision_shape** shape) {
  return Guarded([&] {
    Require("shape", shape);
    *shape = new collision_shape{
        Shape::Make(c::FromC(c::Given("geometry", c::DefaultGeometry(), geometry)))};
    return COLLISION_OK;
  });
}

void collision_shape_destroy(collision_shape* shape) { delete shape; }

double collision_shape_radius_m(const collision_shape* shape) {
  return shape == nullptr ? 0 : shape->shape->radius_m();
}

int collision_shape_closed(const collision_shape* shape) {
  return shape != nullptr && shape->shape->closed() ? 1 : 0;
}
