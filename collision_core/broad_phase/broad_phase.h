// Who could meet whom: the interface of every method.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/half_space.h"
#include "collision_core/broad_phase/pair_rules.h"
#include "collision_core/broad_phase/query.h"

namespace collision {

/// One possible meeting of the agent asked about.
struct Meeting {
  std::uint32_t partner;
  PairTime time;
};

/// Two agents, lower < higher.
struct NearPair {
  std::uint32_t lower, higher;

  friend auto operator<=>(const NearPair&, const NearPair&) = default;
};

/// From the one at `first` on.
inline void SortByPartner(std::size_t first, std::vector<Meeting>* meetings) {
  std::sort(meetings->begin() + static_cast<std::ptrdiff_t>(first), meetings->end(),
            [](const Meeting& a, const Meeting& b) { return a.partner < b.partner; });
}

/// Counted work since the start.
struct BroadPhaseWork {
  std::uint64_t pair_queries = 0;  ///< Pairs given to MeetingTime().
  std::uint64_t filter_tests = 0;  ///< Pairs ruled out, or not, by a cheaper test.
  std::uint64_t visits = 0;        ///< Cells, crossings or lists looked at.
  std::uint64_t rebuilds = 0;      ///< Times the whole structure was made anew.
  std::uint64_t searches = 0;      ///< Of one agent's neighbours, for one stretch of time.
  std::uint64_t neighbours = 0;    ///< Found in them.

  /// What a piece of work costs, in tests: as measured once on one machine; only the ratios count,
  /// and roughly.
  static constexpr double kPairUnits = 256, kVisitUnits = 16;
  /// An agent placed anew in the spatial index.
  static constexpr double kPlaceUnits = 64;

  double search_units() const {
    return static_cast<double>(filter_tests) + kVisitUnits * static_cast<double>(visits);
  }
};

/// Holds the bounds of all agents by index and finds their earliest meetings. Methods differ in
/// cost, never in what they answer: each value is MeetingTime() of the two bounds, or of a half-space
/// and a bound, with the pair's margin, bit for bit; excluded pairs meet never; and of equal meetings
/// the one with the lower indices comes first. Bounds that are put anew take effect at once;
/// structures are brought up to date by the next question. Single-threaded.
class BroadPhase {
 public:
  using Skip = std::function<bool(std::uint32_t)>;

  virtual ~BroadPhase() = default;

  /// Adds the agent, or replaces its bound.
  virtual void Put(std::uint32_t agent, const SpaceTimeBound& bound) = 0;
  /// As Put(), of a bound that lies inside the agent's last one: nothing needs to be asked anew.
  virtual void Narrow(std::uint32_t agent, const SpaceTimeBound& bound) { Put(agent, bound); }
  /// Removes the agent or half-space, if it is there, and all its rules.
  virtual void Remove(std::uint32_t agent) = 0;

  /// Adds a half-space under an index of its own, or replaces what that index held (Put() likewise).
  /// False: HalfSpaces refuses it.
  virtual bool PutHalfSpace(std::uint32_t agent, const HalfSpace& half_space) = 0;

  /// Rules count from the next question on, also for those who are put later, until one of the two
  /// is removed. False: PairRules refuses it.
  bool Exclude(std::uint32_t a, std::uint32_t b) { return SetRule(a, b, {.excluded = true}); }
  bool SetMargin(std::uint32_t a, std::uint32_t b, double metres) {
    return SetRule(a, b, {.margin = metres});
  }
  void ClearRule(std::uint32_t a, std::uint32_t b) { SetRule(a, b, {}); }
  const PairRules& rules() const { return *rules_; }
  const HalfSpaces& half_spaces() const { return half_spaces_; }

  /// For methods that work together: before anybody is put, one object for all of them; whoever
  /// changes it tells each.
  virtual void ShareRules(std::shared_ptr<PairRules> rules) { rules_ = std::move(rules); }
  virtual void RulesChanged(std::uint32_t /*agent*/) {}

  /// The first meeting of all within the query's window; nullopt: none.
  virtual std::optional<PairMeeting> Earliest(const BroadQuery& query) = 0;

  /// The first meeting of one agent within the query's window.
  virtual std::optional<PairMeeting> EarliestOf(std::uint32_t agent, const BroadQuery& query) = 0;

  /// Appends each partner that `agent` may first meet (horns), at or after `from`, by `until`, and
  /// of the later meetings the earliest, if it is not later than `horizon`; in the order of partners.
  /// Partners for which `skip` holds are left out.
  virtual void Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon,
                        const Skip& skip, std::vector<Meeting>* meetings) = 0;

  /// Appends every pair that may first meet within the query's window, and others that are near:
  /// each once. What cannot meet at all is left out. Cheaper by far than Meetings() of each agent,
  /// where all are asked at once.
  virtual void NearPairs(const BroadQuery& query, std::vector<NearPair>* pairs) = 0;

  virtual BroadPhaseWork work() const = 0;

 protected:
  void ForgetRules(std::uint32_t agent) {
    for (const std::uint32_t partner : rules_->Forget(agent)) RulesChanged(partner);
  }

  std::shared_ptr<PairRules> rules_ = std::make_shared<PairRules>();
  HalfSpaces half_spaces_;

 private:
  bool SetRule(std::uint32_t a, std::uint32_t b, PairRule rule) {
    if (!rules_->Set(a, b, rule)) return false;
    RulesChanged(a);
    RulesChanged(b);
    return true;
  }
};

}  // namespace collision
