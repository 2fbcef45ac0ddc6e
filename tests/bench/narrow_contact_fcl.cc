// FCL's continuous collision: conservative advancement, and what it does by default.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <map>

#include "tests/bench/narrow_contact_case.h"
#include "tests/bench/narrow_fcl_types.h"

namespace collision::bench {
namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

fcl::Transform3d PoseOf(const MovingBody& body) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = fcl::Quaterniond(body.q[0], body.q[1], body.q[2], body.q[3]).toRotationMatrix();
  pose.translation() = fcl::Vector3d(body.p[0], body.p[1], body.p[2]);
  return pose;
}

/// Built once, kept for as long as it is asked again and again.
Geometry MeshOf(const std::shared_ptr<const PlainMesh>& mesh) {
  static std::map<std::shared_ptr<const PlainMesh>, Geometry> known;
  Geometry& geometry = known[mesh];
  if (!geometry) geometry = FclModel<fcl::OBBRSSd>(*mesh);
  return geometry;
}

Geometry GeometryOf(const MovingBody& body) {
  switch (body.kind) {
    case MovingBody::Kind::kBall:
      return std::make_shared<fcl::Sphered>(body.half[0]);
    case MovingBody::Kind::kBox:
      return std::make_shared<fcl::Boxd>(2 * body.half[0], 2 * body.half[1], 2 * body.half[2]);
    case MovingBody::Kind::kMesh:
      break;
  }
  return MeshOf(body.mesh);
}

std::optional<double> Tell(const ContactCase& of, fcl::CCDSolverType solver) {
  // Turns and moves evenly between the two poses, the shorter way round.
  const fcl::ContinuousCollisionRequestd request(10, 1e-4, fcl::CCDM_LINEAR, fcl::GST_LIBCCD,
                                                 solver);
  fcl::ContinuousCollisionResultd result;
  const Geometry a = GeometryOf(of.a), b = GeometryOf(of.b);
  const auto motion_a = FclMotion(PoseOf(of.a), PoseOf(of.a.After(of.duration)));
  const auto motion_b = FclMotion(PoseOf(of.b), PoseOf(of.b.After(of.duration)));
  fcl::continuousCollide(a.get(), &motion_a, b.get(), &motion_b, request, result);
  if (!result.is_collide) return std::nullopt;
  return result.time_of_contact * of.duration;
}

}  // namespace

std::vector<ContactLibrary> FclContact() {
  const auto teller = [](fcl::CCDSolverType solver) {
    return [solver](const ContactCase& of) { return Tell(of, solver); };
  };
  return {{"FCL advancement", teller(fcl::CCDC_CONSERVATIVE_ADVANCEMENT), MeshOf},
          {"FCL by default", teller(fcl::CCDC_NAIVE)}};
}

}  // namespace collision::bench
