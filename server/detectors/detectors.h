// Every detector of the service: of contacts, of the levels, and of hypothetical agents.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "collision_core/detection/detector.h"
#include "server/detectors/level_detector.h"
#include "server/detectors/screening_detector.h"

namespace collision::server {

/// Gives each input to the detector of contacts and to those of the levels, so that all have the
/// same agents, states and times. What an input does is decided by the first alone: clearances,
/// grants, outcomes. Without levels there is nothing else.
///
/// Hypothetical agents are in none of these: they have a detector of their own (ScreeningDetector),
/// which gets each input, too, and exists only while there are such agents. So whatever they do
/// changes nothing that is found or promised of others.
///
/// The inputs are those of detection::Detector, and so are the rules. One thread.
class Detectors {
 public:
  /// Requires a complete and valid configuration, which outlives this.
  explicit Detectors(const v1::Config& config);

  bool Admit(const detection::AgentId& id, const detection::AgentDeclaration& declaration,
             const motion::MotionState& state, Instant effective_from);
  detection::UpdateOutcome Update(const detection::AgentId& id, const motion::MotionState& state,
                                  Instant effective_from);
  bool Redeclare(const detection::AgentId& id, const detection::AgentDeclaration& declaration,
                 Instant effective_from);
  bool Remove(const detection::AgentId& id);
  /// As Detector::StateOf(), of an agent of either kind.
  const motion::MotionState* StateOf(const detection::AgentId& id) const;
  /// Of the agent whose Update() was the last one, and returned kBreached.
  motion::BrokenBound ExplainLastBreach(const detection::AgentId& id) const;
  void SetHeardUntil(const detection::OwnerId& owner, Instant until, Instant still_until);
  void SetPairShare(const detection::OwnerId& owner, const Share& share);
  void VoidOwner(const detection::OwnerId& owner, Instant from);

  /// Brings the levels to `now`. That of contacts comes first and is advanced by itself, so that
  /// what it finds leaves before the levels are looked at.
  void AdvanceLevels(Instant now, const std::function<void()>& progress);

  /// Brings the screening to `now`, if there is one; after the others.
  void AdvanceScreening(Instant now, const std::function<void()>& progress);

  /// All of them begin anew, without agents.
  void BeginEpoch();

  detection::Detector& contacts() { return contacts_; }
  const detection::Detector& contacts() const { return contacts_; }

  /// In the order of the configuration.
  std::vector<LevelDetector>& levels() { return levels_; }
  const std::vector<LevelDetector>& levels() const { return levels_; }

  /// Null: there are no hypothetical agents.
  ScreeningDetector* screening() { return screening_.get(); }
  const ScreeningDetector* screening() const { return screening_.get(); }

  /// Agents, real and hypothetical ones.
  std::size_t agents() const;

  /// Pairs of all detectors that wait for their evaluation.
  std::size_t pairs_waiting() const;

  /// What that of contacts has done in all epochs.
  detection::DetectorCounters counted() const;

 private:
  /// Makes the call to each detector behind that of contacts.
  template <typename Call>
  void EachOther(const Call& call) {
    for (LevelDetector& level : levels_) level.Each(call);
    if (screening_) call(*screening_);
  }
  template <typename Call>
  void Each(const Call& call) {
    call(contacts_);
    EachOther(call);
  }
  /// Makes the call to each detector that has the agent; returns what the one says that decides.
  template <typename Call>
  auto Tell(const detection::AgentId& id, const Call& call) {
    if (IsHypothetical(id)) return call(*screening_);
    const auto decided = call(contacts_);
    EachOther(call);
    return decided;
  }
  void AddLevels();
  ScreeningDetector& Screening();
  bool IsHypothetical(const detection::AgentId& id) const;
  /// The one that decides about the agent.
  const detection::Detector& DetectorOf(const detection::AgentId& id) const;

  const v1::Config& config_;
  detection::DetectorCounters past_;  ///< Of the epochs that are over.
  std::vector<Level> configured_;
  std::size_t level_detectors_ = 0;
  detection::Detector contacts_;
  std::vector<LevelDetector> levels_;
  std::unique_ptr<ScreeningDetector> screening_;
};

}  // namespace collision::server
