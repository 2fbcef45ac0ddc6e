// What all methods that place agents have in common: windows of time that grow until the next
// answer must lie beyond them.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/filter/placement_frame.h"
#include "collision_core/broad_phase/index/earliest_pair_sink.h"
#include "collision_core/broad_phase/index/filter_row.h"

namespace collision::broad_phase {

/// What all methods have in common that place agents. Every agent is placed once, with the reach
/// that its horn and its way give it from then on; a bound inside the old one leaves the placing
/// valid, so a kept state costs nothing here. Questions look ahead in windows of time, four times
/// as long each, until the next answer must lie beyond, and ask the canonical routine only about
/// pairs that three filters leave open. Each filter is certified and of a fixed price; none decides
/// a value.
///
/// - Where (placing.h): each agent is placed at the middle of the window, in a frame that moves
///   with the average of all, with the reach that its horn has at the window's end. From there its
///   centre strays by half its way.
/// - PlacedBalls (lane_scan.h): the least distance of two centres over the window against the sum of the
///   reaches, in single precision, sixteen, eight or one at a time.
/// - One pair (approaching.h): the closest approach of the two lines, the gap along the first
///   direction, then up to six tangent steps in doubles.
///
/// Agents too large or too far for filters ("unfilterable": reach or distance over 2^60 m, speed over 2^40
/// m/s, a century from the begin) are asked directly.
///
/// Earliest() first asks some 1.5 √N agents that lie close together, all pairs of them: their first
/// meeting bounds that of all, so that the window is short from then on if a hit comes at once.
class WindowedSearch : public BroadPhase {
 public:
  WindowedSearch() { table_.UseRules(rules_.get()); }
  WindowedSearch(const WindowedSearch&) = delete;
  WindowedSearch& operator=(const WindowedSearch&) = delete;

  void Put(std::uint32_t agent, const motion::SpaceTimeBound& bound) override;
  void Narrow(std::uint32_t agent, const motion::SpaceTimeBound& bound) override;
  void Remove(std::uint32_t agent) override;
  bool PutHalfSpace(std::uint32_t agent, const HalfSpace& half_space) override;
  void ShareRules(std::shared_ptr<intersection::PairRules> rules) override;
  void RulesChanged(std::uint32_t agent) override;
  std::optional<intersection::IntersectingPair> Earliest(
      const intersection::BroadQuery& query) override;
  std::optional<intersection::IntersectingPair> EarliestOf(
      std::uint32_t agent, const intersection::BroadQuery& query) override;
  void Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon, const Skip& skip,
                std::vector<Meeting>* meetings) override;
  void MeetingsOf(const motion::SpaceTimeBound& bound, Instant from, Instant until,
                  const Skip& skip, std::vector<Meeting>* meetings) override;
  void NearPairs(const intersection::BroadQuery& query, std::vector<NearPair>* pairs) override;
  BroadPhaseWork work() const override { return work_; }

 protected:
  /// All horns_ are to be placed anew.
  virtual void PlaceAll() = 0;
  /// Prepares for Join() alone, of a stretch up to `last` at first; FindNear() will not be called.
  /// False: that would be no cheaper.
  virtual bool PlaceOnce(double /*last*/) { return false; }
  /// Places one since the last PlaceAll().
  virtual void PlaceOne(const PlacedHorn& horn) = 0;
  /// Removes the agent from the structure, if it is placed.
  virtual void Unplace(std::uint32_t agent) = 0;
  /// Offers all placed pairs that come within reach of each other during the stretch, and others.
  virtual void Join(TimeWindow stretch, PairSink* sink) = 0;
  /// Appends to near_ all placed agents that come within reach of `horn` during the stretch.
  virtual void FindNear(const PlacedHorn& horn, TimeWindow stretch) = 0;

  const HornTable& table() const { return table_; }

  /// Places all agents for placing_.
  void PlaceEverybody();

  bool IsWild(std::uint32_t agent) const {
    return table_.row(agent).unfilterable || placing_.blind();
  }

  PlacementFrame placing_;
  std::vector<PlacedHorn> horns_;  ///< All agents but unfilterable ones, as of PlaceEverybody().
  BroadPhaseWork work_;
  std::uint64_t wasted_ = 0;  ///< Tests that a fresh placing would have saved, since the last.
  std::vector<std::uint32_t> near_;

 private:
  void SortOutWild();
  void Drop(std::uint32_t agent);
  template <typename Each>
  void ForEachHalfSpace(std::uint32_t asked, Each each) const;
  void Move(std::uint32_t agent);
  void PlaceMoved();
  void AskCrowd(PairSink* sink);
  void StartAnew(const PlacementFrame& placing);
  void OfferWild(PairSink* sink) const;
  void Refresh(Instant from);
  void NoteCost(const BroadPhaseWork& before);
  bool AsksAll(std::uint32_t agent, Instant from) const;
  void FindNear(std::uint32_t agent, Instant from, double seconds);
  void FindNearOnce(std::uint32_t agent, Instant from, double seconds);
  void FindNear(PlacedHorn horn, Instant from, double seconds);
  void FindAll(std::uint32_t but);
  void OfferHalfSpaces(const motion::SpaceTimeBound& bound, Instant from, Instant until,
                       const Skip& skip, std::vector<Meeting>* meetings);

  HornTable table_;
  /// The first questions since the last placing, and their cost; the excess of later ones.
  std::uint32_t fresh_ = 0;
  double fresh_units_ = 0, excess_units_ = 0;
  float fastest_ = 0;  ///< No horn that is placed has a greater speed.
  FilterRow crowd_;
  bool placed_ = false;  ///< All but those in moved_ are where they belong.
  std::vector<std::uint32_t> moved_;
  std::vector<bool> has_moved_;  ///< By agent: in moved_.
  std::vector<std::uint32_t> wild_;
  std::vector<std::uint64_t> told_in_;  ///< By agent: the last question that found it.
  std::uint64_t question_ = 0;
};

}  // namespace collision::broad_phase
