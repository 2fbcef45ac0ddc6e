#include "tests/bench/narrow_contact_ours.h"

#include <cmath>

#include "tests/collision_core/sphere_tree/meshes.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kPlenty = 400'000'000;

Eigen::Vector3d VectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

geometry::TriangleMesh MeshOf(const MovingBody& body) {
  if (body.kind == MovingBody::Kind::kBox) return Box(-VectorOf(body.half), VectorOf(body.half));
  geometry::TriangleMesh mesh;
  for (const auto& p : body.mesh->vertices) mesh.vertices.push_back(VectorOf(p));
  mesh.triangles = body.mesh->triangles;
  return mesh;
}

motion::SpaceTimeBound BoundOf(const MovingBody& body, double at,
                               std::shared_ptr<const shape::Shape> shape) {
  motion::SpaceTimeBound bound;
  bound.state.stamp = Instant::FromNanoseconds(std::llround(at * 1e9));
  bound.state.p_WA = VectorOf(body.p);
  bound.state.v_WA = VectorOf(body.v);
  bound.state.w_WB = VectorOf(body.w);
  bound.state.q_WB = Eigen::Quaterniond(body.q[0], body.q[1], body.q[2], body.q[3]);
  bound.declaration.radius = shape ? shape->facts().radius : body.half[0];
  bound.declaration.shape = std::move(shape);
  bound.declaration.angular_acceleration_max = 0;
  return bound;
}

narrow_phase::KnownMotion MotionOf(const MovingBody& body, const ContactCase& of,
                                   const std::shared_ptr<const shape::Shape>& shape) {
  narrow_phase::KnownMotion motion;
  motion.last = BoundOf(body, 0, shape);
  if (of.both_ends) motion.next = BoundOf(body.After(of.duration), of.duration, shape);
  return motion;
}

}  // namespace

std::shared_ptr<const shape::Shape> ShapeOf(const MovingBody& body) {
  if (body.kind == MovingBody::Kind::kBall) return nullptr;
  return shape::Shape::Build(MeshOf(body), {.builder = sphere_tree::TreeBuilder::kFitted});
}

narrow_phase::TimeOfContactResult OurContact(const ContactCase& of, const ContactShapes& shapes,
                                             const narrow_phase::ContactTolerance& tolerance) {
  WorkBudget work(kPlenty);
  return TimeOfContact(MotionOf(of.a, of, shapes.a), MotionOf(of.b, of, shapes.b), Instant(),
                       Instant::FromNanoseconds(std::llround(of.duration * 1e9)), tolerance, &work);
}

}  // namespace collision::bench
