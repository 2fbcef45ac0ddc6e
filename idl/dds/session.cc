#include "idl/dds/session.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "idl/credentials/end_watch.h"
#include "idl/dds/conversion.h"
#include "idl/dds/endpoints.h"
#include "idl/dds/headroom.h"
#include "idl/dds/intake.h"
#include "idl/dds/security/credentials.h"
#include "idl/dds/security/stranger_watch.h"
#include "idl/dds/text.h"
#include "idl/dds/waker.h"
#include "idl/dds/watch/misfit_watch.h"
#include "idl/dds/watch/writer_watch.h"
#include "idl/identity.h"
#include "idl/limits.h"

namespace collision {
namespace {

constexpr std::uint32_t kChunkMax = wire::kSlotMax / wire::kStatesPerChunkMax;

using dds::Check;

void CheckName(const char* what, const std::string& name) {
  if (wire::IsName(name)) return;
  throw std::runtime_error(std::string(what) + " \"" + name + "\": allowed are " + wire::kNameText);
}

const DdsSessionOptions& Checked(const DdsSessionOptions& options) {
  CheckName("world", options.world);
  if (options.role == DdsRole::kSimulator) CheckName("simulator", options.simulator);
  if (options.domain > wire::kDomainMax) {
    throw std::runtime_error("DDS domain " + std::to_string(options.domain) +
                             ": allowed are 0 to " + std::to_string(wire::kDomainMax));
  }
  if (options.lease.count() <= 0) throw std::runtime_error("lease: must be longer than 0");
  if (options.role == DdsRole::kService && options.lease > dds::kServiceLeaseMax) {
    throw std::runtime_error("lease: of a service at most 2 s, which its readers ask for");
  }
  return options;
}

dds::Partitions PartitionsOf(const DdsSessionOptions& options) {
  const bool monitor = options.role == DdsRole::kMonitor;
  const bool service = options.role == DdsRole::kService;
  const bool simulator = options.role == DdsRole::kSimulator;
  const bool as_operator = options.role == DdsRole::kOperator;
  dds::Partitions partitions;
  if (service || (monitor && options.reads_simulators))
    partitions.read_of_simulators = options.world + ".*";
  if (simulator || as_operator || (monitor && options.reads_service))
    partitions.read_of_service = options.world;
  partitions.read_status_alone = monitor && options.reads_status_alone;
  partitions.read_earliest = monitor;
  partitions.read_screening = simulator;
  if (simulator) partitions.write_as_simulator = options.world + "." + options.simulator;
  if (service) partitions.read_of_other_services = partitions.write_as_service = options.world;
  partitions.read_events_of_other_services = service && options.reads_events_of_services;
  const std::string of_operators = options.world + dds::kOperatorsPartition;
  if (service) partitions.read_of_operators = of_operators;
  if (as_operator) partitions.write_as_operator = of_operators;
  const std::string of_watchers = options.world + dds::kWatchersPartition;
  if (simulator) partitions.read_of_watchers = of_watchers;
  if (options.role == DdsRole::kWatcher) partitions.write_as_watcher = of_watchers;
  return partitions;
}

std::optional<dds::Credentials> CredentialsOf(const DdsSessionOptions& options) {
  if (options.credentials.empty()) return std::nullopt;
  return dds::Credentials(options.credentials, options.domain);
}

/// The program on the network: with its credentials, if it has any.
dds_entity_t CreateParticipant(std::uint32_t domain,
                               const std::optional<dds::Credentials>& credentials,
                               const dds_listener_t* listener) {
  dds::RequireHeadroom();
  const dds::Qos qos = dds::MakeQos();
  if (credentials) credentials->Apply(qos.get());
  const dds_entity_t made = dds_create_participant(domain, qos.get(), listener);
  if (made < 0 && credentials) {
    throw std::runtime_error("DDS domain " + std::to_string(domain) +
                             ": Cyclone DDS does not start with the credentials in " +
                             credentials->folder() + ": it has told why on standard error");
  }
  const dds_entity_t participant = Check(made, "DDS domain " + std::to_string(domain));
  // For the whole process, and only for writers made after it: samples gather until Flush().
  dds_write_set_batch(true);
  return participant;
}

}  // namespace

class DdsSession::Implementation {
 public:
  explicit Implementation(const DdsSessionOptions& options)
      : inbox_(options.sender_limits),
        credentials_(CredentialsOf(Checked(options))),
        participant_(CreateParticipant(options.domain, credentials_, misfits_.listener())),
        guard_(Check(dds_create_guardcondition(participant_.get()), "DDS guard condition")),
        endpoints_(dds::MakeEndpoints(participant_.get(), PartitionsOf(options),
                                      options.lease.count(), watch_.Listen(guard_),
                                      InboxWith(guard_))),
        waitset_(Check(dds_create_waitset(participant_.get()), "DDS waitset")),
        intake_(options.role == DdsRole::kSimulator ? SimulatorId(options.simulator) : 0,
                endpoints_) {
    Check(dds_waitset_attach(waitset_, guard_, 0), "DDS waitset");
    for (const dds::TopicRow& row : dds::Topics()) {
      const dds_entity_t reader = endpoints_.readers[static_cast<std::size_t>(row.id)];
      if (reader == 0 || row.source == dds::Source::kSimulators) continue;
      const dds_entity_t arrived =
          Check(dds_create_readcondition(reader, DDS_ANY_STATE), "DDS read condition");
      Check(dds_waitset_attach(waitset_, arrived, 0), "DDS waitset");
    }
    waker_.emplace(guard_);
    if (credentials_) end_watch_.emplace(credentials_->first_to_end(), credentials_->end());
    if (!is_secured()) return;
    intake_.BindSimulators();
    if (options.role == DdsRole::kService) strangers_.emplace(participant_.get());
  }

  /// A service says that it ends: where a program was killed lately, or stands still, each writer
  /// takes a second to end.
  ~Implementation() {
    if (service_id_ == 0) return;
    collision_v1_ServiceStatus key{};
    key.service_id = service_id_;
    dds_dispose(Writer(dds::TopicId::kServiceStatus), &key);
    Flush();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  template <class Message>
  void Write(const Message& message, dds::TopicId topic = dds::Carrier<Message>::kTopic) {
    const dds_entity_t writer = Writer(topic);
    if (dds_write(writer, dds::ToWire(message).get()) != DDS_RETCODE_OK) ++writes_failed_;
  }

  void WriteStatus(const v1::ServiceStatus& message) {
    service_id_ = message.service_id();
    Write(message);
  }

  void WriteBreach(const v1::AgentBreach& message) {
    breached_[message.simulator_id()].insert(message.slot());
    Write(message);
  }

  void WriteScreening(const v1::ScreeningEvent& message) {
    screened_[message.simulator_id()].insert(message.pair_slot());
    Write(message);
  }

  /// Writes and disposes at once, so that the removal has a sequence of its own.
  void RemoveAgent(const v1::AgentRemoval& removal) {
    v1::AgentDescription sample = removal.description();
    sample.set_simulator_id(removal.simulator_id());
    sample.set_slot(removal.slot());
    sample.set_incarnation(removal.incarnation());
    sample.set_sequence(removal.sequence());
    const dds_entity_t writer = Writer(dds::TopicId::kAgentDescription);
    if (dds_writedispose(writer, dds::ToWire(sample).get()) != DDS_RETCODE_OK) ++writes_failed_;
  }

  void RemoveShape(std::uint64_t simulator_id, std::uint32_t shape, std::uint32_t parts) {
    const dds_entity_t writer = Writer(dds::TopicId::kShapePart);
    collision_v1_ShapePart key{};
    key.simulator_id = simulator_id;
    key.shape = shape;
    for (key.part = 0; key.part < parts; ++key.part) {
      if (dds_dispose(writer, &key) != DDS_RETCODE_OK) ++writes_failed_;
      // No number comes again.
      Withdraw(dds::TopicId::kShapePart, &key);
    }
  }

  void ForgetSimulator(std::uint64_t simulator_id) {
    collision_v1_SimulatorReport report{};
    report.simulator_id = simulator_id;
    Withdraw(dds::TopicId::kSimulatorReport, &report);
    collision_v1_Clearance clearance{};
    clearance.simulator_id = simulator_id;
    for (clearance.chunk = 0; clearance.chunk <= kChunkMax; ++clearance.chunk) {
      Withdraw(dds::TopicId::kClearance, &clearance);
    }
    const auto withdraw = [&]<typename Key>(dds::TopicId topic, std::uint32_t Key::*slot,
                                            std::map<std::uint64_t, Slots>* written) {
      Key key{};
      key.simulator_id = simulator_id;
      for (const std::uint32_t one : (*written)[simulator_id]) {
        key.*slot = one;
        Withdraw(topic, &key);
      }
      written->erase(simulator_id);
    };
    withdraw(dds::TopicId::kAgentBreach, &collision_v1_AgentBreach::slot, &breached_);
    withdraw(dds::TopicId::kScreening, &collision_v1_ScreeningEvent::pair_slot, &screened_);
  }

  void Flush() {
    // Contacts first, since clearances name them.
    constexpr auto kContacts = static_cast<std::size_t>(dds::TopicId::kContact);
    if (endpoints_.writers[kContacts] != 0) dds_write_flush(endpoints_.writers[kContacts]);
    for (const dds_entity_t writer : endpoints_.writers) {
      if (writer != 0) dds_write_flush(writer);
    }
  }

  std::size_t Receive(std::chrono::nanoseconds timeout, std::size_t limit,
                      std::vector<v1::Input>* inputs, std::vector<v1::Output>* outputs) {
    const dds_duration_t wait = std::max<dds_duration_t>(timeout.count(), 0);
    const dds_duration_t ready = inbox_.UntilReady().value_or(wait);
    dds_waitset_wait(waitset_, nullptr, 0, std::min(wait, ready));
    bool woken = false;
    dds_take_guardcondition(guard_, &woken);
    std::size_t taken = 0;
    for (const dds::TopicRow& row : dds::Topics()) {
      const dds_entity_t reader = endpoints_.readers[static_cast<std::size_t>(row.id)];
      const std::size_t most = std::min(limit - taken, row.take_max);
      if (reader != 0 && row.source != dds::Source::kSimulators)
        taken += intake_.Take(reader, row, most, inputs, outputs);
    }
    const std::vector<dds::WriterChange> changes = watch_.Take();
    intake_.AddWriters(inbox_.TakeNewWriters());
    if (inputs != nullptr) taken += intake_.TakeInbox(&inbox_, limit - taken, inputs);
    intake_.Follow(changes, inputs);
    return taken;
  }

  void Wake() noexcept { waker_->Wake(); }

  std::vector<DdsIgnored> TakeIgnored() {
    std::vector<DdsIgnored> taken;
    for (const auto& [writer, for_ns] : inbox_.TakeIgnoredSenders()) {
      ++senders_ignored_;
      taken.push_back({PartitionOf(writer), std::chrono::nanoseconds(for_ns)});
    }
    return taken;
  }

  std::vector<DdsLoss> losses() const {
    std::vector<DdsLoss> losses;
    for (const auto& [writer, loss] : inbox_.Losses()) {
      losses.push_back({writer ? PartitionOf(*writer) : "", loss.dropped, loss.waiting,
                        std::chrono::nanoseconds(loss.ignored_for_ns)});
    }
    return losses;
  }

  bool TakeRelief() { return inbox_.TakeRelief(); }
  std::chrono::nanoseconds waited() const { return std::chrono::nanoseconds(inbox_.waited_ns()); }

  bool service_present() const {
    const dds_entity_t reader =
        endpoints_.readers[static_cast<std::size_t>(dds::TopicId::kServiceStatus)];
    dds_liveliness_changed_status_t status{};
    return reader != 0 && dds_get_liveliness_changed_status(reader, &status) == DDS_RETCODE_OK &&
           status.alive_count > 0;
  }

  /// A network profile that secures its domain counts, too.
  bool is_secured() const { return credentials_ || inbox_.domain().profile_secures; }

  std::string open_interface() const { return inbox_.domain().open_interface; }

  std::optional<std::string> TakeCredentialsWarning() {
    if (!end_watch_) return std::nullopt;
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return end_watch_->Look(std::chrono::duration_cast<std::chrono::seconds>(now).count());
  }

  std::vector<DdsForgery> TakeForgeries() {
    std::vector<DdsForgery> taken;
    for (const auto& [partition, simulator, samples] : intake_.TakeForgeries()) {
      taken.push_back({dds::Printable(partition), simulator, samples});
    }
    return taken;
  }

  std::vector<std::string> TakeStrangers() {
    if (!strangers_) return {};
    std::vector<std::string> strangers = strangers_->Look(std::chrono::steady_clock::now());
    for (std::string& words : strangers) words = dds::Printable(std::move(words));
    return strangers;
  }

  std::uint32_t earliest_readers() const {
    dds_publication_matched_status_t status{};
    const dds_entity_t writer = Writer(dds::TopicId::kEarliestIntersection);
    if (dds_get_publication_matched_status(writer, &status) != DDS_RETCODE_OK) return 0;
    return status.current_count;
  }

  DdsCounters counters() const {
    DdsCounters counters;
    for (const dds_entity_t reader : endpoints_.readers) {
      if (reader == 0) continue;
      dds_sample_lost_status_t lost{};
      dds_get_sample_lost_status(reader, &lost);
      counters.samples_lost += lost.total_count;
    }
    counters.samples_refused = inbox_.refused();
    counters.senders_ignored = senders_ignored_;
    counters.samples_forged = intake_.forged();
    counters.writes_failed = writes_failed_;
    return counters;
  }

 private:
  using Slots = std::set<std::uint32_t>;

  std::string PartitionOf(const dds::NewWriter& writer) const {
    return dds::Printable(dds::PartitionOf(endpoints_.readers[writer.topic], writer.writer));
  }

  dds_entity_t Writer(dds::TopicId topic) const {
    const dds_entity_t writer = endpoints_.writers[static_cast<std::size_t>(topic)];
    if (writer == 0)
      throw std::logic_error(std::string("this role does not write ") + dds::Row(topic).name);
    return writer;
  }

  /// What was written under this key is kept until it has arrived. Otherwise DDS would keep the key
  /// for good, and its newest sample, or that it was disposed of, for those that join later.
  void Withdraw(dds::TopicId topic, const void* key) {
    const dds_entity_t writer = Writer(topic);
    if (dds_lookup_instance(writer, key) != DDS_HANDLE_NIL) dds_unregister_instance(writer, key);
  }

  dds::Inbox* InboxWith(dds_entity_t guard) {
    inbox_.SetGuard(guard);
    return &inbox_;
  }

  // Watches and inbox first: the readers call them until they end with the participant. The waker
  // last: its thread uses the guard, which lives in the participant.
  dds::MisfitWatch misfits_;
  dds::WriterWatch watch_;
  dds::Inbox inbox_;
  const std::optional<dds::Credentials> credentials_;
  std::optional<credentials::EndWatch> end_watch_;
  const dds::Entity participant_;
  const dds_entity_t guard_;
  const dds::Endpoints endpoints_;
  const dds_entity_t waitset_;
  dds::Intake intake_;
  std::optional<dds::StrangerWatch> strangers_;
  std::uint64_t service_id_ = 0;             ///< Of the statuses that were written; 0: none.
  std::map<std::uint64_t, Slots> breached_;  ///< By simulator.
  std::map<std::uint64_t, Slots> screened_;  ///< Of pairs, likewise.
  std::uint64_t writes_failed_ = 0;
  std::uint64_t senders_ignored_ = 0;
  std::optional<dds::Waker> waker_;
};

DdsSession::DdsSession(const DdsSessionOptions& options)
    : implementation_(std::make_unique<Implementation>(options)) {}
DdsSession::DdsSession(DdsSession&&) noexcept = default;
DdsSession& DdsSession::operator=(DdsSession&&) noexcept = default;
DdsSession::~DdsSession() = default;

void DdsSession::Write(const v1::SimulatorHello& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::AgentDescription& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::ShapePart& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::AgentStates& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::SimulatorClock& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::ServiceHello& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::Clearance& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::EarliestIntersection& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::CollisionEvent& message) {
  const bool contact = message.contacts_sequence() > 0;
  implementation_->Write(message, contact ? dds::TopicId::kContact : dds::TopicId::kForecast);
}
void DdsSession::Write(const v1::Rejection& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::ServiceStatus& message) { implementation_->WriteStatus(message); }
void DdsSession::Write(const v1::SimulatorReport& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::AgentBreach& message) { implementation_->WriteBreach(message); }
void DdsSession::Write(const v1::ScreeningEvent& message) {
  implementation_->WriteScreening(message);
}
void DdsSession::Write(const v1::OperatorCommand& message) { implementation_->Write(message); }
void DdsSession::Write(const v1::Watch& message) { implementation_->Write(message); }

void DdsSession::RemoveAgent(const v1::AgentRemoval& removal) {
  implementation_->RemoveAgent(removal);
}

void DdsSession::RemoveShape(std::uint64_t simulator_id, std::uint32_t shape, std::uint32_t parts) {
  implementation_->RemoveShape(simulator_id, shape, parts);
}

void DdsSession::ForgetSimulator(std::uint64_t simulator_id) {
  implementation_->ForgetSimulator(simulator_id);
}

void DdsSession::Flush() { implementation_->Flush(); }

std::size_t DdsSession::Receive(std::chrono::nanoseconds timeout, std::size_t limit,
                                std::vector<v1::Input>* inputs, std::vector<v1::Output>* outputs) {
  return implementation_->Receive(timeout, limit, inputs, outputs);
}

void DdsSession::Wake() noexcept { implementation_->Wake(); }

std::vector<DdsIgnored> DdsSession::TakeIgnored() { return implementation_->TakeIgnored(); }

std::vector<DdsLoss> DdsSession::losses() const { return implementation_->losses(); }

std::chrono::nanoseconds DdsSession::waited() const { return implementation_->waited(); }
bool DdsSession::TakeRelief() { return implementation_->TakeRelief(); }
std::uint32_t DdsSession::earliest_readers() const { return implementation_->earliest_readers(); }

bool DdsSession::is_secured() const { return implementation_->is_secured(); }

std::string DdsSession::open_interface() const { return implementation_->open_interface(); }

std::optional<std::string> DdsSession::TakeCredentialsWarning() {
  return implementation_->TakeCredentialsWarning();
}

std::vector<DdsForgery> DdsSession::TakeForgeries() { return implementation_->TakeForgeries(); }

std::vector<std::string> DdsSession::TakeStrangers() { return implementation_->TakeStrangers(); }

bool DdsSession::service_present() const { return implementation_->service_present(); }

DdsCounters DdsSession::counters() const { return implementation_->counters(); }

}  // namespace collision
