// A simulator's connection to the shared world.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "collision/environment.h"
#include "collision/export.h"
#include "collision/notice.h"
#include "collision/types.h"

namespace collision::client {

/// What a World that is destroyed does with its agents.
enum class OnLeave {
  kRemove,  ///< They leave with it, as if each had been destroyed.
  kLeave    ///< They stay with the service, as if this process had been killed.
};

/// How a simulator connects to its world.
struct WorldOptions {
  std::string world = DefaultWorld();  ///< 1 to 64 of [A-Za-z0-9_-].
  std::string simulator =
      {};  ///< Unique in the world, 1-64 of [A-Za-z0-9_-]; names your agents' owner.
  std::uint32_t domain = DefaultDomain();  ///< DDS domain, 0-230.
  /// Folder of this simulator's credentials in a secured world, as collisionctl make-certificates
  /// makes it; empty: it has none. All worlds and monitors of a process in one DDS domain have the
  /// same one (docker/SECURITY.md).
  std::string credentials = DefaultCredentials();
  /// Label of the frame in which positions are told, at most 64 bytes; empty: not stated. A service
  /// whose world states another one is refused, and refuses this simulator.
  std::string frame = {};
  bool lock_step = true;  ///< False: real time; stamps are since 1970, and nobody waits.
  /// The first run that it tries; 0: tenths of a second since 2020 (UTC), modulo 2^32. Each start
  /// of a simulator has a higher run than the last: if the service has a higher one of an earlier
  /// start, this one takes the next after it.
  std::uint32_t run = 0;
  /// Tells two programs of one name apart; 0: drawn at random. For tests.
  std::uint32_t incarnation = 0;
  /// True: of the states that are set, send those that the service needs (Clearance::
  /// state_wanted_ns), and those that the last one sent no longer stands in for: the agent jumped,
  /// was described anew, declares something else, or left what it promised. The simulator sets
  /// every state all the same. False: send each state that is set, as a stream.
  bool on_demand = true;
  /// In real time: send a state this long before the service wants it. The default covers the
  /// way there and back on a busy local network (10 ms each for 99 of 100 samples) and a step of
  /// the service in between. In lock-step the world's time waits for both. At most 1 h.
  std::chrono::nanoseconds lead{50'000'000};
  /// States per sample, 1 to 64: 1 for rare updates, 6 on lossy links (one Ethernet frame), 64 at
  /// full speed. 0: 1 on demand, else 64.
  std::uint32_t chunk_size = 0;
  OnLeave on_leave = OnLeave::kRemove;
  /// Levels of the service's configuration whose events are told beside contacts (Event::level). A
  /// name that is not configured there tells nothing.
  std::vector<std::string> levels = {};
  /// In real time: the clock that stamps are taken from, in nanoseconds since 1970. By it the
  /// service measures how far they are off. Empty: the system's.
  std::function<std::int64_t()> wall_clock = {};
};

enum class Advance { kReached, kTimeout };

class Agent;
class Transport;

/// The connection of one simulator. Movable, not copyable.
///
/// Threads: the members of a World and of its agents may be called from one thread at a time.
/// Callbacks run on that thread, inside Poll() and AdvanceTo() only (OnNotice() also inside
/// WaitForService() and Join()), so none runs after the destructor.
///
/// A staged state is sent with the first clock that is not below its stamp, if the service needs it
/// by then (WorldOptions::on_demand). In lock-step the loop is: compute the states at t, stage them
/// with Agent::SetState(), AdvanceTo(t).
///
/// An Agent's destructor removes the agent, and so does that of its World, unless
/// WorldOptions::on_leave is kLeave: then the agents stay with the service, their bounds grow, and
/// in lock-step the world's time waits, until another program takes over the simulator's name.
class COLLISION_API World {
 public:
  /// Throws std::runtime_error if an option is out of range or DDS is not available.
  static World Connect(const WorldOptions& options);

  /// The same over another network than DDS, for tests.
  static World Connect(const WorldOptions& options, std::unique_ptr<Transport> transport);

  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  /// Waits until a service of this world is alive. False: not within `timeout`.
  bool WaitForService(std::chrono::nanoseconds timeout);

  /// Announces an agent (with the next Publish(), AdvanceTo() or Poll()) and stages its first
  /// state. Throws std::invalid_argument with field, value and range for what the service would
  /// refuse: not finite, out of range, name too long. Two agents may have one name: the id tells
  /// them apart, and a tool that is given the name says that it is that of two. Throws
  /// std::length_error if the simulator has 65536 agents already.
  Agent AddAgent(const AgentDescription& description, const State& state);

  /// Sets states[i] of agents[i] for each i in turn, as Agent::SetState() does, in one call. Throws
  /// std::invalid_argument if there are not as many states as agents, or for an agent of another
  /// World, before any is set; and what SetState() throws, "states[i]: " in front: those before i
  /// are set then.
  void SetStates(std::span<const Agent> agents, std::span<const State> states);

  /// Lock-step, before the first clock: asks what time it is. The world's time waits there until
  /// this simulator has told its first clock: set the states of its agents as they are then, and
  /// AdvanceTo() that time. So nobody else has to reckon with where they may have been before. A
  /// world whose time has not begun begins at 0. In real time it is what the clock shows, at
  /// once. nullopt: no answer within `timeout`; call again, or Finish() to give it up. Throws
  /// std::logic_error after the first clock.
  std::optional<std::int64_t> Join(std::chrono::nanoseconds timeout);

  /// Writes the staged states with stamps up to `clock_ns`, then the clock, which promises that
  /// everything up to `clock_ns` has been sent. With an unchanged clock it writes what is new at
  /// this instant, if anything. Throws std::invalid_argument if the clock goes backward or, in
  /// lock-step, beyond what is granted; the first clock of a run may be any. In real time a
  /// clock that goes back, because it was set, sends nothing until it has caught up or the service
  /// has begun another epoch, and all states are to be set anew; and until the service has a jump
  /// it is told no later clock than that of the jump.
  void Publish(std::int64_t clock_ns);

  /// Lock-step: takes in what has arrived, says that the next step is at `clock_ns`, waits until
  /// the service has granted time up to there, and writes the staged states with stamps up to it.
  /// Events are delivered meanwhile: all that follow from what everybody has told so far, so that a
  /// run with the same simulators has the same events at the same steps. Forecasts come last, of
  /// each pair the newest, when the step is reached. What a callback stages counts from this step
  /// on. The first clock of a run is 0, or what is granted. In real time this publishes and
  /// never waits.
  /// kTimeout: the grant did not arrive within `timeout` of wall time. The clock stands at
  /// clock_ns(), what is staged for later stays staged, and a further call continues; it may not
  /// name an earlier step, since others have gone on in reliance on this one.
  Advance AdvanceTo(std::int64_t clock_ns, std::chrono::nanoseconds timeout);

  /// Lock-step: no step follows. The world's time waits for this simulator no longer; its agents
  /// stay, as their last states say, until they are removed. A World that leaves no agents says so
  /// when it is destroyed.
  void Finish();

  /// The last clock published; INT64_MIN before the first.
  std::int64_t clock_ns() const;

  /// Never decreases; INT64_MIN before the first grant.
  std::int64_t granted_until_ns() const;

  /// Whether the world runs in lock-step (false: in real time); nullopt until its service has said.
  std::optional<bool> world_lock_step() const;

  /// Takes in what has arrived, waits at most `timeout` for an arrival, and runs the callbacks.
  /// With a timeout above 0, in lock-step after AdvanceTo(), it says that nothing more of this time
  /// follows: the service can judge it, and tells its events. Without one that is said by the next
  /// AdvanceTo().
  void Poll(std::chrono::nanoseconds timeout = std::chrono::nanoseconds(0));

  /// Calls back for events about this simulator's agents, contacts and forecasts alike: each
  /// revision that tells something new once. Those of levels come where WorldOptions::levels names
  /// them; those of hypothetical agents say so (Event::hypothetical). When a grant counts, the
  /// contacts that the service published before it have been delivered, or count as missed. Without
  /// a callback they are kept until TakeEvents(): at most 65536, then the oldest are dropped and
  /// counted by events_lost(). A callback may call everything but WaitForService(), Join(),
  /// AdvanceTo() and Poll(), which throw std::logic_error.
  void OnEvent(std::function<void(const Event&)> callback);
  std::vector<Event> TakeEvents();
  std::uint64_t events_lost() const;

  /// Calls back when the clearance of an agent of this simulator was lowered, with the newest
  /// cause, and when earlier promises to it are void (Clearance::void_from_ns; INT64_MIN: all, with
  /// CAUSE_SKEW since a clock was set, with CAUSE_NONE since the service has ended the run). The
  /// service repeats each until it has arrived.
  /// Callbacks as for OnEvent().
  void OnClearanceLowered(std::function<void(const AgentId&, const Clearance&)> callback);
  void OnVoid(std::function<void(const AgentId&, const Clearance&)> callback);

  /// Calls back when nothing was heard of the service for 2 s, and when one is heard again, which
  /// may be another one. Without the service promises expire (Clearance::expires_ns), and in
  /// lock-step none goes beyond what is granted. Poll() and AdvanceTo() notice it.
  void OnServiceLost(std::function<void()> callback);
  void OnServiceBack(std::function<void()> callback);

  /// Contacts of the whole world, confirmed, ended or undecided, that were published while this
  /// simulator was there and that the network lost: 0 for one that never stops longer than about
  /// 10 s. Those of its own agents may be among them.
  std::uint64_t contacts_missed() const;

  /// Lock-step: calls back when that changes for which the world's time waits, with all names;
  /// empty: nothing. It waits for a simulator that has died, or that was granted time and does not
  /// move (`clock.waiting_after_s` of the service), and for shapes ("shape 1a2b3c4d", from their
  /// hashes) that are sent or whose trees are built. Rules as for OnEvent().
  void OnWaiting(std::function<void(const std::vector<std::string>&)> callback);

  /// Calls back for what the user of this simulator should know: no service is heard, it runs with
  /// a clock of the other kind, time waits for somebody, something is refused
  /// (collision/notice.h). Each cause is told once, what lasts again every 60 s, and what is over
  /// once. Empty, as at the start: they go to standard error, "SIMULATOR: TEXT". They are noticed
  /// and told inside Poll(), AdvanceTo(), WaitForService() and Join(), which pass on what the
  /// callback throws. Otherwise the rules are those of OnEvent().
  void OnNotice(std::function<void(const Notice&)> callback);

  /// What has been set and sent so far.
  const Traffic& traffic() const;

  /// Why nothing counts that this simulator sends: another program of its name is alive. It waits
  /// until that has ended, and then takes over by itself, with a new run if need be: its agents
  /// have other ids then. Empty: it does not wait.
  std::string waits_for_name() const;

  /// The name of an agent of this simulator, or of one that it has met in an event, also after it
  /// has left; else the id of its simulator and its slot: "5d0c8a8b6f6f1d2e:3".
  std::string Name(const AgentId& id) const;

  /// Why nothing counts any more that this simulator sends: an operator has evicted it, or has
  /// restarted the world's time. Its promises are void. Only another World comes back. Empty: none
  /// has.
  std::string ended_because() const;

  /// What the service refuses of this simulator now, as it last said: the first 16.
  std::vector<Rejection> standing_refusals() const;

  /// What the service refused since the last call; at most 1024, then the oldest are dropped.
  std::vector<Rejection> TakeRejections();

 private:
  friend class Agent;
  class COLLISION_HIDDEN Implementation;
  explicit World(std::shared_ptr<Implementation> implementation);
  std::shared_ptr<Implementation> implementation_;
};

/// A handle to one agent of this simulator. Movable, not copyable; the destructor removes the agent
/// from the world. A handle that outlives its World does nothing.
class COLLISION_API Agent {
 public:
  Agent(Agent&&) noexcept;
  Agent& operator=(Agent&&) noexcept;
  ~Agent();

  /// Its run changes when the simulator takes another one.
  AgentId id() const;

  /// Stages a state in place of the one staged before; it stays a discontinuity if that one was.
  /// Publish() or AdvanceTo() sends it when the clock reaches its stamp or, on demand, when it is
  /// needed after that. Throws std::invalid_argument as AddAgent() does, for a stamp before that of
  /// the last state sent and, in lock-step, for a discontinuity before the next step, if that has
  /// been announced: others rely on it (AdvanceTo(), Poll()).
  void SetState(const State& state);

  /// Announces a changed description. A wider bound counts from clearance().effective_from_ns on
  /// once clearance().description_counts: in real time, when all others have heard of it. A
  /// narrower one counts from the next state on: set one before the next Publish().
  /// Throws std::invalid_argument as AddAgent() does, and where it would make a real agent
  /// hypothetical or the other way about.
  void SetDescription(const AgentDescription& description);

  /// The newest clearance received; before the first one, a clearance that promises nothing.
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
