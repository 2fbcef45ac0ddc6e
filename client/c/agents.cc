#include "client/c/agents.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace collision::client::c {

collision_agent NumberedAgents::Add(Agent agent) {
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(places_.size()));
    places_.emplace_back();
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  Place& place = places_[index];
  place.agent.emplace(std::move(agent));
  ++place.use;
  return collision_agent{place.use} << 32 | index;
}

const Agent& NumberedAgents::At(collision_agent number) const {
  const std::size_t index = number & 0xffffffff;
  if (index < places_.size() && places_[index].use == number >> 32 && places_[index].agent) {
    return *places_[index].agent;
  }
  throw std::invalid_argument("agent: " + std::to_string(number) +
                              ", allowed: one that was added to this world and not removed");
}

Agent& NumberedAgents::At(collision_agent number) {
  return const_cast<Agent&>(std::as_const(*this).At(number));
}

void NumberedAgents::Remove(collision_agent number) {
  At(number);
  const std::size_t index = number & 0xffffffff;
  places_[index].agent.reset();
  free_.push_back(static_cast<std::uint32_t>(index));
}

}  // namespace collision::client::c
