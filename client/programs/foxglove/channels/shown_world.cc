#include "client/programs/foxglove/channels/shown_world.h"

#include <algorithm>
#include <utility>

#include "idl/identity.h"

namespace collision::client {

AlertLevel LevelOf(const v1::CollisionEvent& event, std::int64_t now_ns) {
  const v1::TimeBracket& begin = event.begin();
  const bool is_soon = begin.earliest_ns() < now_ns + kSoonNs;
  if (event.status() == v1::EVENT_CONFIRMED) {
    const bool has_begun = begin.latest_ns() <= now_ns;
    if (has_begun) return event.level().empty() ? AlertLevel::kContact : AlertLevel::kSoon;
    return is_soon ? AlertLevel::kSoon : AlertLevel::kPossible;
  }
  return is_soon && IsExpectedToTouch(event) ? AlertLevel::kSoon : AlertLevel::kPossible;
}

bool IsExpectedToTouch(const v1::CollisionEvent& event) {
  return event.status() == v1::EVENT_CONFIRMED ||
         (event.status() == v1::EVENT_POSSIBLE && event.has_expected() &&
          event.expected().outcome() == v1::EXPECTED_TOUCH);
}

void ShownWorld::TakeAll(const Scene& scene) {
  agents_.clear();
  there_ = 0;
  is_crowded_ = false;
  open_.clear();
  const auto count = static_cast<std::uint32_t>(scene.states().agents().size());
  for (std::uint32_t number = 0; number < count; ++number) TakeAgent(scene, number);
  for (const std::uint64_t number : scene.events().Numbers()) TakeEvent(scene, number);
  FindCrowd();
  FindLevels(scene);
}

void ShownWorld::Take(const Scene& scene, const SceneChanges& changes) {
  for (const SceneChanges::Slot& slot : changes.agents) {
    if (const auto number = scene.NumberOf(slot)) TakeAgent(scene, *number);
  }
  for (const std::uint64_t number : changes.events.dropped) open_.erase(number);
  for (const std::uint64_t number : changes.events.changed) TakeEvent(scene, number);
  FindCrowd();
  FindLevels(scene);
}

void ShownWorld::TakeAgent(const Scene& scene, std::uint32_t number) {
  if (number >= agents_.size()) agents_.resize(number + 1);
  ShownAgent& shown = agents_[number];
  const StateTable::Agent& place = scene.states().agents()[number];
  const auto agent = scene.view().Newest(place.simulator, place.slot);
  const bool is_there = agent && IsHeld(*agent);
  if (is_there && !shown.is_there) ++there_;
  if (!is_there && shown.is_there) --there_;
  const AlertLevel level = shown.level;
  shown = ShownAgent();
  shown.is_there = is_there;
  shown.level = level;
  if (!is_there) return;
  const v1::AgentDescription& description = agent->description;
  shown.is_half_space = description.has_half_space();
  shown.never_moves = description.acceleration_max_m_s2() == 0 &&
                      description.angular_acceleration_max_rad_s2() == 0 &&
                      !description.shape_hash().empty();
  shown.radius = description.radius_m();
  shown.frame = scene.view().SimulatorName(place.simulator) + "/" + description.agent_name();
  shown.shape = description.shape_hash();
}

void ShownWorld::TakeEvent(const Scene& scene, std::uint64_t number) {
  const EventBook::Entry& entry = scene.events().At(number);
  const v1::EventStatus status = entry.newest.status();
  const bool is_open = status == v1::EVENT_POSSIBLE || status == v1::EVENT_CONFIRMED;
  if (is_open && !entry.is_superseded) {
    open_.insert(number);
  } else {
    open_.erase(number);
  }
}

void ShownWorld::FindCrowd() {
  if (there_ > kAgentsApartMax) is_crowded_ = true;
  if (there_ < kAgentsFew) is_crowded_ = false;
}

void ShownWorld::FindLevels(const Scene& scene) {
  const auto& status = scene.view().status();
  frame_ = status && !status->frame().empty() ? status->frame() : "world";
  std::vector<AlertLevel> levels(agents_.size(), AlertLevel::kCalm);
  for (const std::uint64_t number : open_) {
    const v1::CollisionEvent& event = scene.events().At(number).newest;
    const AlertLevel level = LevelOf(event, scene.now_ns());
    for (const v1::AgentId& id : {event.lower(), event.higher()}) {
      const auto agent = scene.NumberOf({id.simulator_id(), id.slot()});
      if (agent && *agent < levels.size()) levels[*agent] = std::max(levels[*agent], level);
    }
  }
  releveled_.clear();
  for (std::uint32_t number = 0; number < agents_.size(); ++number) {
    if (std::exchange(agents_[number].level, levels[number]) == levels[number]) continue;
    releveled_.push_back(number);
  }
}

}  // namespace collision::client
