// Bodies that move with constant velocities, given by states at either end: for tests of when they
// touch.
#pragma once

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/contact/time_of_contact.h"
#include "tests/support/meshes.h"
#include "tests/support/solids.h"
#include "tests/support/truth/true_motion.h"

namespace collision {

using Eigen::Quaterniond;
using Eigen::Vector3d;

inline constexpr std::uint64_t kPlenty = 20'000'000;
inline constexpr double kPi = std::numbers::pi;

struct Body {
  std::shared_ptr<const shape::Shape> shape;
  double radius = 0;  // of a ball
  Vector3d p = Vector3d::Zero(), v = Vector3d::Zero(), w = Vector3d::Zero();
  Quaterniond q = Quaterniond::Identity();
  double acceleration_max = 0, angular_acceleration_max = 0;

  motion::SpaceTimeBound At(double seconds) const {
    motion::SpaceTimeBound bound;
    bound.state.stamp = Instant::FromNanoseconds(std::llround(seconds * 1e9));
    bound.state.p_WA = p + seconds * v;
    bound.state.v_WA = v;
    bound.state.w_WB = w;
    bound.state.q_WB = q;
    if (seconds != 0) {
      const Vector turned = static_cast<Real>(seconds) * w.cast<Real>();
      bound.state.q_WB = (Exponential(turned) * q.cast<Real>()).cast<double>();
    }
    bound.limits.radius = shape ? shape->facts().radius : radius;
    bound.limits.acceleration_max = acceleration_max;
    bound.limits.angular_acceleration_max = angular_acceleration_max;
    return bound;
  }
};

enum class Result { kAtStart, kAtEnd, kAtBoth };

inline narrow_phase::KnownMotion Known(const Body& body, double duration, Result states_at) {
  narrow_phase::KnownMotion known;
  known.shape = body.shape;
  if (states_at != Result::kAtEnd) known.last = body.At(0);
  if (states_at != Result::kAtStart) known.next = body.At(duration);
  return known;
}

inline narrow_phase::TimeOfContactResult Find(const Body& a, const Body& b, double duration,
                                              Result states_at = Result::kAtStart,
                                              narrow_phase::ContactTolerance tolerance = {},
                                              std::uint64_t units = kPlenty) {
  WorkBudget work(units);
  return TimeOfContact(Known(a, duration, states_at), Known(b, duration, states_at),
                       {Instant(), Instant::FromNanoseconds(std::llround(duration * 1e9))},
                       tolerance, &work);
}

// What rounding the states to doubles may have moved the true time by, as a share of it.
inline constexpr Real kStated = 4e-15L;

inline void ExpectWithin(numeric::Interval bracket, Real truth, double relative,
                         const char* which) {
  EXPECT_LE(bracket.lower, truth * (1 + kStated)) << which;
  EXPECT_GE(bracket.upper, truth * (1 - kStated)) << which;
  EXPECT_LE(bracket.width(), relative * static_cast<double>(truth)) << which;
}

inline void ExpectContact(const narrow_phase::TimeOfContactResult& found, Real begin, Real end,
                          double relative = 1e-12) {
  ASSERT_EQ(found.status, narrow_phase::ContactStatus::kContact);
  ExpectWithin(found.begin, begin, relative, "begin");
  ExpectWithin(found.end, end, relative, "end");
  EXPECT_EQ(found.limited_by, narrow_phase::BracketLimit::kNone);
  EXPECT_EQ(found.within, 0);
  EXPECT_GT(found.work, 0u);
}

/// What a box is made of: its motion is the same.
enum class Made {
  kTriangles,
  kSolid,   ///< A box.
  kHull,    ///< Of its corners.
  kSolids,  ///< Eight boxes.
  kMixed    ///< One half of triangles, one a box.
};

inline std::shared_ptr<const shape::Shape> BoxOf(Made made, const Vector3d& lower,
                                                 const Vector3d& upper) {
  const Vector3d middle = (lower + upper) / 2;
  if (made == Made::kTriangles) return shape::Shape::Build(Box(lower, upper));
  if (made == Made::kSolid) return shape::Shape::Compound(nullptr, {SolidBox(lower, upper)});
  if (made == Made::kHull) return shape::Shape::Compound(nullptr, {HullBox(lower, upper)});
  if (made == Made::kMixed) {
    const Vector3d top(upper.x(), upper.y(), middle.z()), bottom(lower.x(), lower.y(), middle.z());
    return shape::Shape::Compound(shape::Shape::Build(Box(lower, top)), {SolidBox(bottom, upper)});
  }
  std::vector<shape::ConvexSolid> solids;
  for (int i = 0; i < 8; ++i) {
    Vector3d low, high;
    for (int k = 0; k < 3; ++k) {
      low[k] = (i >> k & 1) != 0 ? middle[k] : lower[k];
      high[k] = (i >> k & 1) != 0 ? upper[k] : middle[k];
    }
    solids.push_back(SolidBox(low, high));
  }
  return shape::Shape::Compound(nullptr, std::move(solids));
}

inline std::shared_ptr<const shape::Shape> CubeOf(Made made, double half = 0.5) {
  return BoxOf(made, Vector3d::Constant(-half), Vector3d::Constant(half));
}

inline const auto& UnitCube() {
  static const auto cube = shape::Shape::Build(Cube(0.5));
  return cube;
}

inline Quaterniond Turn(double degrees, const Vector3d& axis) {
  return Quaterniond(Eigen::AngleAxisd(degrees * kPi / 180, axis));
}

// Everything turned by `turn` about the origin.
inline Body Turned(Body body, const Quaterniond& turn) {
  body.p = turn * body.p;
  body.v = turn * body.v;
  body.w = turn * body.w;
  body.q = turn * body.q;
  return body;
}

}  // namespace collision
