#include "client/programs/tools/suggest_bounds/bounds_estimate.h"

#include <algorithm>
#include <cmath>

#include "client/library/vector.h"
#include "client/programs/simulators/player/known_acceleration.h"
#include "client/programs/simulators/player/trajectory.h"

namespace collision::client {
namespace {

/// More than the roundings of what is computed here.
constexpr double kRoundedUp = 1 + 1e-9;

double PieceSeconds(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

/// The least of the values that a share of `quantile` of them does not exceed.
double QuantileOf(std::vector<double> values, double quantile) {
  if (values.empty()) return 0;
  const double rank = std::ceil(quantile * static_cast<double>(values.size())) - 1;
  const auto at =
      static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// What each piece between two samples needs.
struct Needs {
  std::vector<double> acceleration, deviation, jerk, speed, angular_acceleration;
};

/// The least α with which the orientation and the angular velocity of the second sample can follow
/// from the first: Φ(q', exp(ω s) q) <= ½ α s² and |ω' − ω| <= α s.
double AngularNeed(const MotionSample& from, const MotionSample& to) {
  const double s = PieceSeconds(from.stamp_ns, to.stamp_ns);
  const double rate = Norm(from.angular_velocity_rad_s), half = rate * s / 2;
  const Vector3 axis = Scaled(from.angular_velocity_rad_s, rate > 0 ? std::sin(half) / rate : 0);
  const Quaternion turned = Product({std::cos(half), axis[0], axis[1], axis[2]}, from.orientation);
  const Quaternion& q = to.orientation;
  const Quaternion off = Product(turned, {q[0], -q[1], -q[2], -q[3]});
  const double angle = 2 * std::atan2(Norm({off[1], off[2], off[3]}), std::fabs(off[0]));
  const double change = Norm(Difference(to.angular_velocity_rad_s, from.angular_velocity_rad_s));
  return std::max(2 * angle / (s * s), change / s);
}

bool Turns(const SampledAgent& agent) {
  return std::ranges::any_of(agent.samples, [&](const MotionSample& sample) {
    return sample.orientation != agent.samples.front().orientation ||
           sample.angular_velocity_rad_s != Vector3{};
  });
}

/// The samples up to the next discontinuity as one curve.
void AddCurve(std::vector<CsvRow> rows, bool has_velocities, Needs* needs) {
  const Trajectory curve(std::move(rows), has_velocities, 0);
  const KnownAcceleration known(curve);
  const std::vector<CsvRow>& knots = curve.rows();
  for (const CsvRow& knot : knots) needs->speed.push_back(Norm(knot.velocity_m_s));
  for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
    const PieceAcceleration on = curve.AccelerationOn(i);
    const double h = PieceSeconds(knots[i].time_ns, knots[i + 1].time_ns);
    const double most = std::max(Norm(on.first_m_s2), Norm(on.last_m_s2));
    needs->acceleration.push_back(most * kRoundedUp + on.rounding_m_s2);
    const PieceAcceleration before = curve.AccelerationOn(i == 0 ? 0 : i - 1);
    const Vector3& left = i == 0 ? on.first_m_s2 : before.last_m_s2;
    needs->deviation.push_back(Norm(Difference(on.first_m_s2, left)) / 2 + (kRoundedUp - 1) * most +
                               std::max(on.rounding_m_s2, before.rounding_m_s2));
    const Vector3 slope = Difference(known.At(knots[i + 1].time_ns), known.At(knots[i].time_ns));
    needs->jerk.push_back(Norm(slope) / h * kRoundedUp);
    // A quadratic velocity strays from the chord between its ends by |v''| h²/8.
    const double ends = std::max(Norm(knots[i].velocity_m_s), Norm(knots[i + 1].velocity_m_s));
    const double bend = Norm(Difference(on.last_m_s2, on.first_m_s2)) * h / 8;
    needs->speed.push_back((ends + bend) * kRoundedUp);
  }
}

Needs NeedsOf(const SampledAgent& agent) {
  Needs needs;
  const bool turns = Turns(agent);
  std::vector<CsvRow> rows;
  for (std::size_t i = 0; i < agent.samples.size(); ++i) {
    const MotionSample& sample = agent.samples[i];
    if (sample.discontinuity && !rows.empty()) {
      AddCurve(std::move(rows), agent.has_velocities, &needs);
      rows.clear();
    } else if (turns && i > 0) {
      needs.angular_acceleration.push_back(AngularNeed(agent.samples[i - 1], sample));
    }
    rows.push_back({sample.stamp_ns, sample.position_m, sample.velocity_m_s, 0});
  }
  if (!rows.empty()) AddCurve(std::move(rows), agent.has_velocities, &needs);
  return needs;
}

}  // namespace

SuggestedBounds SuggestBounds(const SampledAgent& agent, const BoundsRequest& request) {
  const Needs needs = NeedsOf(agent);
  SuggestedBounds bounds;
  bounds.simulator = agent.simulator;
  bounds.name = agent.name;
  bounds.samples = agent.samples.size();
  bounds.pieces = needs.acceleration.size();
  bounds.declared = agent.declared;
  bounds.is_proof = request.is_curve && request.quantile >= 1;
  const double margin = bounds.is_proof ? 1 : 1 + request.margin;
  const auto of = [&](const std::vector<double>& values) {
    return margin * QuantileOf(values, request.quantile);
  };
  bounds.acceleration_max_m_s2 = of(needs.acceleration);
  bounds.deviation_max_m_s2 = of(needs.deviation);
  bounds.jerk_max_m_s3 = of(needs.jerk);
  bounds.speed_max_m_s = of(needs.speed);
  if (!needs.angular_acceleration.empty()) {
    bounds.angular_acceleration_max_rad_s2 = of(needs.angular_acceleration);
  }
  bounds.known_is_narrower =
      ReachAfter(request.look_ahead_s, bounds.deviation_max_m_s2, bounds.jerk_max_m_s3) <
      ReachAfter(request.look_ahead_s, bounds.acceleration_max_m_s2, 0);
  return bounds;
}

SuggestedBounds GreatestOf(const std::vector<SuggestedBounds>& all, double look_ahead_s) {
  SuggestedBounds greatest = all.front();
  greatest.simulator = greatest.name = "";
  greatest.declared.reset();
  greatest.samples = greatest.pieces = 0;
  for (const SuggestedBounds& one : all) {
    greatest.samples += one.samples;
    greatest.pieces += one.pieces;
    const auto raise = [](double value, double* most) { *most = std::max(*most, value); };
    raise(one.acceleration_max_m_s2, &greatest.acceleration_max_m_s2);
    raise(one.deviation_max_m_s2, &greatest.deviation_max_m_s2);
    raise(one.jerk_max_m_s3, &greatest.jerk_max_m_s3);
    raise(one.speed_max_m_s, &greatest.speed_max_m_s);
    if (!one.angular_acceleration_max_rad_s2) continue;
    greatest.angular_acceleration_max_rad_s2 = std::max(
        greatest.angular_acceleration_max_rad_s2.value_or(0), *one.angular_acceleration_max_rad_s2);
  }
  greatest.known_is_narrower =
      ReachAfter(look_ahead_s, greatest.deviation_max_m_s2, greatest.jerk_max_m_s3) <
      ReachAfter(look_ahead_s, greatest.acceleration_max_m_s2, 0);
  return greatest;
}

}  // namespace collision::client
