// The names of agents of which a program has heard.
#pragma once

#include <cstddef>
#include <string>

#include "collision/types.h"
#include "collision_core/base/recent_map.h"
#include "idl/identity.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Of the agents heard of last, also after they have left. One thread.
class AgentNames {
 public:
  /// Names that are remembered; of more, those heard of longest ago are forgotten.
  static constexpr std::size_t kNamesMax = 16384;

  void Hear(const AgentId& id, const std::string& name) {
    if (!name.empty()) names_.Touch(id) = name;
  }

  /// Its name, or "simulator:slot" with the simulator's id if it is not known.
  std::string Of(const AgentId& id) {
    const std::string* name = names_.Find(id);
    return name != nullptr ? *name : IdText(id.simulator) + ":" + std::to_string(id.slot);
  }

 private:
  RecentMap<AgentId, std::string> names_{kNamesMax};
};

}  // namespace collision::client
