// The detector's insides. Only detector*.cc include this.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "collision_core/detection/agent_record.h"
#include "collision_core/detection/announcer.h"
#include "collision_core/detection/detector.h"
#include "collision_core/detection/event_queue.h"
#include "collision_core/detection/former_motions.h"
#include "collision_core/detection/key_rows.h"
#include "collision_core/detection/pair_table.h"
#include "collision_core/detection/restlessness.h"
#include "collision_core/detection/scene_extremes.h"
#include "collision_core/detection/work_shares.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {

/// What keeps never-late true between two steps:
///  - every two agents that can meet are either a tracked pair, whose tracker says up to when they
///    are certified free, or covered: certified free up to the greater of their two keys, which is
///    later than both newest states; or both are told as saturated;
///  - after a step every key is later than now + announce_within (or its agent is saturated).
/// No step walks over all agents or pairs: what must be looked at stands in a queue by the time at
/// which it is due, or in a list of what has changed.
class Detector::Implementation {
 public:
  explicit Implementation(const DetectorOptions& options);

  bool Admit(const AgentId& id, const motion::AgentDeclaration& declaration,
             const motion::MotionState& state, Instant effective_from);
  UpdateOutcome Update(const AgentId& id, const motion::MotionState& state, Instant effective_from);
  bool Redeclare(const AgentId& id, const motion::AgentDeclaration& declaration,
                 Instant effective_from);
  bool Remove(const AgentId& id);
  void Hear(const AgentId& id, Instant until);
  void Advance(Instant now);

  AgentClearance Clearance(const AgentRecord& agent) const;
  std::vector<AgentClearance> TakeChangedClearances();
  std::optional<AgentClearance> ClearanceOf(const AgentId& id) const;
  EarliestAnswer Earliest();
  Profile DescribeScene() const;
  std::size_t agents() const { return index_.size(); }
  std::size_t queued() const { return queue_.size() + pairs_due_.size() + expiries_.size(); }

  Instant now_ = Instant::Always();
  DetectorCounters counters_;
  PairTable pairs_;
  Announcer announcer_;

 private:
  struct IdHash {
    std::size_t operator()(const AgentId& id) const;
  };
  struct EarliestSearch;  // in detector_earliest.cc

  /// The first that an agent meets of those that are not tracked.
  struct Next {
    Instant key = Instant::Never();
    std::uint32_t partner = 0;
  };

  /// A question is about one group of Restlessness::GroupOf(), or about all.
  static constexpr int kEverybody = -1;

  /// The order of ~key is that of the keys from the last to the first.
  static Instant Reversed(Instant key) { return Instant::FromNanoseconds(~key.nanoseconds()); }
  /// Of Horizon(); one more is Never().
  static constexpr int kHorizons = 24;

  AgentRecord* Find(const AgentId& id);
  AgentRecord& At(std::uint32_t agent) { return *agents_[agent]; }
  const AgentRecord& At(std::uint32_t agent) const { return *agents_[agent]; }
  Instant AnnounceUntil() const { return numeric::AddRoundedDown(now_, options_.announce_within); }

  // Updates (detector_update.cc).
  void Store(std::uint32_t agent, const motion::SpaceTimeBound& bound, Link link);
  UpdateOutcome Return(std::uint32_t agent, const motion::SpaceTimeBound& next,
                       Instant effective_from);
  UpdateOutcome Jump(std::uint32_t agent, const motion::SpaceTimeBound& next,
                     Instant effective_from);
  UpdateOutcome Keep(std::uint32_t agent, const motion::SpaceTimeBound& next,
                     const motion::ContractCheck& check, Instant effective_from);
  void Break(std::uint32_t agent, const motion::SpaceTimeBound& next, Instant effective_from);
  void Put(std::uint32_t agent);
  void Narrow(std::uint32_t agent);
  void NoteBound(std::uint32_t agent);
  void NoteChanged(std::uint32_t agent);
  void Touch(std::uint32_t agent);
  void Renew(std::uint32_t agent, Instant from, ClearanceCause cause, Instant effective_from);
  static void NoteCause(ClearanceCause cause, const AgentId& by, Instant void_from,
                        AgentRecord* record);
  void Tell(std::uint32_t agent, std::uint32_t cause);

  // One step (detector_step.cc).
  void ExpireAll();
  void Expire(std::uint32_t agent, bool gone);
  void Leave(std::uint32_t agent);
  void ForgetPast();

  // Asking the broad phase (detector_ask.cc).
  void AskAll();
  void Ask(std::uint32_t agent);
  void AskEverybody(std::uint32_t agent);
  bool NeedOnlyAskRestless(std::uint32_t agent) const;
  void AskRestless(std::uint32_t agent);
  Next AskAbout(int group, std::uint32_t agent, bool renewed, bool was_saturated, Instant covered);
  Instant DueUntil(const AgentRecord& agent) const;
  bool TracksAll(std::uint32_t agent, int group) const;
  bool IsCrowded(std::uint32_t agent, Instant from, bool was_saturated);
  Next AskBroadPhase(std::uint32_t agent, Instant from, bool renewed, bool was_saturated,
                     Instant covered);
  void FindMeetings(std::uint32_t agent, Instant from, Instant horizon);
  Next FindKey(std::uint32_t agent, Instant from, Instant known);
  void FindNext(std::uint32_t agent, Instant from, Instant known, Instant horizon);
  Next FirstFound() const;
  Instant Horizon(int step) const;
  void NoteHorizon(Instant key);
  int& horizon() { return horizons_[asker_][std::max(asking_, 0)]; }
  void TakeMeetings(std::uint32_t agent, bool renewed, bool was_saturated, Instant covered);
  void NoteKeys(std::uint32_t agent);
  static Instant DueAt(const AgentRecord& agent);
  /// Up to which the agent is certified free of the partner, if they are not tracked.
  Instant KeyOf(std::uint32_t agent, std::uint32_t partner) const {
    const AgentKeys& keys = At(agent).keys;
    if (!restlessness_.Divides(agent)) return keys.first();
    return keys.of(restlessness_.GroupOf(partner, agent));
  }
  void LowerKeyOf(std::uint32_t agent, std::uint32_t partner, Instant when);
  void SettleKeys();
  void Saturate(std::uint32_t agent, std::uint32_t partner);
  void Unsaturate(std::uint32_t agent);
  std::size_t RoomFor(const AgentRecord& agent) const;
  bool IsFull(std::uint32_t agent) const { return full_[agent] || pairs_.room() == 0; }
  void NoteFull(std::uint32_t agent);
  void MarkTracked(const AgentRecord& agent);
  bool Marked(std::uint32_t partner) const { return marks_[partner] == mark_; }
  bool IsLeftOut(std::uint32_t agent, std::uint32_t partner) const {
    if (Marked(partner)) return true;
    return asking_ != kEverybody && restlessness_.GroupOf(partner, agent) != asking_;
  }

  // What a renewal makes of others' keys (detector_lower.cc).
  void LowerKeys(std::uint32_t agent, Instant from);
  std::uint64_t LowerNearKeys(std::uint32_t agent, Instant from, Instant horizon);
  std::uint64_t LowerFarKeys(std::uint32_t agent, Instant from, Instant next);
  void LowerKey(std::uint32_t partner, std::uint32_t agent, Instant when);
  void AskFarKeysAnew();
  void TellIfLowered(std::uint32_t agent, Instant before);

  // What lies before the newest states (detector_uncovered.cc).
  void TrackUncovered(std::uint32_t agent, bool renewed, Instant covered);
  void TrackIfUncovered(std::uint32_t agent, std::uint32_t partner, bool renewed, Instant covered);
  void FindAround(std::uint32_t agent, Instant from);
  double OwnReach(const motion::SpaceTimeBound& motion, Instant from) const;
  Instant UncoveredFrom(const AgentRecord& a, const AgentRecord& b, Instant covered) const;
  bool FreeOver(const AgentRecord& a, const AgentRecord& b, Instant from, Instant to);

  // Tracked pairs (detector_pairs.cc).
  void TurnAll();
  void TurnSharing();
  void ShareOut();
  WorkClaim ClaimOf(std::uint32_t slot) const;
  void Turn(std::uint32_t slot, std::uint64_t allowed, bool last);
  void Judge(std::uint32_t slot, bool last, ContactTracker* preview, WorkBudget* work);
  void NoteContactAhead(const ContactTracker& preview, PairRecord* pair) const;
  void NoteDue(std::uint32_t slot);
  Instant RestOf(std::uint32_t slot, const ContactTracker& preview) const;
  double Patience(const AgentRecord& agent) const;
  Instant SettledUntil(const AgentRecord& agent) const;
  void Track(std::uint32_t a, std::uint32_t b, Instant free_until, bool began_before);
  bool Untrack(std::uint32_t slot);
  void Drop(std::uint32_t slot, bool gone);
  void Release(std::uint32_t slot);

  DetectorOptions options_;
  std::unordered_map<AgentId, std::uint32_t, IdHash> index_;  // never walked over
  std::vector<std::unique_ptr<AgentRecord>> agents_;          // by index; null: free
  std::vector<std::uint32_t> free_;
  broad_phase::AdaptiveBroadPhase broad_phase_;
  std::uint64_t broad_queries_seen_ = 0;
  FormerMotions former_;
  SceneExtremes extremes_;
  SceneProfile scene_;
  std::uint64_t step_ = 0;
  std::uint64_t removals_ = 0;

  EventQueue queue_;  // agents by the time at which they must be asked again
  /// Agents by their keys of the calm, the latest first (as ~key), of those not asked about
  /// everybody and not renewed in this step.
  EventQueue latest_;
  KeyRows key_rows_;
  std::uint64_t looks_ = 0;    // partners looked at beside the filters' tests
  EventQueue expiries_;        // agents by expiry
  EventQueue pairs_due_;       // pairs by the time from which they are judged every step
  EventQueue pairs_earliest_;  // pairs by PairRecord::not_before, of those not in contact

  // What has happened since the last step, or the last TakeChangedClearances().
  std::vector<std::uint32_t> renewed_;  // in the order of their renewal
  std::vector<std::uint32_t> changed_;
  std::vector<std::uint32_t> touched_;
  std::vector<std::uint32_t> saturated_;  // in no order that counts
  std::vector<std::uint32_t> fresh_;      // asked since the last SettleKeys()

  // Kept for their memory.
  std::vector<broad_phase::Neighbour> found_;
  std::vector<std::uint32_t> candidates_, slots_, first_;
  std::vector<int> groups_;           // that an agent is asked about by themselves
  std::vector<WorkClaim> claims_;     // of slots_
  std::vector<std::uint64_t> given_;  // likewise
  WorkShares work_shares_;
  std::vector<std::uint64_t> marks_;  // by agent: == mark_ if a tracked partner of who asks
  std::uint64_t mark_ = 0;
  bool many_ = false;          // are renewed in this step
  Restlessness restlessness_;  // of what they declared at their last renewals
  int asking_ = kEverybody;
  int asker_ = 0;  // the class of who is asked
  // Questions for keys begin with Horizon(horizon()), by asker_ and asking_.
  std::array<std::array<int, Restlessness::kClasses>, Restlessness::kClasses> horizons_{};
  int split_ = 4;                          // keys beyond Horizon(split_) are lowered one by one
  std::uint32_t crowded_[2] = {~0u, ~0u};  // the last agent that was saturated, and with whom
  bool crowd_ = false;                     // the agent last asked was saturated
  std::vector<std::uint8_t> full_;         // by agent: as many tracked pairs as it may have
};

}  // namespace collision::detection
