// A read-only view of a world: what its simulators and its service publish.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "collision/environment.h"
#include "collision/export.h"
#include "collision/notice.h"
#include "collision/types.h"

namespace collision::client {

class MessageMonitor;
class Receiver;

/// Which world a monitor reads.
struct MonitorOptions {
  std::string world = DefaultWorld();      ///< 1 to 64 of [A-Za-z0-9_-].
  std::uint32_t domain = DefaultDomain();  ///< DDS domain, 0 to 230.
  /// Status, events, earliest intersection, clearances, rejections, breaches.
  bool service = true;
  bool simulators = false;  ///< Descriptions, removals, states and clocks of all simulators.
  std::string credentials = DefaultCredentials();  ///< As in WorldOptions.
};

/// An agent as its simulator describes it.
struct DescribedAgent {
  AgentId id;
  std::string simulator;         ///< Name of its owner.
  std::uint32_t revision = 0;    ///< Of the description; a higher one replaces a lower one.
  AgentDescription description;  ///< Its `shape` is null: a monitor receives the hash only.
  std::string shape_hash;        ///< SHA-256 of the shape, 32 bytes; empty: the agent is a ball.
};

/// A simulator's statement that everything up to `clock_ns` has been sent.
struct SimulatorClock {
  std::uint64_t simulator = 0;
  std::string name;
  std::uint32_t run = 0;
  std::int64_t clock_ns = 0;
  std::uint32_t agents = 0;  ///< Of this simulator.
  bool lock_step = false;    ///< False: real time.
};

/// What a simulator has of one of the limits of the world, and may have as things are.
struct QuotaUse {
  std::uint64_t used = 0;
  std::uint64_t most = 0;
};

/// What the service knows of one simulator.
struct SimulatorStatus {
  std::uint64_t simulator = 0;
  std::string name;
  std::uint32_t run = 0;
  bool alive = false;
  std::int64_t clock_ns = 0;
  std::int64_t granted_until_ns = 0;  ///< INT64_MIN: no time granted yet.
  std::uint32_t agents = 0;
  std::uint64_t states = 0;    ///< Accepted so far, in all runs.
  std::uint64_t rejected = 0;  ///< Samples refused so far.
  /// In real time: its clock less the service's is within [earliest_ns, latest_ns] for certain;
  /// INT64_MIN, INT64_MAX: not known.
  TimeBracket clock_offset{std::numeric_limits<std::int64_t>::min(), kNever};
  /// By resource (agents, shapes, shape_bytes, tree_bytes), those of which it has something.
  std::map<std::string, QuotaUse> quotas;
  std::uint32_t refused_now = 0;  ///< Of what it has written, as it stands.
  std::string refused_why;        ///< Of one of these: reason and field; empty: none.
};

/// Health and counters of the service, published every `status_period_s` (0.5 s by default) and
/// when simulators come or go.
struct ServiceStatus {
  std::uint64_t service = 0;  ///< Identity of the service instance.
  std::uint32_t term = 0;     ///< Grows when another instance takes over.
  std::string version;
  std::string world;
  bool lock_step = false;  ///< False: real time.
  std::int64_t now_ns = 0;
  std::uint32_t agents = 0;
  std::uint32_t pairs_tracked = 0;
  std::vector<SimulatorStatus> simulators;
  std::map<std::string, std::uint64_t> counters;  ///< By name, as `collisionctl status` lists them.
  std::string broad_phase;                        ///< Method in use ...
  std::string broad_phase_why;                    ///< ... and the reason.
  std::vector<std::string> left_out;              ///< Work that the scene does not need, and why.
  std::string build;                              ///< Compiler, and whether its checks are on.
  std::int64_t started_ns = 0;                    ///< Wall clock, since 1970.
  std::int64_t uptime_ns = 0;                     ///< Also while the machine slept.
  std::uint64_t cpu_us = 0;                       ///< Of all threads of the process together.
  std::uint64_t memory_bytes = 0;                 ///< Resident.
  /// How many values fell into each class since the start, by name, which ends in the unit:
  /// step_us, update_to_contact_us, contact_bracket_ns. Classes end at 1, 2, 5, 10, 20, 50, ...
  std::map<std::string, std::vector<std::uint64_t>> histograms;
};

/// The pair of agents that can intersect first, of all pairs not in contact already.
struct EarliestIntersection {
  std::int64_t now_ns = 0;            ///< The service's time when it computed this.
  bool found = false;                 ///< False: no pair can intersect.
  std::int64_t earliest_ns = kNever;  ///< No pair intersects before.
  AgentId lower;
  AgentId higher;
};

/// Receives what is published in one world and writes nothing: it creates DDS readers only, so a
/// subscribe-only permission suffices.
///
/// Of several services it believes the one in force, and drops what the others say. The event
/// callback gets contacts and forecasts, each revision once, also those of levels (Event::level).
///
/// Callbacks run inside Poll(), on its thread. Every topic but the rejections keeps its last value,
/// so a late monitor receives the values of now, and the newest 1024 samples of contacts. One
/// thread at a time; a callback must not call Poll() or destroy the monitor. Samples of different
/// topics may overtake each other: an event can arrive before the descriptions of its agents (see
/// PendingNames).
class COLLISION_API Monitor {
 public:
  /// Each may be empty.
  struct Callbacks {
    std::function<void(const Event&)> event = {};
    std::function<void(const EarliestIntersection&)> earliest = {};
    std::function<void(const ServiceStatus&)> status = {};
    std::function<void(const AgentId&, const Clearance&)> clearance = {};
    std::function<void(const Rejection&)> rejection = {};
    /// Of any agent: at most once a second each, of those that stand when the monitor comes, too.
    std::function<void(const Breach&)> breach = {};
    std::function<void(const DescribedAgent&)> description = {};
    /// The agent in this slot of this simulator has left.
    std::function<void(std::uint64_t simulator, std::uint32_t slot)> removal = {};
    std::function<void(const AgentId&, const State&)> state = {};
    std::function<void(const SimulatorClock&)> clock = {};
    /// What stands in this program's way, or will: its credentials end. Empty: standard error is
    /// told.
    std::function<void(const Notice&)> notice = {};
  };

  /// Throws std::runtime_error if an option is out of range or DDS is not available.
  Monitor(const MonitorOptions& options, const Callbacks& callbacks);

  /// The same over another network than DDS, for tests.
  Monitor(std::unique_ptr<Receiver> receiver, const Callbacks& callbacks);

  Monitor(Monitor&&) noexcept;
  Monitor& operator=(Monitor&&) noexcept;
  ~Monitor();

  /// Waits at most `timeout` for an arrival, then calls back for everything that has arrived.
  /// Returns the number of samples.
  std::size_t Poll(std::chrono::nanoseconds timeout);

  /// True while a service of this world is alive. Needs MonitorOptions::service.
  bool service_alive() const;

  /// Contacts (confirmed, ended or undecided) that were published while this monitor was there and
  /// that the network lost: 0 for one that never stops longer than about 10 s.
  std::uint64_t contacts_missed() const;

 private:
  std::unique_ptr<MessageMonitor> monitor_;
};

}  // namespace collision::client
