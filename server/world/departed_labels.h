// What agents were called that have just left.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "collision_core/base/instant.h"
#include "collision_core/detection/events/agent_id.h"
#include "idl/messages.pb.h"

namespace collision::server {

/// An agent that is removed stays in the detector up to the time that its owner has told, and may
/// meet others there: until then its label is kept for the events. One thread.
class DepartedLabels {
 public:
  /// More are not kept; what they still meet is then told without their names, unless it was told
  /// as possible before.
  static constexpr std::size_t kDepartedMax = 65536;

  /// The agent is told of up to `until`.
  void Add(const detection::AgentId& id, const std::shared_ptr<const v1::AgentLabel>& label,
           Instant until) {
    if (labels_.size() >= kDepartedMax) return;
    if (labels_.try_emplace(id, label).second) queue_.emplace(until, id);
  }

  /// Null: it is not kept.
  std::shared_ptr<const v1::AgentLabel> Find(const detection::AgentId& id) const {
    const auto found = labels_.find(id);
    return found != labels_.end() ? found->second : nullptr;
  }

  /// All events up to and including this time have been found.
  void ForgetUntil(Instant now) {
    while (!queue_.empty() && queue_.begin()->first <= now) {
      labels_.erase(queue_.begin()->second);
      queue_.erase(queue_.begin());
    }
  }

  void Clear() {
    labels_.clear();
    queue_.clear();
  }

 private:
  std::map<detection::AgentId, std::shared_ptr<const v1::AgentLabel>> labels_;
  std::set<std::pair<Instant, detection::AgentId>> queue_;
};

}  // namespace collision::server
