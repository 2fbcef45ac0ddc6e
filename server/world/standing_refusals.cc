#include "server/world/standing_refusals.h"

#include <algorithm>

namespace collision::server {

bool StandingRefusals::Stands(v1::RejectionReason reason) {
  switch (reason) {
    case v1::REJECTED_ID_OWNED:
    case v1::REJECTED_ID_MISMATCH:
    case v1::REJECTED_OLD_RUN:
    case v1::REJECTED_TOO_MANY_SIMULATORS:
      return false;
    default:
      return true;
  }
}

void StandingRefusals::Add(const Refusal& refusal) {
  ++revision_;
  const auto listed = listed_.find({refusal.topic, refusal.slot});
  if (listed != listed_.end()) {
    listed->second = refusal;
  } else if (listed_.size() < kStandingRefusalsMax) {
    listed_.emplace(Key(refusal.topic, refusal.slot), refusal);
  } else {
    ++unlisted_;
  }
}

void StandingRefusals::Accept(v1::InputTopic topic, std::uint32_t slot) {
  if (listed_.erase({topic, slot}) == 0) return;
  ++revision_;
  if (listed_.empty()) unlisted_ = 0;
}

void StandingRefusals::RemoveAgent(std::uint32_t slot) {
  for (const v1::InputTopic topic :
       {v1::TOPIC_AGENT_DESCRIPTION, v1::TOPIC_SHAPE, v1::TOPIC_AGENT_STATES}) {
    Accept(topic, slot);
  }
}

void StandingRefusals::Clear() {
  if (count() > 0) ++revision_;
  listed_.clear();
  unlisted_ = 0;
}

std::uint64_t StandingRefusals::descriptions() const {
  return unlisted_ + std::count_if(listed_.begin(), listed_.end(), [](const auto& entry) {
           return entry.first.first == v1::TOPIC_AGENT_DESCRIPTION;
         });
}

}  // namespace collision::server
