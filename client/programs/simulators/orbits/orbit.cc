#include "client/programs/simulators/orbits/orbit.h"

#include <algorithm>
#include <cmath>

#include "client/library/vector.h"

namespace collision::client {
namespace {

// What is computed from a few doubles is rounded up by far more than they can err.
constexpr double kBoundMargin = 1e-9;

constexpr int kDefectSteps = 8;

double StepSeconds(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

PositionAndVelocity Moved(const PositionAndVelocity& from, const Vector3& velocity,
                          const Vector3& acceleration, double seconds) {
  return {Sum(from.position_m, Scaled(velocity, seconds)),
          Sum(from.velocity_m_s, Scaled(acceleration, seconds))};
}

std::vector<CsvRow> Nodes(PositionAndVelocity at, std::int64_t begin_ns, std::int64_t end_ns,
                          double step_s) {
  const double steps_needed = std::ceil(StepSeconds(begin_ns, end_ns) / step_s);
  const auto steps = std::max<std::int64_t>(1, std::llround(steps_needed));
  std::vector<CsvRow> nodes = {{begin_ns, at.position_m, at.velocity_m_s, 0}};
  for (std::int64_t i = 1; i <= steps; ++i) {
    const std::int64_t stamp_ns = i == steps ? end_ns : begin_ns + (end_ns - begin_ns) / steps * i;
    at = Integrated(at, StepSeconds(nodes.back().time_ns, stamp_ns));
    nodes.push_back({stamp_ns, at.position_m, at.velocity_m_s, 0});
  }
  return nodes;
}

PathExtent ExtentOf(const CsvRow& from, const CsvRow& to, const PieceAcceleration& on) {
  const double h = StepSeconds(from.time_ns, to.time_ns);
  const double r0 = Norm(from.position_m), r1 = Norm(to.position_m);
  PathExtent extent;
  extent.acceleration_max_m_s2 = std::max(Norm(on.first_m_s2), Norm(on.last_m_s2));
  const double bend = extent.acceleration_max_m_s2 * h * h / 8;
  const double chord = Norm(Difference(to.position_m, from.position_m)) / 2;
  const double nearest = std::min(r0, r1);
  extent.radius_min_m = std::sqrt(nearest * nearest - chord * chord) - bend;
  extent.speed_max_m_s = std::max(Norm(from.velocity_m_s), Norm(to.velocity_m_s)) +
                         Norm(Difference(on.last_m_s2, on.first_m_s2)) * h / 8;
  const double climbing = std::max(std::fabs(Dot(from.position_m, from.velocity_m_s)),
                                   std::fabs(Dot(to.position_m, to.velocity_m_s)));
  const double turning = extent.speed_max_m_s * extent.speed_max_m_s +
                         (std::max(r0, r1) + bend) * extent.acceleration_max_m_s2;
  extent.climb_max_m_s = (climbing + turning * h / 2) / extent.radius_min_m;
  return extent;
}

PathExtent Joined(const PathExtent& a, const PathExtent& b) {
  return {std::min(a.radius_min_m, b.radius_min_m), std::max(a.speed_max_m_s, b.speed_max_m_s),
          std::max(a.climb_max_m_s, b.climb_max_m_s),
          std::max(a.acceleration_max_m_s2, b.acceleration_max_m_s2)};
}

/// The greatest |H'' − g(H)| at the ends of `kDefectSteps` equal parts of the piece.
double DefectOn(const MotionPiece& piece, const PieceAcceleration& on) {
  double defect = 0;
  for (int k = 0; k <= kDefectSteps; ++k) {
    const std::int64_t stamp_ns = piece.t0_ns + (piece.t1_ns - piece.t0_ns) * k / kDefectSteps;
    const double share = StepSeconds(piece.t0_ns, stamp_ns) / StepSeconds(piece.t0_ns, piece.t1_ns);
    const Vector3 bend = Sum(Scaled(on.first_m_s2, 1 - share), Scaled(on.last_m_s2, share));
    defect =
        std::max(defect, Norm(Difference(bend, Gravity(Evaluate(piece, stamp_ns).position_m))));
  }
  return defect + on.rounding_m_s2;
}

}  // namespace

PositionAndVelocity Integrated(const PositionAndVelocity& from, double seconds) {
  const Vector3 v1 = from.velocity_m_s, a1 = Gravity(from.position_m);
  const PositionAndVelocity second = Moved(from, v1, a1, seconds / 2);
  const Vector3 v2 = second.velocity_m_s, a2 = Gravity(second.position_m);
  const PositionAndVelocity third = Moved(from, v2, a2, seconds / 2);
  const Vector3 v3 = third.velocity_m_s, a3 = Gravity(third.position_m);
  const PositionAndVelocity fourth = Moved(from, v3, a3, seconds);
  const Vector3 v4 = fourth.velocity_m_s, a4 = Gravity(fourth.position_m);
  const auto mean = [](const Vector3& k1, const Vector3& k2, const Vector3& k3, const Vector3& k4) {
    return Scaled(Sum(Sum(k1, k4), Scaled(Sum(k2, k3), 2)), 1.0 / 6);
  };
  return Moved(from, mean(v1, v2, v3, v4), mean(a1, a2, a3, a4), seconds);
}

PositionAndVelocity Integrated(PositionAndVelocity from, double seconds, double step_s) {
  const double steps = std::ceil(std::fabs(seconds) / step_s);
  for (double i = 0; i < steps; ++i) from = Integrated(from, seconds / steps);
  return from;
}

Orbit::Orbit(const PositionAndVelocity& at_begin, std::int64_t begin_ns, std::int64_t end_ns,
             double step_s)
    : curve_(Nodes(at_begin, begin_ns, end_ns, step_s), true, 0),
      acceleration_max_m_s2_(curve_.AccelerationMax()) {
  PathExtent extent;
  double defect = 0, longest = 0;
  for (std::size_t i = 0; i < curve_.pieces().size(); ++i) {
    const CsvRow &from = curve_.rows()[i], &to = curve_.rows()[i + 1];
    const PieceAcceleration on = curve_.AccelerationOn(i);
    const PathExtent piece = ExtentOf(from, to, on);
    extent = i == 0 ? piece : Joined(extent, piece);
    defect = std::max(defect, DefectOn(curve_.pieces()[i], on));
    longest = std::max(longest, StepSeconds(from.time_ns, to.time_ns) / kDefectSteps);
  }
  longest += 1e-9;  // stamps are whole nanoseconds
  jerk_max_m_s3_ = GravityRateMax(extent) * (1 + kBoundMargin);
  deviation_max_m_s2_ = defect + GravityRateRateMax(extent) * longest * longest / 8 +
                        kBoundMargin * acceleration_max_m_s2_;
}

}  // namespace collision::client
