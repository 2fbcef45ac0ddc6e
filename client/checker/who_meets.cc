#include "client/checker/who_meets.h"

#include <algorithm>

namespace collision::checker {
namespace {

// Whether the class lists the other one.
bool Lists(const v1::Config& config, const std::string& name, const std::string& other) {
  return std::any_of(
      config.classes().begin(), config.classes().end(), [&](const v1::AgentClass& one) {
        const auto& meets = one.meets();
        return one.name() == name && std::find(meets.begin(), meets.end(), other) != meets.end();
      });
}

bool IsPair(const std::string& first, const std::string& second, const std::string& a,
            const std::string& b) {
  return (first == a && second == b) || (first == b && second == a);
}

}  // namespace

bool CanMeet(const v1::Config& config, const AgentMotion& a, const AgentMotion& b) {
  const std::string name_a = a.simulator + "/" + a.agent, name_b = b.simulator + "/" + b.agent;
  for (const v1::ExcludedPair& pair : config.excluded()) {
    if (IsPair(pair.first(), pair.second(), name_a, name_b)) return false;
  }
  return a.class_name.empty() || b.class_name.empty() ||
         Lists(config, a.class_name, b.class_name) || Lists(config, b.class_name, a.class_name);
}

bool Watches(const v1::Level& level, const AgentMotion& a, const AgentMotion& b) {
  const auto& pairs = level.between();
  return pairs.empty() || std::any_of(pairs.begin(), pairs.end(), [&](const std::string& pair) {
           const std::size_t slash = pair.find('/');
           return slash != pair.npos &&
                  IsPair(pair.substr(0, slash), pair.substr(slash + 1), a.class_name, b.class_name);
         });
}

}  // namespace collision::checker
