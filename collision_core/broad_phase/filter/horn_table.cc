#include "collision_core/broad_phase/filter/horn_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision_core/base/free_list.h"

namespace collision::broad_phase {
namespace {

/// Beyond these [m, m/s], squares and products leave the range of doubles or of single precision.
constexpr double kPositionMax = 0x1p+60;
constexpr double kRateMax = 0x1p+40;

/// Whether an intersection depends on radius and unknown acceleration alone, so that the row says
/// everything. The row holds half of the acceleration, which has to be exact.
bool IsPlain(const motion::SpaceTimeBound& bound) {
  const motion::MotionState& state = bound.state;
  const motion::MotionLimits& limits = bound.limits;
  return !Bends(bound) && bound.skew == 0 && state.position_error == 0 &&
         state.velocity_error == 0 && limits.time_step == 0 &&
         limits.speed_max == numeric::kInfinity && state.direction.isZero(0) &&
         state.expiry.is_never() && 2 * (0.5 * limits.acceleration_max) == limits.acceleration_max;
}

/// What a known acceleration and a jerk add to the ball of a row (space_time_bound.h).
void Bend(const motion::SpaceTimeBound& bound, numeric::QuickBall* ball) {
  constexpr double kUp = numeric::kSomeRoundingsUp;
  const double skew = bound.skew, step = bound.limits.time_step, jerk = bound.limits.jerk_max;
  for (int axis = 0; axis < 3; ++axis) ball->bend[axis] = 0.5 * bound.state.a_WA[axis];
  const double whole = skew + step, rate = 2 * Length(ball->bend) * (skew + 0.5 * step);
  const double s3 = jerk / 6;
  ball->s0 = kUp * (ball->s0 + rate * skew + s3 * (skew * (skew * skew + 3 * step * whole)));
  ball->s1 = kUp * (ball->s1 + rate + 0.5 * jerk * whole * whole);
  ball->s2 = kUp * (ball->s2 + 0.5 * jerk * whole);
  ball->s3 = kUp * s3;
}

}  // namespace

// The centre is a polynomial, as exact before the stamp as after it; what its terms and those of
// its slope lose is added to the reach.
void HornTable::BendAt(const HornRow& row, double line, double tau, numeric::QuickBall* at) {
  const numeric::QuickBall& from = row.ball;
  double bent = 0, faster = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = from.bend[axis], gained = 2 * h * line, way = h * line * line;
    at->bend[axis] = h;
    at->v[axis] += gained;
    at->c[axis] += way;
    bent += std::abs(way);
    faster += std::abs(from.v[axis]) + std::abs(gained);
  }
  at->s0 = numeric::kSomeRoundingsUp * (at->s0 + tau * tau * tau * from.s3) + kLineRounding * bent;
  at->s1 = numeric::kSomeRoundingsUp * (at->s1 + 3 * tau * tau * from.s3) + kLineRounding * faster;
  at->s2 = numeric::kSomeRoundingsUp * (at->s2 + 3 * tau * from.s3);
  at->s3 = from.s3;
}

void HornTable::SetFull(HornRow* row, const AgentBound& bound) {
  if (row->full == kPlain) {
    if (free_.empty()) {
      CORE_CHECK(full_.size() < HornRow::kFullMax, "a row can name its place", full_.size());
      full_.emplace_back();
      free_.push_back(static_cast<std::uint32_t>(full_.size()));
    }
    row->full = free_.back() & HornRow::kFullMax;
    free_.pop_back();
  }
  full_[row->full - 1] = bound;
}

void HornTable::DropFull(HornRow* row) {
  if (row->full != kPlain) {
    full_[row->full - 1].filter.partners = nullptr;
    free_.push_back(row->full);
  }
  row->full = kPlain;
}

void HornTable::SetName(std::uint32_t agent, std::uint32_t name) {
  if (names_.size() <= agent) {
    if (name == 0) return;
    names_.resize(agent + 1, 0);
  }
  names_[agent] = name;
}

bool HornTable::ListsLetMeet(std::uint32_t a, std::uint32_t b) const {
  return broad_phase::ListsLetMeet(ListsOf(a), NameOf(a), ListsOf(b), NameOf(b),
                                   AreOfOneAssembly(rows_[a].assembly, rows_[b].assembly));
}

// Fills everything but `ruled` and `full`, which depend on the table.
void HornTable::Fill(const AgentBound& agent, double half_margin, HornRow* filled) {
  HornRow& row = *filled;
  numeric::QuickBall& ball = row.ball;
  const motion::SpaceTimeBound& bound = agent.bound;
  const motion::MotionState& state = bound.state;
  const motion::MotionLimits& limits = bound.limits;
  for (int axis = 0; axis < 3; ++axis) {
    ball.c[axis] = state.p_WA[axis];
    ball.v[axis] = state.v_WA[axis];
  }
  const double half = 0.5 * limits.acceleration_max;
  ball.s0 = limits.radius, ball.s1 = 0, ball.s2 = half, ball.s3 = 0;
  std::fill_n(ball.bend, 3, 0.0);
  row.bent = Bends(bound);
  row.stamp = state.stamp;
  row.group = agent.filter.group, row.mask = agent.filter.mask;
  row.assembly = agent.filter.assembly;
  CORE_CHECK(agent.filter.side <= kSideMax, "a side fits in its bits", agent.filter.side);
  row.side = agent.filter.side & kSideMax;
  row.listing = agent.filter.partners != nullptr;
  if (half_margin != 0 || !IsPlain(bound)) {
    const double skew = bound.skew, step = limits.time_step;
    const double given = limits.radius + half_margin + state.position_error;
    ball.s0 =
        numeric::kSomeRoundingsUp *
        (given + Length(ball.v) * skew + state.velocity_error * skew + half * skew * (skew + step));
    ball.s1 = numeric::kSomeRoundingsUp * (state.velocity_error + half * (2 * skew + step));
    ball.s2 = numeric::kSomeRoundingsUp * half;
  }
  if (row.bent) Bend(bound, &ball);
  row.still = NeverMoves(bound);
  const auto largest = [](const double* v) {
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  };
  row.unfilterable = !(std::max(largest(ball.c), ball.s0) < kPositionMax &&
                       std::max({largest(ball.v), ball.s1, ball.s2, ball.s3}) < kRateMax &&
                       largest(ball.bend) < kRateMax && Near(row.stamp));
  // A group of no bits meets no agent, and is not the mark of a free row.
  if (row.group == 0) row.group = 1, row.mask = 0;
}

HornRow HornTable::RowOf(const AgentBound& bound) {
  HornRow row;
  Fill(bound, 0, &row);
  return row;
}

void HornTable::Set(std::uint32_t agent, const AgentBound& bound) {
  if (rows_.size() <= agent) rows_.resize(agent + 1);
  HornRow& row = rows_[agent];
  count_ += row.group == 0;
  still_count_ -= row.still;
  unfilterable_count_ -= row.unfilterable;
  filtered_count_ -= row.group != 0 && row.filtered();
  row.ruled = rules_ != nullptr && rules_->HasAny(agent);
  const double half_margin = row.ruled ? rules_->HalfMargin(agent) : 0;
  if (half_margin == 0 && IsPlain(bound.bound) && !bound.filter.partners) {
    DropFull(&row);
  } else {
    SetFull(&row, bound);
  }
  SetName(agent, bound.filter.name);
  Fill(bound, half_margin, &row);
  still_count_ += row.still;
  unfilterable_count_ += row.unfilterable;
  filtered_count_ += row.filtered();
}

void HornTable::UpdateRules(std::uint32_t agent) {
  if (contains(agent)) Set(agent, agent_bound(agent));
}

void HornTable::Remove(std::uint32_t agent) {
  if (!contains(agent)) return;
  still_count_ -= rows_[agent].still;
  unfilterable_count_ -= rows_[agent].unfilterable;
  filtered_count_ -= rows_[agent].filtered();
  DropFull(&rows_[agent]);
  SetName(agent, 0);
  rows_[agent] = HornRow();
  --count_;
}

motion::SpaceTimeBound HornTable::bound(std::uint32_t agent) const {
  const HornRow& row = rows_[agent];
  if (row.full != kPlain) return full_[row.full - 1].bound;
  motion::SpaceTimeBound bound;
  bound.state.stamp = row.stamp;
  bound.state.p_WA = {row.ball.c[0], row.ball.c[1], row.ball.c[2]};
  bound.state.v_WA = {row.ball.v[0], row.ball.v[1], row.ball.v[2]};
  bound.limits.radius = row.ball.s0;
  bound.limits.acceleration_max = 2 * row.ball.s2;
  return bound;
}

CollisionFilter HornTable::filter(std::uint32_t agent) const {
  const HornRow& row = rows_[agent];
  if (row.full != kPlain) return full_[row.full - 1].filter;
  return {.group = row.group,
          .mask = row.mask,
          .assembly = row.assembly,
          .name = NameOf(agent),
          .side = row.side};
}

double HornTable::EarlierBound(const HornRow& a, const HornRow& b, Instant from, double limit) {
  if (a.unfilterable || b.unfilterable || !Near(from)) return 0;
  return broad_phase::EarlierBound(Difference(At(a, from), At(b, from)), limit);
}

void HornTable::Validate() const {
  std::uint32_t count = 0, still = 0, unfilterable = 0, filtered = 0;
  std::vector<bool> taken(full_.size());
  for (const HornRow& row : rows_) {
    if (row.group == 0) {
      CORE_CHECK(row.full == kPlain && !row.still && !row.unfilterable, "a free row is empty");
      continue;
    }
    ++count;
    still += row.still;
    unfilterable += row.unfilterable;
    filtered += row.filtered();
    CORE_CHECK(row.full != kPlain || !row.listing, "lists are kept beside their row");
    if (row.full == kPlain) continue;
    CORE_CHECK(row.full <= full_.size() && !taken[row.full - 1],
               "a bound that is kept whole belongs to one row", row.full, full_.size());
    taken[row.full - 1] = true;
  }
  ValidateFreeList(
      free_, full_.size(), [](std::uint32_t full) { return full - 1; },
      [&taken](std::size_t place) { return taken[place]; });
  CORE_CHECK(count == count_ && still == still_count_ && unfilterable == unfilterable_count_ &&
                 filtered == filtered_count_,
             "counts are those of the rows", count, still, unfilterable, filtered);
}

numeric::QuickBall BoxReach(numeric::QuickBall horn, double duration) {
  constexpr double kCorner = numeric::kSomeRoundingsUp * std::numbers::sqrt3;
  double way = 0, faster = 0, bulge = 0;
  if (horn.bends()) {
    // The chord of the centre's path; a face bulges ⅛ a T² = ¼ h T² out of its own.
    for (int axis = 0; axis < 3; ++axis) {
      const double gained = horn.bend[axis] * duration;
      horn.v[axis] += gained;
      faster += std::abs(horn.v[axis]) + std::abs(gained);
    }
    bulge = 0.25 * Length(horn.bend) * duration * duration;
    std::fill_n(horn.bend, 3, 0.0);
  }
  for (const double v : horn.v) way += std::abs(v) * duration;
  horn.s0 = kCorner * (horn.s0 + bulge + kLineRounding * way);
  horn.s1 =
      kCorner * (horn.s1 + duration * (horn.s2 + duration * horn.s3)) + kLineRounding * faster;
  horn.s2 = horn.s3 = 0;
  return horn;
}

}  // namespace collision::broad_phase
