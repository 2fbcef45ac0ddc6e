#include "server/codec/agent_classes.h"

namespace collision::server {
namespace {

/// Of names in a refusal, which its text has room for.
constexpr std::size_t kNamesBytesMax = 160;

/// The group of agents without a class, which every mask names.
constexpr std::uint32_t kDefaultGroup = 1;

}  // namespace

AgentClasses::AgentClasses(const v1::Config& config) {
  std::uint32_t group = kDefaultGroup;
  for (const v1::AgentClass& one : config.classes()) {
    filters_[one.name()] = {.group = group <<= 1, .mask = kDefaultGroup};
  }
  for (const v1::AgentClass& one : config.classes()) {
    for (const std::string& met : one.meets()) {
      filters_[one.name()].mask |= filters_[met].group;
      filters_[met].mask |= filters_[one.name()].group;
    }
  }
}

std::optional<broad_phase::CollisionFilter> AgentClasses::FilterOf(const std::string& name) const {
  if (name.empty()) return broad_phase::CollisionFilter();
  const auto found = filters_.find(name);
  if (found == filters_.end()) return std::nullopt;
  return found->second;
}

std::string AgentClasses::Names() const {
  if (filters_.empty()) return "none is configured";
  std::string names;
  for (const auto& [name, filter] : filters_) {
    if (names.size() + name.size() > kNamesBytesMax) {
      return names + ", ... (" + std::to_string(filters_.size()) + " in all)";
    }
    names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

}  // namespace collision::server
