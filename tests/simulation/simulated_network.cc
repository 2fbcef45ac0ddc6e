#include "tests/simulation/simulated_network.h"

#include <algorithm>
#include <utility>

namespace collision::server {
namespace {

/// Topic and instance of a message; descriptions and their disposals share both.
std::pair<int, std::string> AddressOf(const v1::Input& message) {
  const auto key = [](std::uint64_t simulator, std::uint64_t part) {
    return std::to_string(simulator) + "/" + std::to_string(part);
  };
  switch (message.message_case()) {
    case v1::Input::kAgentDescription:
      return {0,
              key(message.agent_description().simulator_id(), message.agent_description().slot())};
    case v1::Input::kAgentRemoval:
      return {0, key(message.agent_removal().simulator_id(), message.agent_removal().slot())};
    case v1::Input::kShapePart:
      return {1, message.shape_part().content_hash()};
    case v1::Input::kAgentStates:
      return {2, key(message.agent_states().simulator_id(), message.agent_states().chunk())};
    case v1::Input::kSimulatorClock:
      return {3, key(message.simulator_clock().simulator_id(), 0)};
    default:
      return {4, ""};
  }
}

}  // namespace

SimulatedNetwork::SimulatedNetwork(const NetworkOptions& options)
    : options_(options), random_(options.seed), random_of_reports_(options.seed) {}

void SimulatedNetwork::At(std::int64_t time_ns, std::function<void()> action) {
  occurrences_.push({std::max(time_ns, now_ns_), ++order_, std::move(action)});
}

std::int64_t SimulatedNetwork::Delay(Random* random) {
  const std::int64_t range = options_.delay_max_ns - options_.delay_min_ns + 1;
  return options_.delay_min_ns + static_cast<std::int64_t>(random->Below(range));
}

void SimulatedNetwork::Write(std::uint64_t sender, const v1::Input& message) {
  const auto [topic, instance] = AddressOf(message);
  v1::Input sent = message;
  sent.set_sender(sender);
  const WriterKey key(sender, topic);
  const std::uint64_t version = ++version_;
  writers_[key].history[instance] = {version, sent, !message.has_agent_removal()};
  Transmit(key, instance, sent, version);
}

void SimulatedNetwork::Transmit(const WriterKey& key, const std::string& instance,
                                const v1::Input& message, std::uint64_t version) {
  Writer& writer = writers_[key];
  std::int64_t arrival = now_ns_ + Delay(&random_);
  bool lost = false;
  while (random_.Chance(options_.loss)) {
    lost = true;
    arrival += options_.resend_ns;
  }
  arrival = writer.last_arrival_ns = std::max(arrival, writer.last_arrival_ns);
  At(arrival, [this, key, instance, message, version, lost] {
    const auto found = writers_.find(key);
    if (found == writers_.end()) return;
    if (lost && found->second.history[instance].version != version) return;
    Deliver(message, false);
    if (random_.Chance(options_.duplicate)) {
      At(now_ns_ + options_.resend_ns, [this, message] { Deliver(message, true); });
    }
  });
}

void SimulatedNetwork::Kill(std::uint64_t sender, std::uint64_t simulator_id) {
  std::erase_if(writers_, [sender](const auto& entry) { return entry.first.first == sender; });
  At(now_ns_ + options_.lease_ns, [this, sender, simulator_id] {
    v1::Input input;
    input.set_sender(sender);
    input.mutable_liveliness()->set_simulator_id(simulator_id);
    input.mutable_liveliness()->set_alive(false);
    Deliver(input, false);
  });
}

void SimulatedNetwork::Subscribe(std::function<void(const v1::Output&)> handler) {
  handlers_.push_back(std::move(handler));
}

void SimulatedNetwork::Attach(std::function<void(const v1::Input&, bool)> reader) {
  reader_ = std::move(reader);
  for (auto& [key, writer] : writers_) {
    for (auto& [instance, sample] : writer.history) {
      if (sample.present) Transmit(key, instance, sample.message, sample.version);
    }
  }
}

void SimulatedNetwork::PublishToAll(const v1::Output& output) {
  const bool is_report = output.has_simulator_report();
  std::int64_t& last_ns = is_report ? last_report_ns_ : last_output_ns_;
  last_ns = std::max(last_ns, now_ns_ + Delay(is_report ? &random_of_reports_ : &random_));
  At(last_ns, [this, output] {
    for (std::size_t i = 0; i < handlers_.size(); ++i) handlers_[i](output);
  });
}

bool SimulatedNetwork::RunOne(std::int64_t deadline_ns) {
  if (occurrences_.empty() || occurrences_.top().time_ns > deadline_ns) return false;
  const Occurrence next = occurrences_.top();
  occurrences_.pop();
  now_ns_ = next.time_ns;
  next.action();
  return true;
}

SimulatedBus::SimulatedBus(SimulatedNetwork* network) : network_(*network) {
  network_.Attach([this](const v1::Input& message, bool duplicate) { Take(message, duplicate); });
}

void SimulatedBus::Take(const v1::Input& message, bool duplicate) {
  const auto same = [&message](const v1::Input& other) {
    return other.sender() == message.sender() && other.message_case() == message.message_case() &&
           !message.has_agent_removal() && !message.has_liveliness() &&
           AddressOf(other) == AddressOf(message);
  };
  // A late duplicate is older than what it would replace.
  if (!duplicate) std::erase_if(inbox_, same);
  inbox_.push_back(message);
}

bool SimulatedBus::Receive(std::chrono::nanoseconds timeout, std::size_t limit,
                           std::vector<v1::Input>* inputs) {
  const std::int64_t deadline = network_.now_ns() + timeout.count();
  while (inbox_.empty() && network_.RunOne(deadline)) {
  }
  if (inbox_.empty() && network_.idle()) return false;
  if (inbox_.empty()) network_.SkipTo(deadline);
  // Whatever comes while the daemon wakes up belongs to the same batch.
  const std::int64_t awake = network_.now_ns() + 20'000;
  while (!inbox_.empty() && network_.RunOne(awake)) {
  }
  for (; !inbox_.empty() && inputs->size() < limit; inbox_.pop_front()) {
    inputs->push_back(std::move(inbox_.front()));
  }
  return true;
}

void SimulatedBus::Publish(const v1::Output& output) {
  published_.push_back(output);
  network_.PublishToAll(output);
}

}  // namespace collision::server
