// FCL's continuous collision in all its kinds, over their tolerances.
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/bench/pairs/peers.h"
#include "tests/bench/peers/fcl_types.h"

namespace collision::bench {
namespace {

fcl::Transform3d PoseOf(const MovingBody& body) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = fcl::Quaterniond(body.q[0], body.q[1], body.q[2], body.q[3]).toRotationMatrix();
  pose.translation() = fcl::Vector3d(body.p[0], body.p[1], body.p[2]);
  return pose;
}

/// Even motion between two poses. Given only these, version 0.7 turns bodies about a point that it
/// never sets; so it is set here.
fcl::InterpMotion<double> FclMotion(const fcl::Transform3d& begin, const fcl::Transform3d& end) {
  const fcl::Vector3d origin(0, 0, 0);
  return {begin.linear(), begin.translation(), end.linear(), end.translation(), origin};
}

/// A ball or a box; null for a mesh.
FclGeometry SolidOf(const MovingBody& body) {
  switch (body.kind) {
    case MovingBody::Kind::kBall:
      return std::make_shared<fcl::Sphered>(body.half[0]);
    case MovingBody::Kind::kBox:
      return FclBox(body.half);
    case MovingBody::Kind::kMesh:
      break;
  }
  return nullptr;
}

/// A mesh is built once, and kept for all queries about it.
FclGeometry BodyOf(const MovingBody& body) {
  if (body.kind != MovingBody::Kind::kMesh) return SolidOf(body);
  static std::map<std::shared_ptr<const PlainMesh>, FclGeometry> known;
  FclGeometry& geometry = known[body.mesh];
  if (!geometry) geometry = FclModel<fcl::OBBRSSd>(*body.mesh);
  return geometry;
}

PlainMesh BoxMesh(const MovingBody& body, const std::array<double, 3>& at) {
  PlainMesh mesh;
  for (int i = 0; i < 8; ++i) {
    std::array<double, 3> corner;
    for (int k = 0; k < 3; ++k) corner[k] = at[k] + (i >> k & 1 ? body.half[k] : -body.half[k]);
    mesh.vertices.push_back(corner);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

ContactReply Tell(const ContactCase& of, const FclGeometry& a, const FclGeometry& b,
                  const fcl::ContinuousCollisionRequestd& request) {
  fcl::ContinuousCollisionResultd result;
  const fcl::Transform3d begin_a = PoseOf(of.a), end_a = PoseOf(of.a.After(of.duration));
  const fcl::Transform3d begin_b = PoseOf(of.b), end_b = PoseOf(of.b.After(of.duration));
  if (request.ccd_motion_type == fcl::CCDM_LINEAR) {
    const auto motion_a = FclMotion(begin_a, end_a), motion_b = FclMotion(begin_b, end_b);
    fcl::continuousCollide(a.get(), &motion_a, b.get(), &motion_b, request, result);
  } else {
    fcl::continuousCollide(a.get(), begin_a, end_a, b.get(), begin_b, end_b, request, result);
  }
  if (!result.is_collide) return {};
  return Plainly(result.time_of_contact * of.duration);
}

bool Turns(const ContactCase& of) {
  const auto turns = [](const MovingBody& body) {
    return body.w != std::array<double, 3>{} || body.q != std::array<double, 4>{1, 0, 0, 0};
  };
  return turns(of.a) || turns(of.b);
}

ContactMethod Method(const std::string& name, double tolerance, const char* limited_by) {
  ContactMethod method;
  method.name = name;
  method.setting = SettingText("tolerance", tolerance, "");
  method.limited_by = limited_by;
  return method;
}

using BuildBody = FclGeometry (*)(const MovingBody&);

/// Bodies that turn and move evenly between two poses, the shorter way round.
std::function<ContactQuery(const ContactCase&)> Evenly(std::size_t iterations, double error,
                                                       fcl::GJKSolverType solver,
                                                       fcl::CCDSolverType kind, BuildBody build) {
  const fcl::ContinuousCollisionRequestd request(iterations, error, fcl::CCDM_LINEAR, solver, kind);
  return [request, build](const ContactCase& of) -> ContactQuery {
    const FclGeometry a = build(of.a), b = build(of.b);
    if (!a || !b) return nullptr;
    return [of, a, b, request] { return Tell(of, a, b, request); };
  };
}

void AddNaive(ContactMethods* methods) {
  for (const double error : {0.1, 0.03, 0.01, 1e-3, 1e-4}) {
    methods->push_back(Method("FCL naive", error, "what lies between two of its steps"));
    methods->back().make = Evenly(static_cast<std::size_t>(std::ceil(1 / error)), error,
                                  fcl::GST_LIBCCD, fcl::CCDC_NAIVE, SolidOf);
  }
}

/// Boxes only.
FclGeometry MeshOf(const MovingBody& body) {
  if (body.kind != MovingBody::Kind::kBox) return nullptr;
  return FclModel<fcl::OBBRSSd>(BoxMesh(body, {}));
}

void AddAdvancement(const std::string& name, fcl::GJKSolverType solver, BuildBody build,
                    ContactMethods* methods) {
  for (const double error : {1e-1, 1e-4, 1e-10}) {
    methods->push_back(
        Method(name, error, "its tolerance and its iterations; no bound of the error"));
    methods->back().may_not_end = true;
    methods->back().make = Evenly(10, error, solver, fcl::CCDC_CONSERVATIVE_ADVANCEMENT, build);
  }
}

/// It reads vertices and not poses, and moves its models' vertices for good: each query needs
/// models of its own, made where the bodies start; these are counted in.
void AddPolynomial(ContactMethods* methods) {
  ContactMethod method;
  method.name = "FCL polynomial";
  method.limited_by = "plain doubles without a bound; translation of meshes only";
  method.make = [](const ContactCase& of) -> ContactQuery {
    if (Turns(of) || of.a.kind != MovingBody::Kind::kBox || of.b.kind != MovingBody::Kind::kBox) {
      return nullptr;
    }
    return [of] {
      const fcl::ContinuousCollisionRequestd request(1000, 1e-8, fcl::CCDM_TRANS, fcl::GST_LIBCCD,
                                                     fcl::CCDC_POLYNOMIAL_SOLVER);
      ContactCase shifted = of;
      shifted.a.p = shifted.b.p = {};
      return Tell(shifted, FclModel<fcl::OBBRSSd>(BoxMesh(of.a, of.a.p)),
                  FclModel<fcl::OBBRSSd>(BoxMesh(of.b, of.b.p)), request);
    };
  };
  methods->push_back(std::move(method));
}

void AddRayShooting(ContactMethods* methods) {
  ContactMethod method;
  method.name = "FCL ray shooting";
  method.limited_by = "not written in version 0.7: always no";
  method.make = [](const ContactCase& of) -> ContactQuery {
    if (Turns(of)) return nullptr;
    const fcl::ContinuousCollisionRequestd request(1000, 1e-8, fcl::CCDM_TRANS, fcl::GST_LIBCCD,
                                                   fcl::CCDC_RAY_SHOOTING);
    return [of, a = SolidOf(of.a), b = SolidOf(of.b), request] { return Tell(of, a, b, request); };
  };
  methods->push_back(std::move(method));
}

}  // namespace

ContactMethods FclContact() {
  ContactMethod advancement, by_default;
  advancement.name = "FCL advancement";
  advancement.make = Evenly(10, 1e-4, fcl::GST_LIBCCD, fcl::CCDC_CONSERVATIVE_ADVANCEMENT, BodyOf);
  by_default.name = "FCL by default";
  by_default.make = Evenly(10, 1e-4, fcl::GST_LIBCCD, fcl::CCDC_NAIVE, SolidOf);
  return {advancement, by_default};
}

ContactMethods FclContactCurves() {
  ContactMethods methods;
  AddNaive(&methods);
  AddAdvancement("FCL advancement, libccd", fcl::GST_LIBCCD, SolidOf, &methods);
  AddAdvancement("FCL advancement, own", fcl::GST_INDEP, SolidOf, &methods);
  AddAdvancement("FCL advancement, meshes", fcl::GST_LIBCCD, MeshOf, &methods);
  AddPolynomial(&methods);
  AddRayShooting(&methods);
  return methods;
}

}  // namespace collision::bench
