#include "server/recording/newest_inputs.h"

#include <algorithm>
#include <set>
#include <utility>

namespace collision::server {
namespace {

constexpr std::uint64_t kBytesOfAgent = 2000;       // description and state, most with short names
constexpr std::uint64_t kBytesOfSimulator = 20000;  // hello and clock

/// A clock that does not wait for what has arrived.
std::string Settled(const std::string& serialised, const PresentSimulator& simulator) {
  v1::Input input;
  if (!input.ParseFromString(serialised)) return serialised;
  v1::SimulatorClock& clock = *input.mutable_simulator_clock();
  if (clock.states_sequence() <= simulator.states_seen) clock.set_states_sequence(0);
  if (clock.descriptions_sequence() <= simulator.descriptions_seen) {
    clock.set_descriptions_sequence(
        std::min(clock.descriptions_sequence(), simulator.descriptions_sequence));
  }
  return input.SerializeAsString();
}

}  // namespace

std::uint64_t NewestBytesMax(const v1::Config& config) {
  return config.shape_bytes_max() + config.agents_max() * kBytesOfAgent +
         config.simulators_max() * kBytesOfSimulator;
}

void NewestInputs::Take(const v1::Input& input, std::string serialised) {
  const std::uint64_t sender = input.sender();
  Kept kept{.serialised = std::move(serialised)};
  switch (input.message_case()) {
    case v1::Input::kSimulatorHello:
      return Put({input.simulator_hello().simulator_id(), sender, Kind::kHello, 0, 0, ""}, kept);
    case v1::Input::kAgentDescription: {
      const v1::AgentDescription& agent = input.agent_description();
      kept.run = agent.run();
      kept.generation = agent.generation();
      return Put({agent.simulator_id(), sender, Kind::kDescription, agent.slot(), 0, ""}, kept);
    }
    case v1::Input::kAgentRemoval: {
      const v1::AgentRemoval& agent = input.agent_removal();
      return Erase({agent.simulator_id(), sender, Kind::kDescription, agent.slot(), 0, ""});
    }
    case v1::Input::kShapePart: {
      const v1::ShapePart& part = input.shape_part();
      kept.run = part.run();
      kept.shape = part.content_hash();
      return Put({part.simulator_id(), sender, Kind::kShape, part.shape(), part.part(), ""}, kept);
    }
    case v1::Input::kShapeRemoval: {
      const v1::ShapeRemoval& part = input.shape_removal();
      return Erase({part.simulator_id(), sender, Kind::kShape, part.shape(), part.part(), ""});
    }
    case v1::Input::kAgentStates: {
      const v1::AgentStates& chunk = input.agent_states();
      kept.run = chunk.run();
      return Put({chunk.simulator_id(), sender, Kind::kStates, chunk.chunk(), 0, ""}, kept);
    }
    case v1::Input::kSimulatorClock:
      kept.run = input.simulator_clock().run();
      return Put({input.simulator_clock().simulator_id(), sender, Kind::kClock, 0, 0, ""}, kept);
    case v1::Input::kShapeReady:
      return Put({0, 0, Kind::kReady, 0, 0, input.shape_ready().content_hash()}, kept);
    case v1::Input::kLiveliness:    // the service knows who is gone
    case v1::Input::kServiceHeard:  // repeated every second
    case v1::Input::kEventHeard:    // for a standby
    case v1::Input::kOperatorCommand:
    case v1::Input::kWatch:
    case v1::Input::MESSAGE_NOT_SET:
      return;
  }
}

void NewestInputs::Put(const Key& key, Kept kept) {
  removed_.erase(key);
  kept.turn = turn_;
  const auto known = kept_.find(key);
  const std::uint64_t before =
      known == kept_.end() ? 0 : known->second.serialised.size() + kOverhead;
  const std::uint64_t bytes = bytes_ - before + kept.serialised.size() + kOverhead;
  if (bytes > bytes_max_ && bytes > bytes_) {
    ++left_out_;
    if (known == kept_.end()) return;
    bytes_ -= before;
    kept_.erase(known);  // it is no longer the newest
    return;
  }
  if (bytes > bytes_) new_bytes_ += bytes - bytes_;
  bytes_ = bytes;
  if (known != kept_.end()) {
    known->second = std::move(kept);
  } else {
    kept_.emplace(key, std::move(kept));
  }
}

void NewestInputs::Erase(const Key& key) {
  const auto known = kept_.find(key);
  if (known != kept_.end()) {
    bytes_ -= known->second.serialised.size() + kOverhead;
    kept_.erase(known);
  }
  if (follows_ && bytes_ + removed_.size() * kOverhead < bytes_max_) removed_.insert(key);
}

void NewestInputs::Take(NewestInputs* later) {
  for (const Key& key : later->removed_) Erase(key);
  for (auto& [key, kept] : later->kept_) Put(key, std::move(kept));
  left_out_ += later->left_out_;
  *later = NewestInputs(later->bytes_max_, true);
}

bool NewestInputs::IsPresent(const Key& key, const Kept& kept,
                             const std::map<std::uint64_t, PresentSimulator>& present) const {
  const Kind kind = std::get<2>(key);
  const auto found = present.find(std::get<0>(key));
  if (found == present.end()) return kept.turn == turn_;
  const PresentSimulator& simulator = found->second;
  if (std::get<1>(key) != simulator.sender) return false;
  if (kind == Kind::kHello) return true;
  if (kept.run != simulator.run) return false;
  if (kind == Kind::kClock) return simulator.is_in_time;
  if (kind != Kind::kDescription) return true;
  return std::ranges::binary_search(simulator.agents, std::pair(std::get<3>(key), kept.generation));
}

void NewestInputs::Keep(const std::map<std::uint64_t, PresentSimulator>& present) {
  std::set<std::string> shapes;
  for (auto next = kept_.begin(); next != kept_.end();) {
    auto& [key, kept] = *next;
    if (std::get<2>(key) == Kind::kReady || IsPresent(key, kept, present)) {
      if (!kept.shape.empty()) shapes.insert(kept.shape);
      const auto owner = present.find(std::get<0>(key));
      if (std::get<2>(key) == Kind::kClock && owner != present.end()) {
        bytes_ -= kept.serialised.size();
        kept.serialised = Settled(kept.serialised, owner->second);
        bytes_ += kept.serialised.size();
      }
      ++next;
      continue;
    }
    bytes_ -= kept.serialised.size() + kOverhead;
    next = kept_.erase(next);
  }
  std::erase_if(kept_, [&](const auto& one) {
    const bool is_over =
        std::get<2>(one.first) == Kind::kReady && !shapes.contains(std::get<5>(one.first));
    if (is_over) bytes_ -= one.second.serialised.size() + kOverhead;
    return is_over;
  });
  present_bytes_ = 0;
  for (const auto& [key, kept] : kept_) {
    if (present.contains(std::get<0>(key)) || std::get<2>(key) == Kind::kReady)
      present_bytes_ += kept.serialised.size() + kOverhead;
  }
  removed_.clear();
  new_bytes_ = 0;
  ++turn_;
}

void NewestInputs::Visit(const std::function<void(const std::string&)>& visit) const {
  for (const auto& [key, kept] : kept_) {
    if (std::get<2>(key) != Kind::kReady) visit(kept.serialised);
  }
}

void NewestInputs::VisitReady(const std::function<void(const std::string&)>& visit) const {
  for (const auto& [key, kept] : kept_) {
    if (std::get<2>(key) == Kind::kReady) visit(kept.serialised);
  }
}

}  // namespace collision::server
