// Which agents could meet: the interface of every method.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/index/half_space.h"
#include "collision_core/intersection/intersection_query.h"
#include "collision_core/intersection/pair_rules.h"

namespace collision::broad_phase {

/// One possible intersection of the agent that was asked about.
struct Meeting {
  std::uint32_t partner;
  intersection::IntersectionTime time;
};

/// Two agents that may meet, lower < higher.
struct NearPair {
  std::uint32_t lower, higher;

  friend auto operator<=>(const NearPair&, const NearPair&) = default;
};

/// Sorts the entries from `first` on by partner.
inline void SortByPartner(std::size_t first, std::vector<Meeting>* meetings) {
  std::sort(meetings->begin() + static_cast<std::ptrdiff_t>(first), meetings->end(),
            [](const Meeting& a, const Meeting& b) { return a.partner < b.partner; });
}

/// Appends the meeting if it comes by `until`.
inline void AppendIfBy(Instant until, const Meeting& meeting, std::vector<Meeting>* meetings) {
  const Instant when = meeting.time.instant();
  if (when <= until && !when.is_never()) meetings->push_back(meeting);
}

/// Work since the start, counted and never timed, so that it is the same on every machine.
struct BroadPhaseWork {
  std::uint64_t pair_queries = 0;  ///< Pairs given to EarliestIntersectionOf().
  std::uint64_t filter_tests = 0;  ///< Pairs that a cheaper test examined.
  std::uint64_t visits = 0;        ///< Cells, crossings or lists visited.
  std::uint64_t rebuilds = 0;      ///< Times the whole structure was rebuilt.
  std::uint64_t searches = 0;      ///< Searches for one agent's neighbours in one window.
  std::uint64_t neighbours = 0;    ///< Found in them.

  /// What a piece of work costs, in filter tests; measured once on one machine. Only the rough
  /// ratios matter, and only for the choice of a method.
  static constexpr double kPairUnits = 256, kVisitUnits = 16;
  /// PlacementFrame an agent anew in the spatial index.
  static constexpr double kPlaceUnits = 64;

  double search_units() const {
    return static_cast<double>(filter_tests) + kVisitUnits * static_cast<double>(visits);
  }
};

/// Holds the bounds of all agents by index and finds their earliest possible intersections.
///
/// Methods differ in cost, never in their answers: each value is EarliestIntersectionOf() of the two bounds,
/// or of a half-space and a bound, with the pair's margin, bit for bit. Excluded pairs never meet.
/// Of equal meetings the one with the lower indices comes first. A bound that is put takes effect
/// at once; the structures are brought up to date by the next question. Single-threaded.
/// methods_test compares every method with the canonical routine for every pair.
class BroadPhase {
 public:
  using Skip = std::function<bool(std::uint32_t)>;

  virtual ~BroadPhase() = default;

  /// Adds the agent, or replaces its bound.
  virtual void Put(std::uint32_t agent, const motion::SpaceTimeBound& bound) = 0;
  /// Replaces the bound of an agent by one that lies inside it; cheaper than Put().
  virtual void Narrow(std::uint32_t agent, const motion::SpaceTimeBound& bound) {
    Put(agent, bound);
  }
  /// Removes the agent or half-space, if it is there, and all its rules.
  virtual void Remove(std::uint32_t agent) = 0;

  /// Adds a half-space under an index of its own, or replaces what that index held (Put()
  /// likewise). False: HalfSpaces refuses it.
  virtual bool PutHalfSpace(std::uint32_t agent, const HalfSpace& half_space) = 0;

  /// A rule counts from the next question on, also for agents that are put later, until one of the
  /// two is removed. False: PairRules refuses it.
  bool Exclude(std::uint32_t a, std::uint32_t b) { return SetRule(a, b, {.excluded = true}); }
  bool SetMargin(std::uint32_t a, std::uint32_t b, double metres) {
    return SetRule(a, b, {.margin = metres});
  }
  void ClearRule(std::uint32_t a, std::uint32_t b) { SetRule(a, b, {}); }
  const intersection::PairRules& rules() const { return *rules_; }
  const HalfSpaces& half_spaces() const { return half_spaces_; }

  /// Shares one object between methods that work together. Requires that no agent was put. The
  /// caller that changes a rule calls RulesChanged() of each method.
  virtual void ShareRules(std::shared_ptr<intersection::PairRules> rules) {
    rules_ = std::move(rules);
  }
  virtual void RulesChanged(std::uint32_t /*agent*/) {}

  /// The earliest possible intersection of all pairs within the query's window; nullopt: none.
  virtual std::optional<intersection::IntersectingPair> Earliest(
      const intersection::BroadQuery& query) = 0;

  /// That of one agent with any other.
  virtual std::optional<intersection::IntersectingPair> EarliestOf(
      std::uint32_t agent, const intersection::BroadQuery& query) = 0;

  /// Appends each partner that `agent` may first meet (horns) at or after `from` and by `until`; of
  /// the later meetings only the earliest, if it is not later than `horizon`. In the order of
  /// partners, without those for which `skip` holds.
  virtual void Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon,
                        const Skip& skip, std::vector<Meeting>* meetings) = 0;

  /// Appends each agent or half-space that may first meet `bound` in [from, until], in the order of
  /// indices. `bound` is of no agent that is held, so that no rule applies to it. Partners for which
  /// `skip` holds are left out.
  virtual void MeetingsOf(const motion::SpaceTimeBound& bound, Instant from, Instant until,
                          const Skip& skip, std::vector<Meeting>* meetings) = 0;

  /// Appends every pair that may first meet within the query's window, and others that are near,
  /// each once; pairs that cannot meet at all are left out. Much cheaper than Meetings() of every
  /// agent.
  virtual void NearPairs(const intersection::BroadQuery& query, std::vector<NearPair>* pairs) = 0;

  virtual BroadPhaseWork work() const = 0;

 protected:
  void ForgetRules(std::uint32_t agent) {
    for (const std::uint32_t partner : rules_->Forget(agent)) RulesChanged(partner);
  }

  std::shared_ptr<intersection::PairRules> rules_ = std::make_shared<intersection::PairRules>();
  HalfSpaces half_spaces_;

 private:
  bool SetRule(std::uint32_t a, std::uint32_t b, intersection::PairRule rule) {
    if (!rules_->Set(a, b, rule)) return false;
    RulesChanged(a);
    RulesChanged(b);
    return true;
  }
};

}  // namespace collision::broad_phase
