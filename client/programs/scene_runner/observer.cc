#include "client/programs/scene_runner/observer.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "client/library/network/conversion.h"
#include "collision/event_text.h"

namespace collision::client {
namespace {

using std::chrono::steady_clock;

constexpr std::size_t kStatesKept = 8192;  // samples per simulator: more than an event can lag
constexpr std::size_t kRejectionsKept = 20;
constexpr std::size_t kQuietLines = 200;  // printed events without a decision: more hide the others
constexpr std::chrono::milliseconds kProgressTerminal{200};
constexpr std::chrono::seconds kProgressFile{5};

}  // namespace

Observer::Observer(const ObserverOptions& options)
    : origin_ns_(options.origin_ns),
      end_ns_(options.end_ns),
      real_time_(options.real_time),
      every_event_(options.every_event),
      terminal_(isatty(STDOUT_FILENO) != 0),
      progress_at_(steady_clock::now()),
      monitor_({options.world, options.domain, true, true, options.credentials}, Callbacks()) {}

MessageMonitor::Callbacks Observer::Callbacks() {
  MessageMonitor::Callbacks callbacks;
  callbacks.event = [this](const v1::CollisionEvent& event) { Handle(event); };
  callbacks.description = [this](const v1::AgentDescription& description) { Handle(description); };
  callbacks.states = [this](const v1::AgentStates& states) { Handle(states); };
  callbacks.rejection = [this](const v1::Rejection& rejection) { Handle(rejection); };
  callbacks.earliest = [this](const v1::EarliestIntersection& sample) {
    if (IsOver(sample.stamp())) return;
    SeeTime(sample.now_ns());
    observations_.earliest.push_back(sample);
  };
  callbacks.clearance = [this](const v1::Clearance& sample) {
    if (IsOver(sample.stamp())) return;
    SeeTime(sample.now_ns());
    observations_.clearances.push_back(sample);
    // Most have no cause, and a swarm's would fill the memory.
    for (v1::AgentClearance& agent : *observations_.clearances.back().mutable_agents()) {
      if (agent.cause() == v1::CAUSE_NONE) agent.clear_cause_agent();
    }
  };
  callbacks.status = [this](const v1::ServiceStatus& status) {
    // Keep the last status with agents: later ones no longer describe the scene.
    if (status.agents() > 0 || observations_.status.agents() == 0) observations_.status = status;
    const bool has_begun = epoch_ || !status.simulators().empty();
    if (has_begun && IsOver(status.stamp())) return;
    if (!status.simulators().empty()) SeeTime(status.now_ns());
  };
  return callbacks;
}

std::size_t Observer::Poll(std::chrono::nanoseconds timeout) {
  const std::size_t samples = monitor_.Poll(timeout);
  PrintEvents(steady_clock::now());
  PrintProgress(false);
  std::fflush(stdout);  // also into a pipe, events show as they come
  return samples;
}

/// In lock-step the epoch of a scene ends when its simulators have flown to their end. What the
/// service told last in it may have been replaced before it was read.
bool Observer::IsOver(const v1::ServiceStamp& stamp) {
  if (!epoch_) epoch_ = stamp.epoch();
  if (real_time_ || stamp.epoch() <= *epoch_) return false;
  SeeTime(end_ns_);
  return true;
}

void Observer::SeeTime(std::int64_t now_ns) {
  now_ns_ = std::max(now_ns, now_ns_.value_or(now_ns));
  if (!began_at_ && *now_ns_ >= origin_ns_) began_at_ = steady_clock::now();
  if (!ended_at_ && *now_ns_ >= end_ns_) ended_at_ = steady_clock::now();
}

double Observer::running_seconds() const {
  if (!began_at_ || !ended_at_) return 0;
  return std::chrono::duration<double>(*ended_at_ - *began_at_).count();
}

void Observer::Handle(const v1::AgentDescription& description) {
  v1::AgentName name;
  name.mutable_id()->set_simulator_id(description.simulator_id());
  name.mutable_id()->set_run(description.run());
  name.mutable_id()->set_slot(description.slot());
  name.mutable_id()->set_generation(description.generation());
  name.set_simulator(description.simulator_name());
  name.set_agent(description.agent_name());
  const bool is_new = names_.emplace(FromMessage(name.id()), name.agent()).second;
  if (is_new) observations_.names.push_back(name);
}

void Observer::Handle(const v1::AgentStates& states) {
  std::int64_t newest = std::numeric_limits<std::int64_t>::min();
  for (const v1::AgentState& state : states.states())
    newest = std::max<std::int64_t>(newest, state.stamp_ns());
  auto& received = states_[states.simulator_id()];
  received.emplace_back(newest, steady_clock::now());
  if (received.size() > kStatesKept) received.pop_front();
}

void Observer::Handle(const v1::Rejection& rejection) {
  if (rejections_.size() >= kRejectionsKept) return;
  rejections_.push_back(v1::RejectionReason_Name(rejection.reason()) + " " + rejection.field() +
                        ": " + rejection.detail());
}

void Observer::Handle(const v1::CollisionEvent& event) {
  SeeTime(event.now_ns());
  observations_.events.push_back(event);
  if (!event.level().empty()) return pending_names_.Add(FromMessage(event), steady_clock::now());
  const ContactKey key{event.lower().SerializeAsString(), event.higher().SerializeAsString(),
                       event.contact()};
  const auto [status, is_new] = statuses_.try_emplace(key, event.status());
  if (!is_new && status->second == event.status()) return;
  status->second = event.status();
  ++counts_[event.status()];
  TimeEvent(event);
  pending_names_.Add(FromMessage(event), steady_clock::now());
}

void Observer::PrintEvents(Wall now) {
  const auto named = [this](const AgentId& id) { return names_.contains(id); };
  for (const Event& event : pending_names_.Take(named, now)) Print(event);
}

void Observer::Print(const Event& event) {
  const bool decided = IsDecided(event.status);
  if (quiet_) return;
  if (!decided && !every_event_ && quiet_lines_ >= kQuietLines) return;
  ClearProgress();
  const auto name = [this](const AgentId& id) { return NameOf(id); };
  std::printf("%s\n", EventLine(event, name, origin_ns_).c_str());
  if (decided || every_event_ || ++quiet_lines_ < kQuietLines) return;
  std::printf(
      "… further possible, dismissed and withdrawn events are only counted (--every-event shows "
      "them)\n");
}

void Observer::TimeEvent(const v1::CollisionEvent& event) {
  // A withdrawal does not follow from a state.
  if (event.status() == v1::EVENT_WITHDRAWN || event.now_ns() > end_ns_) return;
  std::optional<Wall> cause;
  for (const auto& [simulator, received] : states_) {
    const bool owner =
        simulator == event.lower().simulator_id() || simulator == event.higher().simulator_id();
    if (real_time_ && !owner) continue;
    const auto newest = std::find_if(received.rbegin(), received.rend(), [&](const auto& sample) {
      return sample.first <= event.now_ns();
    });
    if (newest != received.rend()) cause = std::max(newest->second, cause.value_or(newest->second));
  }
  if (!cause) return;
  latencies_.push_back(std::chrono::duration<double>(steady_clock::now() - *cause).count());
}

std::string Observer::NameOf(const AgentId& id) const {
  const auto found = names_.find(id);
  return found != names_.end() ? found->second : "agent " + std::to_string(id.slot);
}

void Observer::ClearProgress() {
  if (!progress_shown_) return;
  std::printf("\r\033[K");
  progress_shown_ = false;
}

void Observer::PrintProgress(bool final) {
  if (quiet_) return;
  const auto now = steady_clock::now();
  const auto period = terminal_
                          ? std::chrono::duration_cast<steady_clock::duration>(kProgressTerminal)
                          : std::chrono::duration_cast<steady_clock::duration>(kProgressFile);
  if (!final && now - progress_at_ < period) return;
  progress_at_ = now;
  ClearProgress();
  if (now_ns_ && *now_ns_ < origin_ns_) {
    std::printf("… starting at %s", InstantText(origin_ns_, 0, 3).c_str());
  } else if (now_ns_) {
    const auto time = SecondsText(*now_ns_, origin_ns_, 1);
    std::printf("… %s s, %zu agents, events: %zu possible, %zu confirmed, %zu ended", time.c_str(),
                names_.size(), counts_[v1::EVENT_POSSIBLE], counts_[v1::EVENT_CONFIRMED],
                counts_[v1::EVENT_ENDED]);
  } else {
    std::printf("… waiting for the simulators");
  }
  progress_shown_ = terminal_ && !final;
  if (!progress_shown_) std::printf("\n");
  std::fflush(stdout);
}

void Observer::FinishProgress() {
  PrintEvents(Wall::max());
  PrintProgress(true);
}

}  // namespace collision::client
