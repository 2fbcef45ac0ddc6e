#include "server/detectors/detectors.h"

#include <algorithm>

#include "server/codec/hypothetical.h"
#include "server/detectors/detector_options.h"

namespace collision::server {
namespace {

std::size_t DetectorsOf(const std::vector<Level>& levels) {
  std::size_t detectors = 0;
  for (const Level& level : levels) detectors += LevelDetector::DetectorsOf(level);
  return detectors;
}

detection::Detector& In(detection::Detector& one) { return one; }
template <typename Special>
detection::Detector& In(Special& one) {
  return one.detector();
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
  const auto admit = [&](auto& one) { return one.Admit(id, declaration, state, effective_from); };
  if (server::IsHypothetical(declaration)) return admit(Screening());
  if (!admit(contacts_)) return false;
  EachOther(admit);
  return true;
}

detection::UpdateOutcome Detectors::Update(const detection::AgentId& id,
                                           const motion::MotionState& state,
                                           Instant effective_from) {
  return Tell(id, [&](auto& one) { return In(one).Update(id, state, effective_from); });
}

bool Detectors::Redeclare(const detection::AgentId& id,
                          const detection::AgentDeclaration& declaration, Instant effective_from) {
  return Tell(id, [&](auto& one) { return one.Redeclare(id, declaration, effective_from); });
}

bool Detectors::Remove(const detection::AgentId& id) {
  return Tell(id, [&](auto& one) { return one.Remove(id); });
}

const motion::MotionState* Detectors::StateOf(const detection::AgentId& id) const {
  return DetectorOf(id).StateOf(id);
}

motion::BrokenBound Detectors::ExplainLastBreach(const detection::AgentId& id) const {
  return DetectorOf(id).ExplainLastBreach();
}

void Detectors::SetHeardUntil(const detection::OwnerId& owner, Instant until, Instant still_until) {
  Each([&](auto& one) { In(one).SetHeardUntil(owner, until, still_until); });
}

void Detectors::SetPairShare(const detection::OwnerId& owner, const Share& share) {
  Each([&](auto& one) { In(one).SetPairShare(owner, share); });
}

void Detectors::VoidOwner(const detection::OwnerId& owner, Instant from) {
  Each([&](auto& one) { In(one).VoidOwner(owner, from); });
}

void Detectors::AdvanceLevels(Instant now, const std::function<void()>& progress) {
  for (LevelDetector& level : levels_) level.Advance(now, progress);
}

// Its last events stay until then.
void Detectors::AdvanceScreening(Instant now, const std::function<void()>& progress) {
  if (screening_ && screening_->is_over()) screening_.reset();
  if (screening_) screening_->Advance(now, progress);
}

ScreeningDetector& Detectors::Screening() {
  if (!screening_) {
    screening_ = std::make_unique<ScreeningDetector>(ScreeningDetectorOptions(config_), contacts_);
  }
  return *screening_;
}

const detection::Detector& Detectors::DetectorOf(const detection::AgentId& id) const {
  return IsHypothetical(id) ? screening_->detector() : contacts_;
}

bool Detectors::IsHypothetical(const detection::AgentId& id) const {
  return screening_ && screening_->IsHypothetical(id);
}

void Detectors::BeginEpoch() {
  past_ += contacts_.counters();
  contacts_ = detection::Detector(DetectorOptionsOf(config_, level_detectors_));
  levels_.clear();
  AddLevels();
  screening_.reset();
}

std::size_t Detectors::agents() const {
  return contacts_.agents() + (screening_ ? screening_->hypothetical() : 0);
}

std::size_t Detectors::pairs_waiting() const {
  std::size_t waiting = contacts_.pairs_waiting();
  if (screening_) waiting += screening_->detector().pairs_waiting();
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
