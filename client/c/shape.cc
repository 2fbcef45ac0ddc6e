#include "collision/shape.h"

#include "client/c/given.h"
#include "client/c/guard.h"
#include "collision/collision.h"

using namespace collision::client;
using c::Guarded;
using c::Require;

collision_result collision_shape_create(const double* vertices_m, size_t vertices,
                                        const uint32_t* indices, size_t triangles,
                                        const collision_solid* solids, size_t solids_count,
                                        collision_shape** shape) {
  return Guarded([&] {
    Require("shape", shape);
    if (vertices > 0) Require("vertices_m", vertices_m);
    if (triangles > 0) Require("indices", indices);
    if (solids_count > 0) Require("solids", solids);
    Geometry geometry;
    for (std::size_t i = 0; i < vertices; ++i) {
      const double* vertex = vertices_m + 3 * i;
      geometry.triangles.vertices_m.push_back({vertex[0], vertex[1], vertex[2]});
    }
    for (std::size_t i = 0; i < triangles; ++i) {
      const std::uint32_t* corners = indices + 3 * i;
      geometry.triangles.indices.push_back({corners[0], corners[1], corners[2]});
    }
    for (std::size_t i = 0; i < solids_count; ++i) geometry.solids.push_back(c::FromC(solids[i]));
    *shape = new collision_shape{Shape::Make(std::move(geometry))};
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
