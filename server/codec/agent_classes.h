// The classes of agents that a configuration names, as the groups of the core.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "collision_core/broad_phase/collision_filter.h"
#include "idl/config.pb.h"

namespace collision::server {

/// Gives each class a group. An agent without a class has the core's default filter and meets all;
/// two classes meet if either of the two lists the other.
class AgentClasses {
 public:
  AgentClasses() = default;
  /// Unchecked: the configuration is valid (CheckConfig()).
  explicit AgentClasses(const v1::Config& config);

  /// Group and mask of the class; the default of no class. nullopt: there is no such class.
  std::optional<broad_phase::CollisionFilter> FilterOf(const std::string& name) const;

  /// The names of all classes for a refusal: "person, robot", or "none is configured".
  std::string Names() const;

 private:
  std::map<std::string, broad_phase::CollisionFilter> filters_;
};

}  // namespace collision::server
