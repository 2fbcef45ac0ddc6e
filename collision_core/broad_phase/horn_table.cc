#include "collision_core/broad_phase/horn_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace collision {
namespace {

// Each value below is a sum or product of fewer than sixteen terms of one sign, so that rounding
// takes less than 16 · 2^-53 of it.
constexpr double kOutward = 1 + 0x1p-48;

// Beyond these, squares and products leave the range of doubles (and of single precision).
constexpr double kPositionMax = 0x1p+60;
constexpr double kRateMax = 0x1p+40;

// Positions, of which the lines of horns are sums, are off by less than this part of them.
constexpr double kLineRounding = 0x1p-48;

constexpr int kTangentsMax = 6;

double Length(const double* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

double Seconds(Instant from, Instant to) {
  return static_cast<double>(to.nanoseconds() - from.nanoseconds()) * 1e-9;
}

}  // namespace

void HornTable::Put(std::uint32_t agent, const SpaceTimeBound& bound) {
  if (rows_.size() <= agent) {
    rows_.resize(agent + 1);
    bounds_.resize(agent + 1);
  }
  HornRow& row = rows_[agent];
  count_ += !bounds_[agent];
  wild_count_ -= row.wild;
  bounds_[agent] = bound;
  const MotionState& state = bound.state;
  const AgentDeclaration& declaration = bound.declaration;
  for (int axis = 0; axis < 3; ++axis) {
    row.p[axis] = state.p_WA[axis];
    row.v[axis] = state.v_WA[axis];
  }
  const double speed = Length(row.v), half = 0.5 * declaration.acceleration_max;
  const double skew = bound.skew, step = declaration.time_step;
  row.u0 = kOutward * (declaration.radius + state.position_error + speed * skew +
                       state.velocity_error * skew + half * skew * (skew + step));
  row.u1 = kOutward * (state.velocity_error + half * (2 * skew + step));
  row.u2 = kOutward * half;
  row.stamp = state.stamp;
  row.group = declaration.group;
  row.mask = declaration.mask;
  row.still = NeverMoves(bound);
  const double farthest =
      std::max({std::abs(row.p[0]), std::abs(row.p[1]), std::abs(row.p[2]), row.u0});
  row.wild = !(farthest < kPositionMax && speed < kRateMax && row.u1 < kRateMax &&
               row.u2 < kRateMax && Near(row.stamp));
  wild_count_ += row.wild;
  // A group of no bits meets nobody, and is not the mark of a free row.
  if (row.group == 0) row.group = 1, row.mask = 0;
}

void HornTable::Remove(std::uint32_t agent) {
  if (!contains(agent)) return;
  wild_count_ -= rows_[agent].wild;
  rows_[agent] = HornRow();
  bounds_[agent].reset();
  --count_;
}

HornAt HornTable::At(std::uint32_t agent, Instant instant) const {
  const HornRow& row = rows_[agent];
  const double line = Seconds(row.stamp, instant);
  const double tau = std::max(line, 0.0);
  HornAt at;
  double lost = 0;
  for (int axis = 0; axis < 3; ++axis) {
    at.v[axis] = row.v[axis];
    at.c[axis] = row.p[axis] + row.v[axis] * line;
    lost += std::abs(row.p[axis]) + std::abs(row.v[axis] * line);
  }
  at.s0 = kOutward * (row.u0 + tau * (row.u1 + tau * row.u2)) + kLineRounding * lost;
  at.s1 = kOutward * (row.u1 + 2 * tau * row.u2);
  at.s2 = row.u2;
  return at;
}

// With d and w between the lines, n = d(x) / |d(x)| and g the gap |d(x)| − S(x), the distance lies
// above its tangent, so that nothing meets before the positive root y of
//   g − c y − s2 y²,   c = s1 + 2 s2 x − n·w.
// Rounding: d(x) and S(x) are off by less than 2^-48 of the terms they are sums of, n·w by 2^-50
// |w|; the gap is made smaller and c larger by more than that, and the step shorter by 2^-40, which
// covers the root's own rounding.
double HornTable::EarlierBound(std::uint32_t a, std::uint32_t b, Instant from, double limit) const {
  if (rows_[a].wild || rows_[b].wild || !Near(from)) return 0;
  const HornAt at_a = At(a, from), at_b = At(b, from);
  double d[3], w[3];
  for (int axis = 0; axis < 3; ++axis) {
    d[axis] = at_b.c[axis] - at_a.c[axis];
    w[axis] = at_b.v[axis] - at_a.v[axis];
  }
  const double s0 = at_a.s0 + at_b.s0, s1 = at_a.s1 + at_b.s1, s2 = at_a.s2 + at_b.s2;
  const double speed = Length(w), span = Length(d);
  double x = 0;
  for (int tangent = 0; tangent < kTangentsMax; ++tangent) {
    const double at[3] = {d[0] + w[0] * x, d[1] + w[1] * x, d[2] + w[2] * x};
    const double length = Length(at);
    const double reach = s0 + x * (s1 + x * s2);
    const double gap = length - reach - 0x1p-46 * (span + speed * x + reach);
    if (!(gap > 0)) return x;
    const double along = (at[0] * w[0] + at[1] * w[1] + at[2] * w[2]) / length;
    const double closing = (s1 + 2 * s2 * x - along) + 0x1p-46 * (s1 + 2 * s2 * x + speed);
    double step = kInfinity;
    if (s2 > 0) {
      const double root = std::sqrt(closing * closing + 4 * s2 * gap);
      step = closing >= 0 ? 2 * gap / (closing + root) : (root - closing) / (2 * s2);
    } else if (closing > 0) {
      step = gap / closing;
    }
    x += step * (1 - 0x1p-40);
    if (!(x <= limit)) return x;
  }
  return x;
}

HornAt BoxReach(HornAt horn, double duration) {
  constexpr double kCorner = kOutward * std::numbers::sqrt3;
  horn.s0 *= kCorner;
  horn.s1 = kCorner * (horn.s1 + horn.s2 * duration);
  horn.s2 = 0;
  return horn;
}

}  // namespace collision
