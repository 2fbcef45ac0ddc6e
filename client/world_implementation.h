// What stands behind World and Agent.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "client/fleet.h"
#include "client/news.h"
#include "client/shape_book.h"
#include "client/transport.h"
#include "client/world.h"

namespace collision::client {

inline constexpr std::size_t kEventsMax = 65536;     ///< That gather without a callback.
inline constexpr std::size_t kRejectionsMax = 1024;  ///< That gather until they are taken.

/// While a grant is awaited the clock is repeated this often: a service that took us for dead (we were stopped
/// for longer than the liveliness lease) notices that we are back.
inline constexpr std::chrono::milliseconds kRepeatPeriod(500);

class World::Implementation {
 public:
  Implementation(const WorldOptions& options, std::unique_ptr<Transport> transport);

  bool WaitForService(std::chrono::nanoseconds timeout);
  AgentId AddAgent(const AgentDescription& description, const State& state);
  void SetState(const AgentId& id, const State& state);
  void SetDescription(const AgentId& id, const AgentDescription& description);
  void RemoveAgent(const AgentId& id);
  Clearance clearance(const AgentId& id) const { return fleet_.clearance(id); }

  void Publish(std::int64_t clock_ns);
  Advance AdvanceTo(std::int64_t clock_ns, std::chrono::nanoseconds timeout);
  void Poll(std::chrono::nanoseconds timeout);

  /// The world is gone: no callback any more, and agents' handles do nothing.
  void Close() { closed_ = true; }
  bool closed() const { return closed_; }

  std::int64_t clock_ns() const { return clock_ns_; }
  std::int64_t granted_until_ns() const { return granted_until_ns_; }

  std::optional<bool> simulated_clock() const { return simulated_clock_; }

  void OnEvent(std::function<void(const Event&)> callback) { on_event_ = std::move(callback); }
  std::vector<Event> TakeEvents();
  std::vector<Rejection> TakeRejections();
  std::uint64_t events_lost() const { return events_lost_; }
  const Traffic& traffic() const { return fleet_.traffic(); }

 private:
  void RequireOutsideCallback(const char* function) const;
  void RequireForward(std::int64_t clock_ns) const;

  /// How far the clock may be set now.
  std::int64_t Reachable() const;

  /// Writes what is due at this clock, then the clock, unless all of it is known already.
  void Tell(std::int64_t clock_ns);
  void Repeat();
  /// Says everything anew: the service refused us while another program of our name, perhaps our own
  /// predecessor, still counted as alive.
  void Introduce();
  void WriteDescription(const AgentId& id);

  /// Hands messages to the network.
  ShapeBook::Writer Writer();

  /// Takes what arrives within `timeout`, without callbacks.
  void Gather(std::chrono::nanoseconds timeout);
  void Hear(const v1::Output& output);
  void Hear(const v1::Clearance& clearance);
  void Hear(const v1::CollisionEvent& event);
  bool IsOwn(const v1::AgentId& id) const;

  /// Runs the callback for what has gathered.
  void Deliver();

  const std::uint64_t simulator_id_;
  const std::uint32_t run_;
  const bool lock_step_;
  std::unique_ptr<Transport> transport_;
  Fleet fleet_;
  ShapeBook shapes_;
  News news_;

  std::int64_t clock_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t granted_until_ns_ = std::numeric_limits<std::int64_t>::min();
  std::optional<bool> simulated_clock_;
  bool clock_published_ = false;
  bool refused_ = false;  ///< Since the last Introduce(): our name belongs to another sender.

  std::function<void(const Event&)> on_event_;
  std::deque<Event> events_;
  std::deque<Rejection> rejections_;
  std::uint64_t events_lost_ = 0;
  bool in_callback_ = false;
  bool closed_ = false;
};

}  // namespace collision::client
