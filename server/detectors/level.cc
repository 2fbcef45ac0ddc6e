#include "server/detectors/level.h"

#include "server/codec/agent_classes.h"
#include "server/config/config_blocks.h"

namespace collision::server {
namespace {

/// Whether the agents of a forecast may come within the margin if both keep the motion they told:
/// also where that is open, or a shape is awaited.
bool IsExpected(const detection::CollisionEvent& event) {
  return !event.expected || event.expected->outcome != detection::ExpectedOutcome::kPass;
}

}  // namespace

broad_phase::CollisionFilter Level::FilterOf(broad_phase::CollisionFilter own) const {
  if (between_all) return own;
  const auto found = partners.find(own.group);
  own.mask &= found != partners.end() ? found->second : 0;
  return own;
}

bool Level::Tells(const detection::CollisionEvent& event) const {
  return basis != v1::Level::EXPECTED || event.status != detection::EventStatus::kPossible ||
         IsExpected(event);
}

std::vector<Level> LevelsOf(const v1::Config& config) {
  const AgentClasses classes(config);
  std::vector<Level> levels;
  for (const v1::Level& block : config.levels()) {
    Level& level = levels.emplace_back();
    level.name = block.name();
    level.margin = block.margin_m();
    level.look_ahead = block.has_look_ahead_s() ? block.look_ahead_s() : config.announce_within_s();
    level.hysteresis = block.hysteresis_m();
    level.basis = block.basis();
    level.between_all = block.between().empty();
    for (const std::string& pair : block.between()) {
      const auto [first, second] = SplitAtSlash(pair);
      const std::uint32_t a = classes.FilterOf(first)->group, b = classes.FilterOf(second)->group;
      level.partners[a] |= b;
      level.partners[b] |= a;
    }
  }
  return levels;
}

}  // namespace collision::server
