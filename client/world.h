// A simulator's side of the shared world.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/types.h"

namespace collision::client {

struct WorldOptions {
  std::string world = "default";  ///< 1-64 of [A-Za-z0-9_-].
  std::string simulator =
      {};  ///< Unique in the world, 1-64 of [A-Za-z0-9_-]; names your agents' owner.
  std::uint32_t domain = 0;  ///< DDS domain, 0-230.
  bool lock_step = true;     ///< False: stamps are wall-clock time and nobody waits.
  /// A restart takes a higher one; 0: tenths of a second since 2020 began (UTC), modulo 2^32, which
  /// grow until 2033.
  std::uint32_t run = 0;
  /// States go out when the service needs them (Clearance::state_wanted_ns), or when the last one told
  /// no longer stands in for them: the agent jumped, was described anew, declares something else,
  /// or leaves what it promised. A simulator sets every state all the same. False: each state set is
  /// sent, a stream.
  bool on_demand = true;
  /// Without lock-step: states leave so much before they are wanted. It covers the way there and back
  /// on a busy local network (10 ms each at most, but for one in a hundred) and the step of the
  /// service in between. In lock-step the world's time waits for both.
  std::chrono::nanoseconds lead{50'000'000};
  /// States per sample, 1 to 64: 1 for rare updates, 8 on lossy links, 64 at full speed. 0: 1 on demand,
  /// else 64.
  std::uint32_t chunk_size = 0;
};

enum class Advance { kReached, kTimeout };

class Agent;
class Transport;

/// The connection of one simulator. Movable, not copyable. All members, and those of its agents,
/// may be called from one thread at a time; callbacks come on that same thread, from inside Poll()
/// and AdvanceTo() only, so none comes after the destructor. Leaving without removing agents keeps
/// them growing in the service; an Agent's destructor removes it.
///
/// A staged state goes out with the first clock that is not less than its stamp, if it is needed by
/// then (WorldOptions::on_demand). In lock-step the loop is: compute the states at t,
/// Agent::SetState() them, AdvanceTo(t).
class World {
 public:
  /// Throws std::runtime_error if the options are out of range or DDS is not to be had.
  static World Connect(const WorldOptions& options);

  /// The same over another network than DDS.
  static World Connect(const WorldOptions& options, std::unique_ptr<Transport> transport);

  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  /// Waits until a service of this world is there. False: not within `timeout`.
  bool WaitForService(std::chrono::nanoseconds timeout);

  /// Announces an agent (with the next Publish(), AdvanceTo() or Poll()) and stages its first
  /// state. Throws std::invalid_argument, naming field, value and range, on what the service would
  /// refuse: not finite, negative, name too long. Throws std::length_error if 65536 agents are
  /// there.
  Agent AddAgent(const AgentDescription& description, const State& state);

  /// Writes the staged states with stamps up to `clock_ns`, then the clock: everything up to
  /// `clock_ns` has been told. With the clock unchanged it carries what is new at this instant, and
  /// writes nothing if nothing is. Throws std::invalid_argument if the clock goes backward or, in
  /// lock-step, beyond what is granted; a run's first clock may be any.
  void Publish(std::int64_t clock_ns);

  /// Lock-step: takes what has arrived, then moves the clock to `clock_ns` as the service grants
  /// it, through as many clocks between as there are grants. Events are delivered meanwhile; a
  /// state that a callback sets goes out next, at the same clock if its stamp has come. A run's
  /// first clock is 0, or what is granted. Without lock-step this publishes and never waits.
  /// kTimeout: the grant did not come in `timeout` of wall time; the clock stands at clock_ns(),
  /// what is staged for later stays staged, and a further call goes on.
  Advance AdvanceTo(std::int64_t clock_ns, std::chrono::nanoseconds timeout);

  /// The last clock published; INT64_MIN before the first.
  std::int64_t clock_ns() const;

  /// Grows only; INT64_MIN before the first grant.
  std::int64_t granted_until_ns() const;

  /// Has the service a simulated clock, as lock-step needs it? Nullopt before it has told.
  std::optional<bool> simulated_clock() const;

  /// Takes what has arrived, waiting at most `timeout` for something; runs the callbacks.
  void Poll(std::chrono::nanoseconds timeout = std::chrono::nanoseconds(0));

  /// Events that concern this simulator's agents, each revision once. Without a callback they
  /// gather (at most 65536, the oldest go first, counted) until TakeEvents(). Inside a callback
  /// everything may be called but WaitForService(), AdvanceTo() and Poll(), which throw
  /// std::logic_error.
  void OnEvent(std::function<void(const Event&)> callback);
  std::vector<Event> TakeEvents();
  std::uint64_t events_lost() const;

  /// What has been set and sent so far.
  const Traffic& traffic() const;

  /// What the service refused since the last call; of more than 1024 the oldest are gone.
  std::vector<Rejection> TakeRejections();

 private:
  friend class Agent;
  class Implementation;
  explicit World(std::shared_ptr<Implementation> implementation);
  std::shared_ptr<Implementation> implementation_;
};

/// A handle to one agent of this simulator. Movable, not copyable; the destructor removes the agent
/// from the world. A handle may outlive its World; then it does nothing, and the agent stays with
/// the service.
class Agent {
 public:
  Agent(Agent&&) noexcept;
  Agent& operator=(Agent&&) noexcept;
  ~Agent();

  const AgentId& id() const;

  /// Stages a state: Publish() or AdvanceTo() carries it when the clock comes to its stamp, on demand
  /// when it is needed after that, unless a newer one has taken its place; of several staged only the last, with a discontinuity if any of them had one. Throws
  /// std::invalid_argument as AddAgent() does, and for a stamp before the last one told.
  void SetState(const State& state);

  /// Announces a changed description; what widens holds after the service has acknowledged it, from
  /// clearance().effective_from_ns on. Throws std::invalid_argument as AddAgent() does.
  void SetDescription(const AgentDescription& description);

  /// The newest the service said; no promise before it said any.
  Clearance clearance() const;

 private:
  friend class World;
  Agent(std::weak_ptr<World::Implementation> world, const AgentId& id);
  std::shared_ptr<World::Implementation> Lock() const;
  void Remove() noexcept;
  std::weak_ptr<World::Implementation> world_;
  AgentId id_;
};

}  // namespace collision::client
