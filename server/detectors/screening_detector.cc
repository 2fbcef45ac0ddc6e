#include "server/detectors/screening_detector.h"

#include "server/codec/hypothetical.h"

namespace collision::server {
namespace {

/// The declaration, which says of a real agent that it is one.
detection::AgentDeclaration WithSide(detection::AgentDeclaration declaration) {
  if (!IsHypothetical(declaration)) declaration.filter.side = kRealSide;
  return declaration;
}

}  // namespace

ScreeningDetector::ScreeningDetector(const detection::DetectorOptions& options,
                                     const detection::Detector& contacts)
    : detector_(options) {
  contacts.ForEachAgent([this](const detection::HeldAgent& held) {
    const Instant stamp = held.state.stamp;
    detector_.Admit(held.id, WithSide(held.in_force), held.state, stamp);
    detector_.Redeclare(held.id, WithSide(held.declared), stamp);
    detector_.SetHeardUntil(OwnerOf(held.id), held.heard_until);
  });
}

bool ScreeningDetector::Admit(const detection::AgentId& id,
                              const detection::AgentDeclaration& declaration,
                              const motion::MotionState& state, Instant effective_from) {
  if (!detector_.Admit(id, WithSide(declaration), state, effective_from)) return false;
  if (server::IsHypothetical(declaration)) {
    hypothetical_.insert(id);
    is_over_ = false;
  }
  return true;
}

bool ScreeningDetector::Redeclare(const detection::AgentId& id,
                                  const detection::AgentDeclaration& declaration,
                                  Instant effective_from) {
  return detector_.Redeclare(id, WithSide(declaration), effective_from);
}

bool ScreeningDetector::Remove(const detection::AgentId& id) {
  hypothetical_.erase(id);
  return detector_.Remove(id);
}

void ScreeningDetector::Advance(Instant now, const std::function<void()>& progress) {
  detector_.Advance(now, progress);
  is_over_ = hypothetical_.empty() && detector_.departing() == 0 && detector_.pairs_tracked() == 0;
}

std::vector<detection::AgentClearance> ScreeningDetector::TakeChangedClearances() {
  std::vector<detection::AgentClearance> changed = detector_.TakeChangedClearances();
  std::erase_if(changed, [this](const auto& one) { return !IsHypothetical(one.agent); });
  return changed;
}

}  // namespace collision::server
