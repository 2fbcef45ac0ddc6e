// All agents' bounds by index, and the short form of each that filters read.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/agent_bound.h"
#include "collision_core/broad_phase/filter/approaching.h"
#include "collision_core/intersection/intersection_query.h"
#include "collision_core/intersection/pair_rules.h"

namespace collision::broad_phase {

/// A horn in plain doubles, rounded outward: at τ >= 0 after its stamp the agent lies within
/// u0 + u1 τ + u2 τ² of p + v τ, whatever direction, expiry or speed cap say beyond.
struct HornRow {
  double p[3];
  double v[3];
  double u0, u1, u2;
  Instant stamp;
  CollisionFilter filter{0, 0};  ///< Group 0: no such agent.
  std::uint32_t full = 0;        ///< HornTable's own.
  bool still = false;            ///< NeverMoves().
  bool unfilterable = false;     ///< Too large or too far for filters: to be asked directly.
  bool ruled = false;  ///< PairRules has any for it; u0 is grown by half of its greatest margin.
};

/// The same from an instant on: at x >= 0 after it within s0 + s1 x + s2 x² of c + v x.
struct HornAt {
  double c[3];
  double v[3];
  double s0, s1, s2;
};

/// All bounds by index. For an agent that declares no more than radius and acceleration the row of
/// 96 bytes is everything that is kept: the bound itself is made again from it, bit for bit, for
/// the few pairs that reach the canonical routine. Other bounds are kept whole beside their rows.
class HornTable {
 public:
  /// Grows rows by their agents' margins; null: there are no rules. Requires an empty table.
  void UseRules(const intersection::PairRules* rules) { rules_ = rules; }
  /// The agent's rules have changed.
  void UpdateRules(std::uint32_t agent);
  /// The rule of an agent of the table and any other; fastest if `agent` has no rules.
  intersection::PairRule RuleOf(std::uint32_t agent, std::uint32_t partner) const {
    return rows_[agent].ruled ? rules_->Of(partner, agent) : intersection::PairRule();
  }

  void Set(std::uint32_t agent, const AgentBound& bound);
  void Remove(std::uint32_t agent);

  /// One more than the greatest index ever used.
  std::uint32_t size() const { return static_cast<std::uint32_t>(rows_.size()); }
  std::uint32_t count() const { return count_; }
  std::uint32_t still_count() const { return still_count_; }
  std::uint32_t unfilterable_count() const { return unfilterable_count_; }
  /// Whether any agent has groups that it does not meet, or never moves.
  bool has_collision_filters() const { return still_count_ + filtered_count_ > 0; }
  bool contains(std::uint32_t agent) const {
    return agent < size() && rows_[agent].filter.group != 0;
  }
  const HornRow& row(std::uint32_t agent) const { return rows_[agent]; }
  /// Fetches the row into the cache, for a question that comes soon.
  void Fetch(std::uint32_t agent) const {
    __builtin_prefetch(&rows_[agent]);
    __builtin_prefetch(&rows_[agent].u1);
  }
  /// The row of a bound that is in no table and has no rules.
  static HornRow RowOf(const AgentBound& bound);
  /// The bound as it was set, perhaps without its orientation, on which no meeting depends.
  motion::SpaceTimeBound bound(std::uint32_t agent) const;
  AgentBound agent_bound(std::uint32_t agent) const { return {bound(agent), rows_[agent].filter}; }

  /// Walks the table: counts are those of its rows, and bounds kept whole belong to one row each.
  /// Throws CheckFailure.
  void Validate() const;

  /// Whether filters can work with the instant: differences of such instants are exact.
  static bool Near(Instant t) {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 61;
    return t.nanoseconds() > -kFarthest && t.nanoseconds() < kFarthest;
  }

  /// Of a row that is not unfilterable, at an instant that is Near(). Before its stamp the line
  /// goes on backward, and the reach stays.
  HornAt At(std::uint32_t agent, Instant instant) const { return At(rows_[agent], instant); }
  static HornAt At(const HornRow& row, Instant instant);

  /// A filter: no horn of the two meets earlier than this many seconds after `from`, and none at
  /// all within `limit` if the answer is larger. Off by a relative 1e-9 or so; 0 for unfilterable
  /// ones.
  double EarlierBound(std::uint32_t a, std::uint32_t b, Instant from, double limit) const {
    return EarlierBound(rows_[a], rows_[b], from, limit);
  }
  static double EarlierBound(const HornRow& a, const HornRow& b, Instant from, double limit);

 private:
  static constexpr std::uint32_t kPlain = 0;  // nothing beside the row

  static void Fill(const AgentBound& agent, double half_margin, HornRow* filled);
  void SetFull(HornRow* row, const motion::SpaceTimeBound& bound);
  void DropFull(HornRow* row);

  const intersection::PairRules* rules_ = nullptr;
  std::vector<HornRow> rows_;                 // by agent
  std::vector<motion::SpaceTimeBound> full_;  // at HornRow::full - 1
  std::vector<std::uint32_t> free_;           // of full_
  std::uint32_t count_ = 0, still_count_ = 0, unfilterable_count_ = 0, filtered_count_ = 0;
};

// Each value is a sum or product of fewer than sixteen terms of one sign, so that rounding takes
// less than 16 · 2^-53 of it; positions, which are sums of lines, are off by less than that part of
// their terms.
inline HornAt HornTable::At(const HornRow& row, Instant instant) {
  constexpr double kOutward = 1 + 0x1p-48, kLineRounding = 0x1p-48;
  const double line = static_cast<double>(instant.nanoseconds() - row.stamp.nanoseconds()) * 1e-9;
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

/// Of two horns from an instant on.
inline Approaching Between(const HornAt& a, const HornAt& b) {
  Approaching pair;
  for (int axis = 0; axis < 3; ++axis) {
    pair.d[axis] = b.c[axis] - a.c[axis];
    pair.w[axis] = b.v[axis] - a.v[axis];
  }
  pair.s0 = a.s0 + b.s0, pair.s1 = a.s1 + b.s1, pair.s2 = a.s2 + b.s2;
  return pair;
}

/// The reach of a hypertrapezoid's box over a window of `duration` seconds, from that of its horn:
/// chords instead of parabolas, corners √3 away instead of the ball, and what its faces at the end
/// of the window lose by rounding.
HornAt BoxReach(HornAt horn, double duration);

}  // namespace collision::broad_phase
