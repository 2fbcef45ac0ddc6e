#include "client/programs/tools/suggest_bounds/motion_samples.h"

#include <stdexcept>

#include "client/library/network/conversion.h"
#include "client/library/validation.h"

namespace collision::client {

void MotionSamples::Take(const v1::AgentDescription& description) {
  SampledAgent& agent = agents_[{description.simulator_id(), description.run(), description.slot(),
                                 description.generation()}];
  agent.simulator = description.simulator_name();
  agent.name = description.agent_name();
  agent.declared = {description.acceleration_max_m_s2(), description.jerk_max_m_s3()};
}

void MotionSamples::Take(const v1::AgentStates& states) {
  for (const v1::AgentState& message : states.states()) {
    if (full()) return;
    SampledAgent& agent =
        agents_[{states.simulator_id(), states.run(), message.slot(), message.generation()}];
    if (!agent.samples.empty() && message.stamp_ns() <= agent.samples.back().stamp_ns) continue;
    const State state = FromMessage(message);
    try {
      Validate(state);
    } catch (const std::invalid_argument& error) {
      if (refused_++ == 0) first_refusal_ = "agent " + agent.name + ": " + error.what();
      continue;
    }
    agent.samples.push_back({state.stamp_ns, state.position_m, state.velocity_m_s,
                             state.orientation, state.angular_velocity_rad_s, state.discontinuity});
    ++samples_;
  }
}

std::vector<SampledAgent> MotionSamples::Agents() const {
  std::vector<SampledAgent> agents;
  for (const auto& [key, agent] : agents_) {
    if (agent.samples.empty()) continue;
    agents.push_back(agent);
    if (agent.name.empty()) agents.back().name = "slot " + std::to_string(std::get<2>(key));
  }
  return agents;
}

}  // namespace collision::client
