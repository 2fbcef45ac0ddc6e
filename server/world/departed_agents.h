// Agents that have just left.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "collision_core/base/instant.h"
#include "collision_core/detection/events/agent_id.h"
#include "idl/messages.pb.h"

namespace collision::server {

/// An agent that is removed stays in the detector up to the time that its owner has told, and may
/// meet others there: until then it is known here, for the events: its label, and that it has left.
/// One thread.
class DepartedAgents {
 public:
  /// More are not kept; what they still meet is then told without their names, unless it was told
  /// as possible before.
  static constexpr std::size_t kDepartedMax = 65536;

  /// The agent is told of up to `until`.
  void Add(const detection::AgentId& id, const std::shared_ptr<const v1::AgentLabel>& label,
           Instant until) {
    if (departed_.size() >= kDepartedMax) return;
    if (departed_.try_emplace(id, Departed{label, until}).second) queue_.emplace(until, id);
  }

  /// Up to when the agent is told of; nullopt: it has not left, or that is not kept.
  std::optional<Instant> ToldUntil(const detection::AgentId& id) const {
    const auto found = departed_.find(id);
    if (found == departed_.end()) return std::nullopt;
    return found->second.told_until;
  }

  /// Null: it is not kept.
  std::shared_ptr<const v1::AgentLabel> Find(const detection::AgentId& id) const {
    const auto found = departed_.find(id);
    return found != departed_.end() ? found->second.label : nullptr;
  }

  /// All events up to and including this time have been found.
  void ForgetUntil(Instant now) {
    while (!queue_.empty() && queue_.begin()->first <= now) {
      departed_.erase(queue_.begin()->second);
      queue_.erase(queue_.begin());
    }
  }

  void Clear() {
    departed_.clear();
    queue_.clear();
  }

 private:
  struct Departed {
    std::shared_ptr<const v1::AgentLabel> label;
    Instant told_until;
  };

  std::map<detection::AgentId, Departed> departed_;
  std::set<std::pair<Instant, detection::AgentId>> queue_;
};

}  // namespace collision::server
