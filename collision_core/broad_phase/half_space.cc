#include "collision_core/broad_phase/half_space.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "collision_core/motion/speed_cap.h"
#include "collision_core/numeric/cubic.h"
#include "collision_core/numeric/rounding.h"

namespace collision::broad_phase {
namespace {

/// The first δ >= 0, rounded down, at which the ball may have come to the plane. The distance to
/// it, times |n|, is a cubic that no tangent has to bound:
///   (n·(p + shift) − offset − |n| (r + margin + u0)) − (|n| u1 − n·v) δ − (|n| u2 − n·h) δ² − |n|
///   u3 δ³.
/// Positions first: far from the origin only what the inputs lost is lost.
double FirstReach(const HalfSpace& half_space, const numeric::MovingBall& ball, double margin) {
  const numeric::IntervalVector n(half_space.normal);
  const numeric::Interval length = numeric::Norm(n);
  const numeric::Cubic reach = length * (numeric::Cubic{ball.radius + margin, 0, 0} + ball.u);
  const numeric::Interval along = (Dot(n, ball.anchor) - half_space.offset) + Dot(n, ball.shift);
  const numeric::Interval closing = reach.c1 - Dot(n, ball.velocity);
  const numeric::Interval growth = ball.bends ? reach.c2 - Dot(n, ball.bend) : reach.c2;
  return numeric::FirstZero((along - reach.c0).lower, closing.upper, growth.upper,
                            std::max(0.0, reach.c3.upper));
}

/// What a coordinate's products and sums may lose, relative to the sum of their magnitudes: fewer
/// than 16 roundings here, and 2^-48 of the same terms that EarliestIntersectionOf() may.
constexpr double kRounding = 0x1p-46;

/// Beside it, where products underflow.
constexpr double kLeast = 0x1p-1000;

/// EarliestIntersectionOf() may be that much earlier, relative.
constexpr double kAhead = 1 + 0x1p-27;

/// More seconds than this after any instant give Never().
constexpr double kForever = 2e10;

}  // namespace

bool CanMeet(const HalfSpace& half_space, const AgentBound& bound) {
  return CanMeet(half_space.filter, bound.filter) && !NeverMoves(bound.bound);
}

intersection::IntersectionTime EarliestIntersectionOf(const intersection::BroadQuery& query,
                                                      const HalfSpace& half_space,
                                                      const AgentBound& agent, double margin) {
  const motion::SpaceTimeBound& bound = agent.bound;
  const Instant base = std::max(query.from, bound.state.stamp);
  const Instant expiry = bound.state.expiry;
  const intersection::IntersectionTime never{base, numeric::kInfinity};
  if (!CanMeet(half_space, agent) || expiry <= base || base > query.until) return never;
  intersection::IntersectionTime time{base,
                                      FirstReach(half_space, ForwardBall(bound, base), margin)};
  if (time.seconds == numeric::kInfinity) return never;
  // The capped ball is the horn's until it starts, and from then on only ever grows.
  const std::optional<motion::BallFromTime> cap = CappedBallFrom(bound, base);
  if (cap && time.seconds > cap->start) {
    time.seconds = std::max(time.seconds, FirstReach(half_space, cap->ball, margin));
  }
  const Instant when = time.instant();
  return when < expiry && when <= query.until ? time : never;
}

bool HalfSpaces::Set(std::uint32_t agent, const HalfSpace& half_space) {
  const double largest = half_space.normal.cwiseAbs().maxCoeff();
  if (half_space.normal.hasNaN() || !(largest >= kNormalMin && largest <= kNormalMax)) return false;
  if (!std::isfinite(half_space.offset)) return false;
  const double length = numeric::Norm(numeric::IntervalVector(half_space.normal)).upper;
  const auto at = std::lower_bound(
      entries_.begin(), entries_.end(), agent,
      [](const Entry& entry, std::uint32_t wanted) { return entry.agent < wanted; });
  if (at != entries_.end() && at->agent == agent) {
    *at = {agent, half_space, length};
    return true;
  }
  if (entries_.size() == kCountMax) return false;
  entries_.insert(at, {agent, half_space, length});
  return true;
}

bool HalfSpaces::Remove(std::uint32_t agent) {
  return std::erase_if(entries_, [&](const Entry& entry) { return entry.agent == agent; }) > 0;
}

const HalfSpaces::Entry* HalfSpaces::Find(std::uint32_t agent) const {
  for (const Entry& entry : entries_) {
    if (entry.agent == agent) return &entry;
  }
  return nullptr;
}

// The distance is concave in time, with a bend as part of the reach: above zero at both ends it is
// so between them.
bool MayReach(const HalfSpaces::Entry& entry, const numeric::QuickBall& given, double margin,
              double limit) {
  const numeric::QuickBall horn = given.bends() ? Straightened(given) : given;
  const HalfSpace& half_space = entry.half_space;
  const auto stays_out_at = [&](double x) {
    double along = -half_space.offset, magnitude = std::abs(half_space.offset);
    for (int axis = 0; axis < 3; ++axis) {
      const double n = half_space.normal[axis], c = horn.c[axis], way = horn.v[axis] * x;
      along += n * (c + way);
      magnitude += std::abs(n) * (std::abs(c) + std::abs(way));
    }
    const double reach =
        entry.length * (horn.s0 + margin + x * (horn.s1 + x * (horn.s2 + x * horn.s3)));
    return along - reach - kRounding * (magnitude + reach) > kLeast;
  };
  return !(stays_out_at(0) && stays_out_at(std::min(kAhead * limit, kForever)));
}

}  // namespace collision::broad_phase
