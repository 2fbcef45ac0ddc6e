// What the detector tells: clearances and the profile of the scene.
#include <algorithm>

#include "collision_core/detection/detector_implementation.h"

namespace collision::detection {
namespace {

bool Same(const AgentClearance& a, const AgentClearance& b) {
  return a.clear_until == b.clear_until && a.not_clear == b.not_clear &&
         a.in_contact == b.in_contact && a.saturated == b.saturated &&
         a.unannounced_until == b.unannounced_until && a.unsettled_until == b.unsettled_until &&
         a.effective_from == b.effective_from;
}

}  // namespace

AgentClearance Detector::Implementation::Clearance(const AgentRecord& agent) const {
  AgentClearance clearance;
  clearance.agent = agent.id;
  clearance.effective_from = agent.effective_from;
  clearance.saturated = agent.saturated;
  clearance.clear_until = clearance.unannounced_until = agent.keys.first();
  for (const std::uint32_t slot : agent.pairs) {
    const PairRecord& pair = pairs_[slot];
    clearance.unsettled_until = std::max(clearance.unsettled_until, pair.unsettled_until);
    if (!pair.announced) {
      clearance.unannounced_until = std::min(clearance.unannounced_until, pair.clear_until);
    }
    if (pair.in_contact) {
      clearance.in_contact = true;
    } else {
      clearance.clear_until = std::min(clearance.clear_until, pair.clear_until);
    }
  }
  if (agent.expired) clearance.clear_until = agent.bound().state.expiry;
  if (agent.saturated) clearance.clear_until = std::min(clearance.clear_until, now_);
  clearance.not_clear = clearance.clear_until <= now_;
  return clearance;
}

// Only those whose key, pairs or contacts were touched can have changed, and the saturated, whose
// clearance is always now. In the order of the ids.
std::vector<AgentClearance> Detector::Implementation::TakeChangedClearances() {
  for (const std::uint32_t agent : saturated_) Touch(agent);
  std::erase_if(touched_, [this](std::uint32_t agent) {
    return !agents_[agent] || At(agent).leaving != 0 || !At(agent).touched;
  });
  std::sort(touched_.begin(), touched_.end(),
            [this](std::uint32_t a, std::uint32_t b) { return At(a).id < At(b).id; });
  std::vector<AgentClearance> changed;
  for (const std::uint32_t agent : touched_) {
    AgentRecord& record = At(agent);
    record.touched = false;
    AgentClearance clearance = Clearance(record);
    const bool lowered = record.told && clearance.clear_until < record.told->clear_until;
    if (!record.told || !Same(clearance, *record.told) || !record.void_from.is_never()) {
      if (!record.told || lowered || record.cause_agent == record.id) {
        clearance.cause = record.cause;
        clearance.cause_agent = record.cause_agent;
        clearance.void_from = record.void_from;
      }
      record.told = clearance;
      changed.push_back(clearance);
    }
    record.cause = ClearanceCause::kNone;
    record.cause_agent = AgentId{};
    record.void_from = Instant::Never();
  }
  touched_.clear();
  return changed;
}

std::optional<AgentClearance> Detector::Implementation::ClearanceOf(const AgentId& id) const {
  const auto found = index_.find(id);
  if (found == index_.end()) return std::nullopt;
  return Clearance(*agents_[found->second]);
}

Detector::Profile Detector::Implementation::DescribeScene() const {
  return {.broad_phase = Name(broad_phase_.method()),
          .why = broad_phase_.why(),
          .left_out = scene_.LeftOut()};
}

}  // namespace collision::detection
