#include "tests/network/listener.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <system_error>

#include "client/library/network/message_monitor.h"

namespace collision::network {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kStopCheck{50};

/// Moves the calling thread, and those that it will start, into a network namespace.
void Enter(const std::string& network_namespace) {
  const std::string path = "/run/netns/" + network_namespace;
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int error = descriptor < 0 || setns(descriptor, CLONE_NEWNET) != 0 ? errno : 0;
  if (descriptor >= 0) close(descriptor);
  if (error != 0) throw std::system_error(error, std::generic_category(), path);
}

/// What is heard goes into `heard`, under `mutex`.
client::MessageMonitor::Callbacks Into(Heard* heard, std::mutex* mutex) {
  client::MessageMonitor::Callbacks callbacks;
  callbacks.event = [=](const v1::CollisionEvent& event) {
    const std::scoped_lock lock(*mutex);
    heard->observations.events.push_back(event);
    heard->now_ns = std::max<std::int64_t>(heard->now_ns, event.now_ns());
  };
  callbacks.description = [=](const v1::AgentDescription& description) {
    v1::AgentName name;
    name.mutable_id()->set_simulator_id(description.simulator_id());
    name.mutable_id()->set_run(description.run());
    name.mutable_id()->set_slot(description.slot());
    name.mutable_id()->set_generation(description.generation());
    name.set_simulator(description.simulator_name());
    name.set_agent(description.agent_name());
    const std::scoped_lock lock(*mutex);
    const bool is_new = heard->agents.emplace(name.id().SerializeAsString(), name.agent()).second;
    if (is_new) heard->observations.names.push_back(name);
  };
  callbacks.earliest = [=](const v1::EarliestIntersection& sample) {
    const std::scoped_lock lock(*mutex);
    heard->observations.earliest.push_back(sample);
  };
  callbacks.clearance = [=](const v1::Clearance& sample) {
    const std::scoped_lock lock(*mutex);
    heard->observations.clearances.push_back(sample);
    heard->now_ns = std::max<std::int64_t>(heard->now_ns, sample.now_ns());
  };
  callbacks.status = [=](const v1::ServiceStatus& status) {
    const std::scoped_lock lock(*mutex);
    heard->observations.status = status;
    heard->statuses.push_back(
        {steady_clock::now(), status.service_id(), status.stamp().term(), status.followers() > 0});
    if (!status.simulators().empty())
      heard->now_ns = std::max<std::int64_t>(heard->now_ns, status.now_ns());
  };
  return callbacks;
}

}  // namespace

Listener::Listener(const std::string& network_namespace, const std::string& profile,
                   const client::MonitorOptions& world) {
  // The whole process has one environment; no other thread of it reads that now.
  setenv("CYCLONEDDS_URI", ("file://" + profile).c_str(), 1);
  thread_ = std::jthread([this, network_namespace, world](const std::stop_token& stop) {
    try {
      Listen(stop, network_namespace, world);
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      failure_ = std::current_exception();
      arrived_.notify_all();
    }
  });
  std::unique_lock lock(mutex_);
  arrived_.wait(lock, [this] { return ready_ || failure_; });
  if (failure_) std::rethrow_exception(failure_);
}

Listener::~Listener() {
  thread_.request_stop();
  thread_.join();
}

void Listener::Listen(const std::stop_token& stop, const std::string& network_namespace,
                      const client::MonitorOptions& world) {
  Enter(network_namespace);
  client::MessageMonitor monitor(world, Into(&heard_, &mutex_));
  {
    const std::scoped_lock lock(mutex_);
    ready_ = true;
  }
  arrived_.notify_all();
  while (!stop.stop_requested()) {
    if (monitor.Poll(kStopCheck) == 0) continue;
    const std::scoped_lock lock(mutex_);
    heard_.contacts_missed = monitor.contacts_missed();
    arrived_.notify_all();
  }
}

bool Listener::WaitUntil(const std::function<bool(const Heard&)>& condition,
                         std::chrono::nanoseconds patience) {
  std::unique_lock lock(mutex_);
  return arrived_.wait_for(lock, patience, [&] { return condition(heard_); });
}

Heard Listener::heard() const {
  const std::scoped_lock lock(mutex_);
  return heard_;
}

}  // namespace collision::network
