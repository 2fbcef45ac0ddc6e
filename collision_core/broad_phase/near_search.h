// What all methods that place agents have in common: windows of time that grow until the next
// answer must lie beyond them.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/best_meeting.h"
#include "collision_core/broad_phase/lane_row.h"
#include "collision_core/broad_phase/placing.h"

namespace collision {

/// Every agent is placed once, with the reach that its horn and its way give it from then on; a
/// bound inside the old one leaves the placing valid. Questions look ahead in windows, and ask the
/// canonical routine only of pairs that a filter does not rule out. Agents too large or too far for
/// filters ("wild") are asked directly.
class NearSearch : public BroadPhase {
 public:
  NearSearch() { table_.UseRules(rules_.get()); }
  NearSearch(const NearSearch&) = delete;
  NearSearch& operator=(const NearSearch&) = delete;

  void Put(std::uint32_t agent, const SpaceTimeBound& bound) override;
  void Narrow(std::uint32_t agent, const SpaceTimeBound& bound) override;
  void Remove(std::uint32_t agent) override;
  bool PutHalfSpace(std::uint32_t agent, const HalfSpace& half_space) override;
  void ShareRules(std::shared_ptr<PairRules> rules) override;
  void RulesChanged(std::uint32_t agent) override;
  std::optional<PairMeeting> Earliest(const BroadQuery& query) override;
  std::optional<PairMeeting> EarliestOf(std::uint32_t agent, const BroadQuery& query) override;
  void Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon, const Skip& skip,
                std::vector<Meeting>* meetings) override;
  void NearPairs(const BroadQuery& query, std::vector<NearPair>* pairs) override;
  BroadPhaseWork work() const override { return work_; }

 protected:
  /// All horns_ are to be placed anew.
  virtual void PlaceAll() = 0;
  /// Prepares for Join() alone, of a stretch up to `last` at first: nobody need be found later.
  /// False: that would be no cheaper.
  virtual bool PlaceOnce(double /*last*/) { return false; }
  /// Places one since the last PlaceAll().
  virtual void PlaceOne(const PlacedHorn& horn) = 0;
  /// Forgets where he was placed, if he was.
  virtual void Unplace(std::uint32_t agent) = 0;
  /// Offers all placed pairs that come within reach of each other during the stretch, and others.
  virtual void Join(Stretch stretch, PairSink* sink) = 0;
  /// Appends to near_ all who are placed and come within reach of `horn` during the stretch.
  virtual void FindNear(const PlacedHorn& horn, Stretch stretch) = 0;

  const HornTable& table() const { return table_; }

  /// For placing_: all who are there.
  void PlaceEverybody();

  bool IsWild(std::uint32_t agent) const { return table_.row(agent).wild || placing_.blind(); }

  Placing placing_;
  std::vector<PlacedHorn> horns_;  ///< Of all who are not wild, as of the last PlaceEverybody().
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
  void StartAnew(const Placing& placing);
  void OfferWild(PairSink* sink) const;
  void Refresh(Instant from);
  void NoteCost(const BroadPhaseWork& before);
  bool AsksAll(std::uint32_t agent, Instant from) const;
  void FindNear(std::uint32_t agent, Instant from, double seconds);
  void FindNearOnce(std::uint32_t agent, Instant from, double seconds);

  HornTable table_;
  /// The first questions since the last placing, and what they cost; what later ones cost more.
  std::uint32_t fresh_ = 0;
  double fresh_units_ = 0, excess_units_ = 0;
  float fastest_ = 0;  ///< No horn that is placed has a greater speed.
  LaneRow crowd_;
  bool placed_ = false;  ///< All but those in moved_ are where they belong.
  std::vector<std::uint32_t> moved_;
  std::vector<bool> has_moved_;  ///< By agent: in moved_.
  std::vector<std::uint32_t> wild_;
  std::vector<std::uint64_t> told_in_;  ///< By agent: the last question that told of it.
  std::uint64_t question_ = 0;
};

}  // namespace collision
