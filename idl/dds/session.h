// One program's place in a world, over DDS.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "idl/dds/inbox/sender_limits.h"
#include "idl/messages.pb.h"

namespace collision {

/// What a program writes and reads; ../README.md has the topics.
enum class DdsRole {
  kService,    ///< Reads what all simulators of the world write, and the status of other services;
               ///< writes the service's topics.
  kSimulator,  ///< Writes its agents; reads the service's topics, of clearances and rejections its
               ///< own.
  kMonitor,    ///< Writes nothing.
  kOperator,   ///< Writes commands; reads the service's topics.
  kWatcher,    ///< Writes what it watches; reads nothing.
};

struct DdsSessionOptions {
  std::string world = "default";  ///< 1-64 of [A-Za-z0-9_-]: worlds are partitions and do not mix.
  std::uint32_t domain = 0;       ///< DDS domain, 0-230.
  DdsRole role = DdsRole::kMonitor;
  std::string simulator;  ///< kSimulator: its unique name, 1-64 of [A-Za-z0-9_-].
  bool reads_service =
      true;  ///< kMonitor: status, events, earliest intersection, clearances, rejections.
  /// kService: reads the contacts and forecasts of other services, too.
  bool reads_events_of_services = false;
  bool reads_status_alone = false;  ///< kMonitor: of the service hello and status alone.
  bool reads_simulators = false;    ///< kMonitor: descriptions, shapes, states and clocks.

  /// A clock or a status whose writer the network has not heard of for so long counts as gone.
  /// Under 50 ms a busy machine gives false alarms.
  std::chrono::nanoseconds lease{2'000'000'000};

  /// The folder of this program's credentials (idl/credentials/files.h): it takes part in a secured
  /// world, as whom they say. Empty: it has none.
  std::string credentials = {};

  /// Of what simulators write, for those that read it.
  dds::SenderLimits sender_limits = {};
};

/// A program that the session ignores because it writes far more than it may (SenderLimits).
struct DdsIgnored {
  std::string partition;  ///< World and simulator, as it says itself; empty if it has left.
  std::chrono::nanoseconds duration{0};
};

/// A program of which samples are dropped, or will be, since it writes more than it may.
struct DdsLoss {
  std::string partition;                    ///< As in DdsIgnored.
  std::uint64_t dropped = 0;                ///< Samples, until none has been dropped for a minute.
  std::size_t waiting = 0;                  ///< Samples.
  std::chrono::nanoseconds ignored_for{0};  ///< From now on.
};

/// Samples of one simulator that a program wrote which may write for another one only. They are
/// dropped.
struct DdsForgery {
  std::string partition;        ///< World and simulator of the program; empty if it has left.
  std::uint64_t simulator = 0;  ///< For which it wrote; of several, one.
  std::uint64_t samples = 0;    ///< Since the last call.
};

/// What did not become a message. All grow from 0.
struct DdsCounters {
  std::uint64_t samples_lost = 0;     ///< The network gave up on them; newer ones came instead.
  std::uint64_t samples_refused = 0;  ///< Too many of their sender waited, or it was ignored.
  std::uint64_t senders_ignored = 0;  ///< How often one began to be.
  std::uint64_t samples_forged = 0;   ///< Of DdsForgery.
  std::uint64_t writes_failed =
      0;  ///< DDS did not take them; the next sample of that key replaces them.
};

/// A DDS participant with the readers and writers of its role. Writing never waits for a reader,
/// and a slow reader loses only samples that newer ones replaced: every sample is complete. One
/// thread at a time, except for Wake(). The environment variable CYCLONEDDS_URI
/// configures the network (config/cyclonedds-*.xml).
class DdsSession {
 public:
  /// Throws std::runtime_error, with the cause, if an option is out of range or DDS is not
  /// available.
  explicit DdsSession(const DdsSessionOptions& options);
  DdsSession(DdsSession&&) noexcept;
  DdsSession& operator=(DdsSession&&) noexcept;

  /// Leaves the world, after at most a second for what was written to arrive. A simulator's agents
  /// stay in the service unless removed.
  ~DdsSession();

  /// Writes a sample; Flush() sends it. Throws std::length_error, naming field and bound, for a
  /// text, list or byte field longer than the IDL allows, and std::logic_error for a message that
  /// is not of this role.
  void Write(const v1::SimulatorHello& message);
  void Write(const v1::AgentDescription& message);
  void Write(const v1::ShapePart& message);
  void Write(const v1::AgentStates& message);
  void Write(const v1::SimulatorClock& message);
  void Write(const v1::ServiceHello& message);
  void Write(const v1::Clearance& message);
  void Write(const v1::EarliestIntersection& message);
  void Write(const v1::CollisionEvent& message);  ///< A contact if it has contacts_sequence.
  void Write(const v1::Rejection& message);
  void Write(const v1::ServiceStatus& message);
  void Write(const v1::SimulatorReport& message);
  void Write(const v1::AgentBreach& message);
  void Write(const v1::ScreeningEvent& message);
  void Write(const v1::OperatorCommand& message);
  void Write(const v1::Watch& message);

  /// Removes an agent for good, by disposing of its description. kSimulator only. Flush() sends it.
  void RemoveAgent(const v1::AgentRemoval& removal);

  /// Removes a shape that was written in parts 0 to `parts` - 1, by disposing of each. The service
  /// keeps it as long as an agent refers to it. kSimulator only. Flush() sends it.
  void RemoveShape(std::uint64_t simulator_id, std::uint32_t shape, std::uint32_t parts);

  /// What was written about this simulator, clearances, report, breaches and screening, is not kept
  /// for readers that join later. kService only; writing about it again ends that.
  void ForgetSimulator(std::uint64_t simulator_id);

  /// Everything written leaves now.
  void Flush();

  /// Waits until something arrived, `timeout` is over or Wake() was called; then takes what
  /// arrived, at most `limit` samples, the rest stays for the next call, and appends a message for
  /// each. What simulators, operators, watchers wrote goes to `inputs`, what the service wrote to
  /// `outputs`; null where the role reads none. To a service another one's status is an input.
  /// Returns how many samples it took; not all are messages (a simulator's session hands on only
  /// its own clearances), a removal may come as a second message of one sample, and changes of
  /// liveliness come on top.
  ///
  /// Samples of one key come in the order of their writing; there is no order between keys, topics
  /// or writers. SimulatorLiveliness: its sender, which has described the simulator's agents or
  /// published its clock, left or its lease ended (false), or is back (true). It comes after what
  /// that sender wrote; each of several senders of one simulator is reported.
  ///
  /// Of what simulators wrote, each call takes equal shares of all of them, at most 16 MiB or a
  /// sample more, and of each one in the order of its writing, also of different keys of a topic.
  std::size_t Receive(std::chrono::nanoseconds timeout, std::size_t limit,
                      std::vector<v1::Input>* inputs, std::vector<v1::Output>* outputs);

  /// Ends a Receive() that waits, or else the next one at once. From any thread and from signal
  /// handlers.
  void Wake() noexcept;

  /// The programs that have begun to be ignored since the last call.
  std::vector<DdsIgnored> TakeIgnored();

  /// The programs that lose samples, or of which so many wait that newer ones replace older ones.
  std::vector<DdsLoss> losses() const;

  /// How long the oldest sample of a simulator had waited that the last Receive() took.
  std::chrono::nanoseconds waited() const;

  /// Whether credentials or the network profile secure this session. Then what simulators write is
  /// taken only from the partition that has the simulator's name, which permissions have checked.
  bool is_secured() const;

  /// The first network interface that leads off this machine; empty: none does. For roles that read
  /// simulators.
  std::string open_interface() const;

  /// A sentence, when the credentials will end before long, or have ended.
  std::optional<std::string> TakeCredentialsWarning();

  std::vector<DdsForgery> TakeForgeries();

  /// Programs of a secured network that DDS Security keeps out of this session, in words; each is
  /// told once. For kService.
  std::vector<std::string> TakeStrangers();

  /// True once after much has waited and is gone: memory can be given back to the system.
  bool TakeRelief();

  /// Whether a service writes to this world and has kept its lease. For roles that read the
  /// service.
  bool service_present() const;

  /// How many programs read the earliest intersection. For kService.
  std::uint32_t earliest_readers() const;

  DdsCounters counters() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace collision
