// All agents' bounds by index, and the short form of each that filters read.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/broad_phase/agent_bound.h"
#include "collision_core/broad_phase/filter/pair_filter.h"
#include "collision_core/intersection/intersection_query.h"
#include "collision_core/intersection/pair_rules.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/seconds.h"

namespace collision::broad_phase {

/// A horn in plain doubles, rounded outward: its ball holds from the stamp on, whatever direction,
/// expiry or speed cap say beyond. Of the filter it holds what decides between agents without
/// lists.
struct HornRow {
  static constexpr std::uint32_t kFullMax = (1u << 25) - 1;

  numeric::QuickBall ball;  ///< s0 is grown by half of the agent's greatest margin.
  Instant stamp;
  std::uint32_t group = 0;  ///< 0: no such agent.
  std::uint32_t mask = 0;
  std::uint32_t assembly = 0;
  /// Where HornTable keeps the whole bound and filter; kPlain: nowhere.
  std::uint32_t full : 25 = 0;
  std::uint32_t side : 2 = 0;
  bool still : 1 = false;         ///< NeverMoves().
  bool unfilterable : 1 = false;  ///< Too large or too far for filters: tested directly.
  bool ruled : 1 = false;         ///< PairRules holds a rule of the agent.
  bool listing : 1 = false;       ///< The filter lists single partners.
  bool bent : 1 = false;          ///< An acceleration is known, or a jerk declared.

  /// Whether its filter can keep it apart from others.
  bool filtered() const { return mask != ~0u || assembly != 0 || side != 0 || listing; }
};
static_assert(sizeof(HornRow) == 128, "a row is two lines of the cache");

/// A reach below is a sum or product of fewer than sixteen terms of one sign: kSomeRoundingsUp
/// rounds it outward. What a sum of terms of either sign loses is less than this times the sum of
/// their magnitudes: 16 · 2^-53 of them, and as much again.
inline constexpr double kLineRounding = 0x1p-48;

/// All bounds by index. For an agent that declares no more than radius and acceleration, and lists
/// no partners, the row of 128 bytes is everything that is kept beside its name: the bound itself
/// is made again from it, bit for bit, for the few pairs that reach the canonical routine. Other
/// bounds and filters are kept whole beside their rows.
class HornTable {
 public:
  /// Grows rows by their agents' margins; null: there are no rules. Requires an empty table.
  void UseRules(const intersection::PairRules* rules) {
    CORE_CHECK(count_ == 0, "rules are set before agents are", count_);
    rules_ = rules;
  }
  /// Updates the row of an agent whose rules have changed.
  void UpdateRules(std::uint32_t agent);
  /// The rule of an agent of the table with another. Fastest if `agent` has no rules.
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
  /// Whether some pairs can be excluded: an agent never moves, or its filter says so.
  bool has_collision_filters() const { return still_count_ + filtered_count_ > 0; }
  bool contains(std::uint32_t agent) const { return agent < size() && rows_[agent].group != 0; }
  const HornRow& row(std::uint32_t agent) const { return rows_[agent]; }
  /// Prefetches the row into the cache.
  void Fetch(std::uint32_t agent) const {
    __builtin_prefetch(&rows_[agent]);
    __builtin_prefetch(&rows_[agent].ball.bend);
  }
  /// The row of a bound that is in no table and has no rules.
  static HornRow RowOf(const AgentBound& bound);
  /// The bound as it was set, perhaps without its orientation, on which no intersection depends.
  motion::SpaceTimeBound bound(std::uint32_t agent) const;
  CollisionFilter filter(std::uint32_t agent) const;
  AgentBound agent_bound(std::uint32_t agent) const { return {bound(agent), filter(agent)}; }

  /// Whether the filters let two agents of the table meet.
  bool FiltersLetMeet(std::uint32_t a, std::uint32_t b) const {
    const HornRow &of_a = rows_[a], &of_b = rows_[b];
    if (!GroupsLetMeet(of_a.group, of_a.mask, of_b.group, of_b.mask)) return false;
    if (AreOfOneSide(of_a.side, of_b.side)) return false;
    if (of_a.listing || of_b.listing) return ListsLetMeet(a, b);
    return !AreOfOneAssembly(of_a.assembly, of_b.assembly);
  }
  /// The same for an agent of the table and any filter.
  bool FiltersLetMeet(std::uint32_t agent, const CollisionFilter& other) const {
    const HornRow& row = rows_[agent];
    if (!GroupsLetMeet(row.group, row.mask, other.group, other.mask)) return false;
    if (AreOfOneSide(row.side, other.side)) return false;
    const bool apart = AreOfOneAssembly(row.assembly, other.assembly);
    if (!row.listing && !other.partners) return !apart;
    return broad_phase::ListsLetMeet(ListsOf(agent), NameOf(agent), other.partners.get(),
                                     other.name, apart);
  }
  /// Whether two agents of the table can meet at all: their filters let them, and one can move.
  bool CanMeetAtAll(std::uint32_t a, std::uint32_t b) const {
    return !(rows_[a].still && rows_[b].still) && FiltersLetMeet(a, b);
  }

  /// Walks the table: counts are those of its rows, and places of whole bounds belong to one row
  /// each, or are free. Throws CheckFailure.
  void Validate() const;

  /// Whether filters can work with the instant: differences of such instants do not overflow.
  static bool Near(Instant t) {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 61;
    return t.nanoseconds() > -kFarthest && t.nanoseconds() < kFarthest;
  }

  /// The ball of a row as seen from an instant on. Before the row's stamp its line goes on
  /// backward, and its reach stays what it is at the stamp. Unchecked: the row is not
  /// unfilterable, and the instant is Near().
  numeric::QuickBall At(std::uint32_t agent, Instant instant) const {
    return At(rows_[agent], instant);
  }
  static numeric::QuickBall At(const HornRow& row, Instant instant);

  /// A filter: the horns of the two do not meet earlier than this many seconds after `from`, and
  /// not within `limit` if the answer is larger. Off by a relative 1e-9 or so; 0 if either is
  /// unfilterable.
  double EarlierBound(std::uint32_t a, std::uint32_t b, Instant from, double limit) const {
    return EarlierBound(rows_[a], rows_[b], from, limit);
  }
  static double EarlierBound(const HornRow& a, const HornRow& b, Instant from, double limit);

 private:
  static constexpr std::uint32_t kPlain = 0;  ///< HornRow::full: the row says everything.

  static void Fill(const AgentBound& agent, double half_margin, HornRow* filled);
  static void BendAt(const HornRow& row, double line, double tau, numeric::QuickBall* at);
  void SetFull(HornRow* row, const AgentBound& bound);
  void DropFull(HornRow* row);
  void SetName(std::uint32_t agent, std::uint32_t name);
  std::uint32_t NameOf(std::uint32_t agent) const {
    return agent < names_.size() ? names_[agent] : 0;
  }
  const PartnerLists* ListsOf(std::uint32_t agent) const {
    return rows_[agent].listing ? full_[rows_[agent].full - 1].filter.partners.get() : nullptr;
  }
  bool ListsLetMeet(std::uint32_t a, std::uint32_t b) const;

  const intersection::PairRules* rules_ = nullptr;
  std::vector<HornRow> rows_;         ///< By agent.
  std::vector<AgentBound> full_;      ///< At HornRow::full − 1.
  std::vector<std::uint32_t> free_;   ///< Free places of full_, plus one as in HornRow::full.
  std::vector<std::uint32_t> names_;  ///< Of filters, by agent; as long as there are names.
  std::uint32_t count_ = 0, still_count_ = 0, unfilterable_count_ = 0, filtered_count_ = 0;
};

// The reach is a sum of terms of one sign; the centre is a sum of lines, and its loss is added to
// the reach.
inline numeric::QuickBall HornTable::At(const HornRow& row, Instant instant) {
  const numeric::QuickBall& from = row.ball;
  const double line =
      static_cast<double>(instant.nanoseconds() - row.stamp.nanoseconds()) * numeric::kNanosecond;
  const double tau = std::max(line, 0.0);
  numeric::QuickBall at;
  double lost = 0;
  for (int axis = 0; axis < 3; ++axis) {
    at.v[axis] = from.v[axis];
    at.c[axis] = from.c[axis] + from.v[axis] * line;
    lost += std::abs(from.c[axis]) + std::abs(from.v[axis] * line);
  }
  at.s0 = numeric::kSomeRoundingsUp * (from.s0 + tau * (from.s1 + tau * from.s2)) +
          kLineRounding * lost;
  at.s1 = numeric::kSomeRoundingsUp * (from.s1 + 2 * tau * from.s2);
  at.s2 = from.s2;
  if (row.bent) BendAt(row, line, tau, &at);
  return at;
}

/// A ball around a hypertrapezoid's box over a window of `duration` seconds, from the ball of its
/// horn: chords instead of curves, corners √3 times as far as the ball, and what the faces at
/// the end of the window lose by rounding.
numeric::QuickBall BoxReach(numeric::QuickBall horn, double duration);

}  // namespace collision::broad_phase
