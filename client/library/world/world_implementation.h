// The implementation of World and Agent.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "client/api/world.h"
#include "client/library/network/current_service.h"
#include "client/library/network/transport.h"
#include "client/library/world/agent_table.h"
#include "client/library/world/revision_filter.h"
#include "client/library/world/service_echo.h"
#include "client/library/world/shape_publisher.h"

namespace collision::client {

inline constexpr std::size_t kEventsMax = 65536;     ///< Kept without a callback.
inline constexpr std::size_t kRejectionsMax = 1024;  ///< Kept until they are taken.

/// Period of repeating the clock while waiting for a grant: a service that counted this simulator
/// as dead (it was stopped for longer than the liveliness lease) notices that it is back.
inline constexpr std::chrono::milliseconds kRepeatPeriod(500);

/// The state of a World.
class World::Implementation {
 public:
  Implementation(const WorldOptions& options, std::unique_ptr<Transport> transport);

  bool WaitForService(std::chrono::nanoseconds timeout);
  AgentId AddAgent(const AgentDescription& description, const State& state);
  void SetState(const AgentId& id, const State& state);
  void SetDescription(const AgentId& id, const AgentDescription& description);
  void RemoveAgent(const AgentId& id);
  Clearance clearance(const AgentId& id) const { return agents_.clearance(id); }

  void Publish(std::int64_t clock_ns);
  Advance AdvanceTo(std::int64_t clock_ns, std::chrono::nanoseconds timeout);
  void Poll(std::chrono::nanoseconds timeout);

  /// The World is gone: no more callbacks, and agents' handles do nothing.
  void Close() { closed_ = true; }
  bool closed() const { return closed_; }

  std::int64_t clock_ns() const { return clock_ns_; }
  std::int64_t granted_until_ns() const { return granted_until_ns_; }

  std::optional<bool> simulated_clock() const { return simulated_clock_; }

  void OnEvent(std::function<void(const Event&)> callback) { on_event_ = std::move(callback); }
  std::vector<Event> TakeEvents();
  std::vector<Rejection> TakeRejections();
  std::uint64_t events_lost() const { return events_lost_; }
  const Traffic& traffic() const { return agents_.traffic(); }

 private:
  void RequireOutsideCallback(const char* function) const;
  void RequireForward(std::int64_t clock_ns) const;

  /// The latest clock that may be set now.
  std::int64_t Reachable() const;

  /// Writes what is due at this clock, then the clock, unless the service knows all of it already.
  void Send(std::int64_t clock_ns);
  void Repeat();
  v1::SimulatorClock Clock(std::int64_t clock_ns);
  /// Repeats everything: the service refused this simulator while another program of its name,
  /// perhaps its own predecessor, still counted as alive.
  void Reintroduce();
  void WriteDescription(const AgentId& id);

  /// Hands messages to the network.
  ShapePublisher::Writer Writer();

  /// Whether a sample with this stamp, as of `now_ns`, counts.
  bool Accept(const v1::ServiceStamp& stamp, std::int64_t now_ns, CurrentService::Time at);
  /// Wall clock: the service's clock was set, and it has forgotten all states.
  void BeginEpoch();

  /// Takes in what arrives within `timeout`, without callbacks.
  void Gather(std::chrono::nanoseconds timeout);
  void Handle(const v1::Output& output, CurrentService::Time now);
  void Handle(const v1::Clearance& clearance);
  void Handle(const v1::CollisionEvent& event);
  bool IsOwn(const v1::AgentId& id) const;

  /// Runs the callback for the events received.
  void Deliver();

  const std::uint64_t simulator_id_;
  const std::uint32_t run_;
  const bool lock_step_;
  std::unique_ptr<Transport> transport_;
  AgentTable agents_;
  ShapePublisher shapes_;
  CurrentService service_;
  RevisionFilter filter_;
  std::function<std::int64_t()> wall_clock_;
  ServiceEcho echo_;

  std::int64_t clock_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t granted_until_ns_ = std::numeric_limits<std::int64_t>::min();
  std::optional<bool> simulated_clock_;
  bool clock_published_ = false;
  /// Since the last Reintroduce() the service refused this sender: another one owns the name.
  bool name_refused_ = false;

  std::function<void(const Event&)> on_event_;
  std::deque<Event> events_;
  std::deque<Rejection> rejections_;
  std::uint64_t events_lost_ = 0;
  bool in_callback_ = false;
  bool closed_ = false;
};

}  // namespace collision::client
