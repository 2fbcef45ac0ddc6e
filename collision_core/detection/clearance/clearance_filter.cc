#include "collision_core/detection/clearance/clearance_filter.h"

#include <algorithm>
#include <limits>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// More than what thirty roundings lose, as a part of their terms.
constexpr double kRoundings = 0x1p-40;
/// Several times the nanosecond that a stamp may be off, with room for their sum [s].
constexpr double kStampRounding = 1e-8;
/// In place of a relative speed of 0, so that a quotient stays finite or is clamped.
constexpr double kSquareLeast = 1e-300;

/// NaN, with which nothing is certain, if they are centuries apart.
double Seconds(Instant from, Instant to) {
  std::int64_t ns;
  if (__builtin_sub_overflow(to.nanoseconds(), from.nanoseconds(), &ns)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return numeric::kNanosecond * static_cast<double>(ns);
}

}  // namespace

void ClearanceFilter::Set(AgentIndex agent, const motion::SpaceTimeBound& bound) {
  if (!rows_.contains(agent)) rows_.resize(agent.value() + 1);
  Row& row = rows_[agent];
  const motion::MotionState& state = bound.state;
  const motion::MotionLimits& limits = bound.limits;
  row.p = state.p_WA;
  row.v = state.v_WA;
  row.speed = state.v_WA.norm();
  row.magnitude = state.p_WA.norm() + row.speed;
  row.reach = limits.radius + state.position_error + row.speed * skew_;
  row.velocity_error = state.velocity_error;
  row.acceleration_max = limits.acceleration_max;
  row.time_step = limits.time_step;
  row.stamp = state.stamp;
  row.bends = Bends(bound);
  row.a = state.a_WA;
  row.jerk_max = limits.jerk_max;
  row.known_rate = row.bends ? state.a_WA.norm() * (skew_ + 0.5 * limits.time_step) : 0;
}

void ClearanceFilter::SetEndless(AgentIndex agent) {
  Set(agent, {});
  rows_[agent].reach = numeric::kInfinity;
}

bool ClearanceFilter::CertainlyLater(AgentIndex agent, AgentIndex partner, Instant until) const {
  const Row &a = rows_.at(agent), &b = rows_.at(partner);
  const Instant from = std::max(a.stamp, b.stamp);
  if (until <= from) return true;
  if (until.is_never()) return false;
  double reach = 0, magnitude = 0;
  for (const Row* row : {&a, &b}) {
    const double tau = Seconds(row->stamp, until) + skew_;
    reach += row->reach + row->velocity_error * tau +
             row->acceleration_max * tau * (tau + row->time_step) / 2;
    magnitude += row->magnitude + row->speed * tau;
    if (row->bends) {
      const double h = row->time_step, known = row->a.norm() * tau;
      reach += row->known_rate * tau + row->jerk_max * tau * (tau * tau + 3 * h * (tau + h)) / 6;
      magnitude += known * (1 + tau);
    }
  }
  Eigen::Vector3d w = b.v - a.v;
  const double since_B = Seconds(b.stamp, from), since_A = Seconds(a.stamp, from);
  Eigen::Vector3d d = (b.p + b.v * since_B) - (a.p + a.v * since_A);
  const double duration = Seconds(from, until);
  if (a.bends || b.bends) {
    w += b.a * since_B - a.a * since_A;
    d += 0.5 * (b.a * (since_B * since_B) - a.a * (since_A * since_A));
    reach += 0.5 * (b.a - a.a).norm() * duration * duration;
  }
  const double nearest =
      std::clamp(-d.dot(w) / std::max(w.squaredNorm(), kSquareLeast), 0.0, duration);
  const double margin = kRoundings * (magnitude + reach) + kStampRounding * (w.norm() + 1);
  return (d + w * nearest).norm() > reach + margin;
}

}  // namespace collision::detection
