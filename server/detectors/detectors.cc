#include "server/detectors/detectors.h"

#include <algorithm>

#include "server/detectors/detector_options.h"

namespace collision::server {
namespace {

std::size_t DetectorsOf(const std::vector<Level>& levels) {
  std::size_t detectors = 0;
  for (const Level& level : levels) detectors += LevelDetector::DetectorsOf(level);
  return detectors;
}

}  // namespace

Detectors::Detectors(const v1::Config& config)
    : config_(config),
      configured_(LevelsOf(config)),
      level_detectors_(DetectorsOf(configured_)),
      contacts_(DetectorOptionsOf(config, level_detectors_)) {
  AddLevels();
}

void Detectors::AddLevels() {
  for (const Level& level : configured_) levels_.emplace_back(config_, level, level_detectors_);
}

bool Detectors::Admit(const detection::AgentId& id, const detection::AgentDeclaration& declaration,
                      const motion::MotionState& state, Instant effective_from) {
  if (!contacts_.Admit(id, declaration, state, effective_from)) return false;
  EachOfLevels([&](GrownDetector& one) { one.Admit(id, declaration, state, effective_from); });
  return true;
}

detection::UpdateOutcome Detectors::Update(const detection::AgentId& id,
                                           const motion::MotionState& state,
                                           Instant effective_from) {
  EachOfLevels([&](GrownDetector& one) { one.detector().Update(id, state, effective_from); });
  return contacts_.Update(id, state, effective_from);
}

bool Detectors::Redeclare(const detection::AgentId& id,
                          const detection::AgentDeclaration& declaration, Instant effective_from) {
  if (!contacts_.Redeclare(id, declaration, effective_from)) return false;
  EachOfLevels([&](GrownDetector& one) { one.Redeclare(id, declaration, effective_from); });
  return true;
}

bool Detectors::Remove(const detection::AgentId& id) {
  EachOfLevels([&](GrownDetector& one) { one.Remove(id); });
  return contacts_.Remove(id);
}

void Detectors::SetHeardUntil(const detection::OwnerId& owner, Instant until) {
  contacts_.SetHeardUntil(owner, until);
  EachOfLevels([&](GrownDetector& one) { one.detector().SetHeardUntil(owner, until); });
}

void Detectors::SetPairShare(const detection::OwnerId& owner, const Share& share) {
  contacts_.SetPairShare(owner, share);
  EachOfLevels([&](GrownDetector& one) { one.detector().SetPairShare(owner, share); });
}

void Detectors::VoidOwner(const detection::OwnerId& owner, Instant from) {
  contacts_.VoidOwner(owner, from);
  EachOfLevels([&](GrownDetector& one) { one.detector().VoidOwner(owner, from); });
}

void Detectors::AdvanceLevels(Instant now, const std::function<void()>& progress) {
  for (LevelDetector& level : levels_) level.Advance(now, progress);
}

void Detectors::BeginEpoch() {
  past_ += contacts_.counters();
  contacts_ = detection::Detector(DetectorOptionsOf(config_, level_detectors_));
  levels_.clear();
  AddLevels();
}

std::size_t Detectors::pairs_waiting() const {
  std::size_t waiting = contacts_.pairs_waiting();
  for (const LevelDetector& level : levels_) {
    level.Each([&](const GrownDetector& one) { waiting += one.detector().pairs_waiting(); });
  }
  return waiting;
}

detection::DetectorCounters Detectors::counted() const {
  detection::DetectorCounters counted = past_;
  counted += contacts_.counters();
  return counted;
}

}  // namespace collision::server
