// Who could meet whom: the interface of every method.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/query.h"

namespace collision {

/// One possible meeting of the agent asked about.
struct Meeting {
  std::uint32_t partner;
  PairTime time;
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
};

/// Holds the bounds of all agents by index and finds their earliest meetings. Methods differ in
/// cost, never in what they answer: each value is MeetingTime() of the two bounds, bit for bit, and
/// of equal meetings the one with the lower indices comes first. Bounds that are put anew take
/// effect at once; structures are brought up to date by the next question. Single-threaded.
class BroadPhase {
 public:
  using Skip = std::function<bool(std::uint32_t)>;

  virtual ~BroadPhase() = default;

  /// Adds the agent, or replaces its bound.
  virtual void Put(std::uint32_t agent, const SpaceTimeBound& bound) = 0;
  /// As Put(), of a bound that lies inside the agent's last one: nothing needs to be asked anew.
  virtual void Narrow(std::uint32_t agent, const SpaceTimeBound& bound) { Put(agent, bound); }
  virtual void Remove(std::uint32_t agent) = 0;

  /// The first meeting of all within the query's window; nullopt: none.
  virtual std::optional<PairMeeting> Earliest(const BroadQuery& query) = 0;

  /// The first meeting of one agent within the query's window.
  virtual std::optional<PairMeeting> EarliestOf(std::uint32_t agent, const BroadQuery& query) = 0;

  /// Appends each partner that `agent` may first meet (horns), at or after `from`, by `until`, and
  /// of the later meetings the earliest, if it is not later than `horizon`; in the order of partners.
  /// Partners for which `skip` holds are left out.
  virtual void Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon,
                        const Skip& skip, std::vector<Meeting>* meetings) = 0;

  virtual BroadPhaseWork work() const = 0;
};

}  // namespace collision
