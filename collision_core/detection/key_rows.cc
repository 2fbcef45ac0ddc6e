#include "collision_core/detection/key_rows.h"

#include <algorithm>
#include <limits>

namespace collision::detection {
namespace {

/// NaN, with which nothing is certain, if they are centuries apart.
double Seconds(Instant from, Instant to) {
  std::int64_t ns;
  if (__builtin_sub_overflow(to.nanoseconds(), from.nanoseconds(), &ns)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return 1e-9 * static_cast<double>(ns);
}

}  // namespace

void KeyRows::Put(std::uint32_t agent, const motion::SpaceTimeBound& bound) {
  if (rows_.size() <= agent) rows_.resize(agent + 1);
  Row& row = rows_[agent];
  const motion::MotionState& state = bound.state;
  const motion::AgentDeclaration& declaration = bound.declaration;
  row.p = state.p_WA;
  row.v = state.v_WA;
  row.speed = state.v_WA.norm();
  row.magnitude = state.p_WA.norm() + row.speed;
  row.reach = declaration.radius + state.position_error + row.speed * skew_;
  row.velocity_error = state.velocity_error;
  row.acceleration_max = declaration.acceleration_max;
  row.time_step = declaration.time_step;
  row.stamp = state.stamp;
}

// The centres' difference moves on a segment, which stays away from the origin by more than both
// can reach until then. Some thirty operations lose far less than 2^-40 of their terms; a stamp
// is given to the nanosecond.
bool KeyRows::CertainlyLater(std::uint32_t agent, std::uint32_t partner, Instant until) const {
  constexpr double kRoundings = 0x1p-40;
  const Row &a = rows_[agent], &b = rows_[partner];
  const Instant from = std::max(a.stamp, b.stamp);
  if (until <= from) return true;
  if (until.is_never()) return false;
  constexpr double kStampRounding = 1e-8;
  double reach = 0, magnitude = 0;
  for (const Row* row : {&a, &b}) {
    const double tau = Seconds(row->stamp, until) + skew_;
    reach += row->reach + row->velocity_error * tau +
             row->acceleration_max * tau * (tau + row->time_step) / 2;
    magnitude += row->magnitude + row->speed * tau;
  }
  const Eigen::Vector3d w = b.v - a.v;
  const Eigen::Vector3d d =
      (b.p + b.v * Seconds(b.stamp, from)) - (a.p + a.v * Seconds(a.stamp, from));
  const double duration = Seconds(from, until);
  const double nearest = std::clamp(-d.dot(w) / std::max(w.squaredNorm(), 1e-300), 0.0, duration);
  const double margin = kRoundings * (magnitude + reach) + kStampRounding * (w.norm() + 1);
  return (d + w * nearest).norm() > reach + margin;
}

}  // namespace collision::detection
