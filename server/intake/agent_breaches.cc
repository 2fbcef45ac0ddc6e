#include "server/intake/agent_breaches.h"

#include <spdlog/fmt/fmt.h>

#include "server/process/logging.h"

namespace collision::server {
namespace {

/// The field of the IDL that declares a bound.
const char* FieldOf(motion::DeclaredBound bound) {
  switch (bound) {
    case motion::DeclaredBound::kAccelerationMax:
      return "acceleration_max_m_s2";
    case motion::DeclaredBound::kSpeedMax:
      return "speed_max_m_s";
    case motion::DeclaredBound::kAngularAccelerationMax:
      return "angular_acceleration_max_rad_s2";
    case motion::DeclaredBound::kThrustDirection:
      return "thrust_direction";
  }
  return "";
}

void LogBreach(const v1::AgentBreach& breach, const std::string& simulator) {
  LogAbout(
      spdlog::level::warn, "declared bound broken", simulator,
      fmt::format("simulator \"{}\" slot {} generation {} broke {}: declared {}, at least "
                  "{} seen between {} ns and {} ns, breach {} of this agent; detection "
                  "goes on from the new state. Declare wider bounds, or mark a jump as a "
                  "discontinuity",
                  simulator, breach.slot(), breach.generation(), breach.field(), breach.declared(),
                  breach.seen(), breach.from_ns(), breach.at_ns(), breach.count()));
}

}  // namespace

void AgentBreaches::Add(const Simulator& simulator, const detection::AgentId& agent,
                        std::uint64_t count) {
  EndPeriod();
  const auto told = told_.find({agent.simulator, agent.slot});
  if (told != told_.end() && told->second.message.run() == agent.run &&
      told->second.message.generation() == agent.generation) {
    told->second.count = count;
    is_behind_ = true;
    return;
  }
  if (told != told_.end() || !MayTell(agent.simulator)) return;
  const v1::AgentBreach message = MessageOf(simulator, agent, count);
  LogBreach(message, simulator.name());
  due_.push_back(message);
  ++told_of_[agent.simulator];
  told_.emplace(std::pair(agent.simulator, agent.slot), Told{message, count});
}

bool AgentBreaches::MayTell(std::uint64_t simulator) const {
  const auto of_one = told_of_.find(simulator);
  return told_.size() < kBreachesToldMax &&
         (of_one == told_of_.end() || of_one->second < kBreachesOfOneToldMax);
}

v1::AgentBreach AgentBreaches::MessageOf(const Simulator& simulator,
                                         const detection::AgentId& agent,
                                         std::uint64_t count) const {
  const motion::BrokenBound broken = detectors_.ExplainLastBreach(agent);
  v1::AgentBreach message;
  message.set_simulator_id(agent.simulator);
  message.set_slot(agent.slot);
  message.set_now_ns(world_.now().nanoseconds());
  message.set_run(agent.run);
  message.set_incarnation(simulator.incarnation());
  message.set_generation(agent.generation);
  message.set_field(FieldOf(broken.bound));
  message.set_declared(broken.declared);
  message.set_seen(broken.seen);
  message.set_from_ns(broken.from.nanoseconds());
  message.set_at_ns(broken.at.nanoseconds());
  message.set_count(count);
  return message;
}

void AgentBreaches::EndPeriod() {
  const std::int64_t period = world_.monotonic_ns() / kBreachPeriodNs;
  if (period == period_) return;
  period_ = period;
  for (auto& [key, told] : told_) {
    const auto simulator = world_.simulators().find(key.first);
    const bool is_there =
        simulator != world_.simulators().end() && simulator->second.run() == told.message.run();
    if (!is_there || told.count == told.message.count()) continue;
    told.message.set_count(told.count);
    told.message.set_now_ns(world_.now().nanoseconds());
    due_.push_back(std::move(told.message));
  }
  told_.clear();
  told_of_.clear();
  is_behind_ = false;
}

std::vector<v1::AgentBreach> AgentBreaches::Take() {
  EndPeriod();
  return std::exchange(due_, {});
}

std::optional<std::int64_t> AgentBreaches::NextDue() const {
  if (!is_behind_) return std::nullopt;
  return (period_ + 1) * kBreachPeriodNs;
}

}  // namespace collision::server
