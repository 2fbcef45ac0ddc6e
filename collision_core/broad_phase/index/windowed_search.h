// A search for neighbours in time windows that grow until no intersection beyond them can be
// earlier than the best found.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/filter/filter_row.h"
#include "collision_core/broad_phase/filter/placement_frame.h"
#include "collision_core/broad_phase/index/earliest_pair_sink.h"
#include "collision_core/broad_phase/index/placed_store.h"
#include "collision_core/broad_phase/sweeping_index.h"

namespace collision::broad_phase {

/// Places every agent once, with a reach that covers its horn and its path from then on, and keeps
/// it in a store. A bound inside the old one leaves the placement valid, so a tightened bound costs
/// nothing here. A query searches time windows, each four times as long as the one before, until no
/// intersection beyond them can be earlier than the best found, and asks the canonical routine only
/// about pairs that three filters leave open. Each filter is certified and of a fixed price; none
/// decides a value.
///
/// - PlacementFrame: each agent is placed at the middle of the window, in a frame that moves with
///   the average of all, with the reach that its horn has at the window's end. Its centre moves
///   away from there by at most half its path.
/// - SphereFilter: compares the least distance of two centres over the window with the sum of the
///   reaches, in single precision, sixteen, eight or one at a time.
/// - MayMeetBy(): tests one pair in doubles: the closest approach of the two lines, the gap along
///   the first direction, then up to six tangent steps.
///
/// Agents beyond the range of the filters ("unfilterable": reach or a coordinate from 2^60 m on,
/// speed or growth from 2^40 on, a stamp more than 2^61 ns, 73 years, from time zero) are tested
/// directly.
///
/// A placement ages: reaches grow and agents stray, so queries cost ever more. All agents are
/// placed anew once the excess over the cost of the first 64 queries adds up to the cost of
/// placement (the best moment where the excess grows evenly), or once as many tests as there are
/// agents were plainly wasted. No answer depends on when that happens.
///
/// Earliest() first tests all pairs among some 1.5 √N agents that lie close together: their first
/// intersection bounds that of all, which shortens the window.
class WindowedSearch : public SweepingIndex {
 public:
  /// `store` decides the method: a row, or grids.
  explicit WindowedSearch(std::unique_ptr<PlacedStore> store);

  void Set(std::uint32_t agent, const AgentBound& bound) override;
  void Tighten(std::uint32_t agent, const AgentBound& bound) override;
  void Remove(std::uint32_t agent) override;
  bool SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) override;
  void UpdateRules(std::uint32_t agent) override;
  void FindNeighbours(std::uint32_t agent, const NeighbourWindow& window, const Skip& skip,
                      std::vector<Neighbour>* neighbours) override;
  void FindNeighbours(const AgentBound& bound, Instant from, Instant until, const Skip& skip,
                      std::vector<Neighbour>* neighbours) override;
  std::optional<intersection::IntersectingPair> EarliestOf(
      std::uint32_t agent, const intersection::BroadQuery& query) override;
  void FindNearPairs(const intersection::BroadQuery& query, std::vector<NearPair>* pairs) override;
  std::optional<intersection::IntersectingPair> Earliest(
      const intersection::BroadQuery& query) override;
  BroadPhaseWork work() const override { return cost_.work; }
  bool Contains(std::uint32_t agent) const override { return table_.contains(agent); }

  /// The bounds that are held.
  const HornTable& table() const { return table_; }

  /// Walks the structure: each agent that is held is due to be placed, or in the store, or
  /// unfilterable; and the store. Throws CheckFailure.
  void Validate() const override;

 private:
  PlacedScene scene() const { return {&table_, &frame_}; }
  void ValidatePlaced() const;
  void Drop(std::uint32_t agent);
  void MarkMoved(std::uint32_t agent);
  PlacedBall Placed(std::uint32_t agent);
  void StartAnew(const PlacementFrame& frame);
  void PlaceEveryAgent();
  void PlaceMoved();
  void Refresh(Instant from);
  void RecordCost(const BroadPhaseWork& before);
  void OfferCrowd(PairSink* sink);
  void OfferUnfilterable(PairSink* sink) const;
  void Join(TimeWindow window, PairSink* sink);
  bool TestsAll(std::uint32_t agent, Instant from) const;
  void FindNear(std::uint32_t agent, Instant from, double seconds);
  void FindNear(PlacedBall horn, Instant from, double seconds);
  void FindAllBut(std::uint32_t agent);
  void CountSearch();
  template <typename Each>
  void ForEachHalfSpace(std::uint32_t asked, Each each) const;
  void AppendHalfSpaces(const AgentBound& bound, Instant from, Instant until, const Skip& skip,
                        std::vector<Neighbour>* neighbours);
  bool AppendIfIntersecting(std::uint32_t agent, std::uint32_t other, const Within& within,
                            Instant until, std::vector<Neighbour>* neighbours);

  HornTable table_;
  PlacementFrame frame_;
  std::unique_ptr<PlacedStore> store_;
  SearchCost cost_;
  bool placed_ = false;  ///< All agents but those in moved_ are in store_ or unfilterable_.
  std::vector<std::uint32_t> moved_;
  std::vector<bool> has_moved_;  ///< By agent: in moved_.
  std::vector<std::uint32_t> unfilterable_;
  float fastest_ = 0;    ///< No horn that is placed has a greater speed.
  float most_bent_ = 0;  ///< Nor a greater bend.

  /// The first queries since the last placement and what they cost, and the excess of later ones.
  std::uint32_t fresh_ = 0;
  double fresh_units_ = 0, excess_units_ = 0;

  std::vector<std::uint64_t> reported_in_;  ///< By agent: the last query that reported it.
  std::uint64_t query_ = 0;
  FilterRow crowd_;                  ///< Scratch, like the next two.
  std::vector<PlacedBall> horns_;    ///< To be placed.
  std::vector<std::uint32_t> near_;  ///< Agents found by the last search.
};

}  // namespace collision::broad_phase
