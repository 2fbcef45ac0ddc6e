// FCL's continuous collision in all its kinds, over their tolerances.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/narrow_fcl_types.h"
#include "tests/bench/precision_contact.h"
#include "tests/bench/precision_query.h"

namespace collision::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

fcl::Transform3d PoseOf(const MovingBody& body) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = fcl::Quaterniond(body.q[0], body.q[1], body.q[2], body.q[3]).toRotationMatrix();
  pose.translation() = fcl::Vector3d(body.p[0], body.p[1], body.p[2]);
  return pose;
}

Geometry SolidOf(const MovingBody& body) {
  if (body.kind == MovingBody::Kind::kBall) return std::make_shared<fcl::Sphered>(body.half[0]);
  return std::make_shared<fcl::Boxd>(2 * body.half[0], 2 * body.half[1], 2 * body.half[2]);
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

ContactReply Tell(const ContactCase& of, const Geometry& a, const Geometry& b,
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

void AddNaive(ContactMethods* methods) {
  for (const double error : {0.1, 0.03, 0.01, 1e-3, 1e-4}) {
    methods->push_back(Method("FCL naive", error, "what lies between two of its steps"));
    methods->back().make = [error](const ContactCase& of) -> std::function<ContactReply()> {
      const auto steps = static_cast<std::size_t>(std::ceil(1 / error));
      const fcl::ContinuousCollisionRequestd request(steps, error, fcl::CCDM_LINEAR,
                                                     fcl::GST_LIBCCD, fcl::CCDC_NAIVE);
      return
          [of, a = SolidOf(of.a), b = SolidOf(of.b), request] { return Tell(of, a, b, request); };
    };
  }
}

void AddAdvancement(const std::string& name, fcl::GJKSolverType solver, bool meshes,
                    ContactMethods* methods) {
  for (const double error : {1e-1, 1e-4, 1e-10}) {
    methods->push_back(
        Method(name, error, "its tolerance and its iterations; no bound of the error"));
    methods->back().may_not_end = true;
    methods->back().make = [=](const ContactCase& of) -> std::function<ContactReply()> {
      const bool ball =
          of.a.kind == MovingBody::Kind::kBall || of.b.kind == MovingBody::Kind::kBall;
      if (meshes && ball) return nullptr;
      const fcl::ContinuousCollisionRequestd request(10, error, fcl::CCDM_LINEAR, solver,
                                                     fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
      const auto shape = [&](const MovingBody& body) -> Geometry {
        if (meshes) return FclModel<fcl::OBBRSSd>(BoxMesh(body, {}));
        return SolidOf(body);
      };
      return [of, a = shape(of.a), b = shape(of.b), request] { return Tell(of, a, b, request); };
    };
  }
}

/// It reads vertices and not poses, and moves its models' vertices for good: each question needs
/// models of its own, made where the bodies start; these are counted in.
void AddPolynomial(ContactMethods* methods) {
  ContactMethod method;
  method.name = "FCL polynomial";
  method.limited_by = "plain doubles without a bound; translation of meshes only";
  method.make = [](const ContactCase& of) -> std::function<ContactReply()> {
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
  method.make = [](const ContactCase& of) -> std::function<ContactReply()> {
    if (Turns(of)) return nullptr;
    const fcl::ContinuousCollisionRequestd request(1000, 1e-8, fcl::CCDM_TRANS, fcl::GST_LIBCCD,
                                                   fcl::CCDC_RAY_SHOOTING);
    return [of, a = SolidOf(of.a), b = SolidOf(of.b), request] { return Tell(of, a, b, request); };
  };
  methods->push_back(std::move(method));
}

}  // namespace

ContactMethods FclContactMethods() {
  ContactMethods methods;
  AddNaive(&methods);
  AddAdvancement("FCL advancement, libccd", fcl::GST_LIBCCD, false, &methods);
  AddAdvancement("FCL advancement, own", fcl::GST_INDEP, false, &methods);
  AddAdvancement("FCL advancement, meshes", fcl::GST_LIBCCD, true, &methods);
  AddPolynomial(&methods);
  AddRayShooting(&methods);
  return methods;
}

}  // namespace collision::bench
