#include "collision_core/detection/detector.h"

#include "collision_core/detection/detector_implementation.h"

namespace collision::detection {

Detector::Detector(const DetectorOptions& options)
    : implementation_(std::make_unique<Implementation>(options)) {}
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;
Detector::~Detector() = default;

bool Detector::Admit(const AgentId& id, const AgentDeclaration& declaration,
                     const motion::MotionState& state, Instant effective_from) {
  return implementation_->Admit(id, declaration, state, effective_from);
}
UpdateOutcome Detector::Update(const AgentId& id, const motion::MotionState& state,
                               Instant effective_from) {
  return implementation_->Update(id, state, effective_from);
}

motion::BrokenBound Detector::ExplainLastBreach() const {
  return implementation_->ExplainLastBreach();
}
bool Detector::Redeclare(const AgentId& id, const AgentDeclaration& declaration,
                         Instant effective_from) {
  return implementation_->Redeclare(id, declaration, effective_from);
}
bool Detector::Remove(const AgentId& id) { return implementation_->Remove(id); }
const motion::MotionState* Detector::StateOf(const AgentId& id) const {
  return implementation_->StateOf(id);
}
void Detector::ForEachAgent(const std::function<void(const HeldAgent&)>& use) const {
  implementation_->ForEachAgent(use);
}
void Detector::SetHeardUntil(const OwnerId& owner, Instant until, Instant still_until) {
  implementation_->SetHeardUntil(owner, until, still_until);
}
void Detector::SetPairShare(const OwnerId& owner, const Share& share) {
  implementation_->SetPairShare(owner, share);
}
void Detector::VoidOwner(const OwnerId& owner, Instant from) {
  implementation_->VoidOwner(owner, from);
}
void Detector::Advance(Instant now, const std::function<void()>& progress) {
  implementation_->Advance(now, progress);
}
const std::vector<CollisionEvent>& Detector::events() const {
  return implementation_->pairs().events();
}
std::vector<AgentClearance> Detector::TakeChangedClearances() {
  return implementation_->TakeChangedClearances();
}
std::optional<AgentClearance> Detector::ClearanceOf(const AgentId& id) const {
  return implementation_->ClearanceOf(id);
}
EarliestAnswer Detector::Earliest(std::size_t queries_max) const {
  return implementation_->Earliest(queries_max);
}
bool Detector::HasRoomForHalfSpace() const {
  return implementation_->agents().half_spaces() < kHalfSpacesMax;
}
std::size_t Detector::agents() const { return implementation_->agents().size(); }
std::size_t Detector::departing() const { return implementation_->agents().departing(); }
std::size_t Detector::pairs_tracked() const { return implementation_->pairs().table().size(); }
std::size_t Detector::pairs_waiting() const { return implementation_->pairs().waiting(); }
std::vector<OwnerWork> Detector::owner_work() const {
  return implementation_->pairs().owner_work();
}
std::size_t Detector::queued() const { return implementation_->queued(); }
const DetectorCounters& Detector::counters() const { return implementation_->counters(); }
Detector::Profile Detector::profile() const { return implementation_->DescribeScene(); }
void Detector::Validate() const { implementation_->Validate(); }

}  // namespace collision::detection
