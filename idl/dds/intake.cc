#include "idl/dds/intake.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "dds/ddsi/ddsi_serdata.h"
#include "idl/dds/conversion.h"
#include "idl/identity.h"

namespace collision::dds {
namespace {

constexpr std::size_t kLoan = 256;  // samples at a time: bounds the loan, nothing else

/// Bytes taken from the inbox at once, unless one sample has more. As a message a sample is at most
/// half as large again, so that a recorded batch stays below its limit of 64 MiB.
constexpr std::size_t kInboxBytesAtOnce = std::size_t{16} << 20;

/// Samples borrowed from a reader, given back at the end.
class Loan {
 public:
  Loan(dds_entity_t reader, std::size_t limit)
      : reader_(reader),
        size_(dds_take(reader, samples_.data(), infos_.data(), kLoan,
                       static_cast<std::uint32_t>(std::min(limit, kLoan)))) {}
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;
  ~Loan() {
    if (size_ > 0) dds_return_loan(reader_, samples_.data(), size_);
  }
  std::size_t size() const { return size_ > 0 ? static_cast<std::size_t>(size_) : 0; }
  const void* sample(std::size_t i) const { return samples_[i]; }
  const dds_sample_info_t& info(std::size_t i) const { return infos_[i]; }

 private:
  const dds_entity_t reader_;
  std::array<void*, kLoan> samples_{};
  std::array<dds_sample_info_t, kLoan> infos_;
  const dds_return_t size_;
};

template <class Wire>
const Wire& As(const void* sample) {
  return *static_cast<const Wire*>(sample);
}

/// Other services that are remembered after their end.
constexpr std::size_t kEndedServicesMax = 64;

/// Partitions of which forged samples are told at once; those of further ones are counted only.
constexpr std::size_t kForgersToldMax = 16;

void AddServiceEnd(std::uint64_t service, std::vector<v1::Input>* inputs) {
  if (inputs == nullptr) return;
  v1::ServiceHeard& heard = *inputs->emplace_back().mutable_service_heard();
  heard.set_service_id(service);
  heard.set_ended(true);
}

void AddLiveliness(std::uint64_t sender, std::uint64_t simulator, bool alive,
                   std::vector<v1::Input>* inputs) {
  v1::Input& input = inputs->emplace_back();
  input.set_sender(sender);
  input.mutable_liveliness()->set_simulator_id(simulator);
  input.mutable_liveliness()->set_alive(alive);
}

TopicId TopicOf(const ArrivedSample& arrived) { return static_cast<TopicId>(arrived.topic); }

/// A sample that was written only to be disposed of: it tells the sequence of the removal.
bool IsRemoval(const ArrivedSample& arrived, const void* sample) {
  return TopicOf(arrived) == TopicId::kAgentDescription && arrived.is_disposed() &&
         As<collision_v1_AgentDescription>(sample).simulator_name[0] == '\0';
}

/// The removal of an instance that its writer disposed of. Unless `has_data`, only the key of the
/// sample counts.
void AddRemoval(TopicId topic, const void* sample, bool has_data, std::uint64_t sender,
                std::vector<v1::Input>* inputs) {
  if (topic == TopicId::kAgentDescription) {
    const auto& key = As<collision_v1_AgentDescription>(sample);
    v1::Input& input = inputs->emplace_back();
    input.set_sender(sender);
    input.mutable_agent_removal()->set_simulator_id(key.simulator_id);
    input.mutable_agent_removal()->set_slot(key.slot);
    input.mutable_agent_removal()->set_incarnation(key.incarnation);
    if (has_data) input.mutable_agent_removal()->set_sequence(key.sequence);
  } else if (topic == TopicId::kShapePart) {
    const auto& key = As<collision_v1_ShapePart>(sample);
    v1::Input& input = inputs->emplace_back();
    input.set_sender(sender);
    input.mutable_shape_removal()->set_simulator_id(key.simulator_id);
    input.mutable_shape_removal()->set_shape(key.shape);
    input.mutable_shape_removal()->set_part(key.part);
  }
}

/// The simulator of which a sample speaks; of a disposal, too: it is part of the key.
std::uint64_t SubjectOf(TopicId topic, const void* sample) {
  switch (topic) {
    case TopicId::kSimulatorHello:
      return As<collision_v1_SimulatorHello>(sample).simulator_id;
    case TopicId::kSimulatorClock:
      return As<collision_v1_SimulatorClock>(sample).simulator_id;
    case TopicId::kAgentDescription:
      return As<collision_v1_AgentDescription>(sample).simulator_id;
    case TopicId::kShapePart:
      return As<collision_v1_ShapePart>(sample).simulator_id;
    default:
      return As<collision_v1_AgentStates>(sample).simulator_id;
  }
}

/// The id of the simulator that a partition, WORLD.SIMULATOR, names. Neither name has a dot.
std::uint64_t SimulatorIn(const std::string& partition) {
  return SimulatorId(std::string_view(partition).substr(partition.rfind('.') + 1));
}

/// The simulator that a sample names itself: descriptions and clocks do, which makes them claims.
std::optional<std::uint64_t> ClaimedBy(TopicId topic, const void* sample) {
  if (topic == TopicId::kAgentDescription)
    return As<collision_v1_AgentDescription>(sample).simulator_id;
  if (topic == TopicId::kSimulatorClock)
    return As<collision_v1_SimulatorClock>(sample).simulator_id;
  return std::nullopt;
}

}  // namespace

SampleBuffers::~SampleBuffers() {
  for (const TopicRow& row : Topics()) {
    dds_sample_free(samples_[static_cast<std::size_t>(row.id)], row.type, DDS_FREE_ALL);
  }
}

const void* SampleBuffers::Decode(const ArrivedSample& arrived) {
  void*& sample = samples_[arrived.topic];
  if (sample == nullptr) {
    const std::size_t size = Topics()[arrived.topic].type->m_size;
    sample = std::memset(dds_alloc(size), 0, size);
  }
  return ddsi_serdata_to_sample(arrived.data.get(), sample, nullptr, nullptr) ? sample : nullptr;
}

void Intake::AddWriters(const std::vector<NewWriter>& writers) {
  for (const auto& [topic, sender, writer] : writers) senders_.Add(readers_[topic], writer, sender);
}

std::size_t Intake::TakeInbox(Inbox* inbox, std::size_t limit, std::vector<v1::Input>* inputs) {
  const std::vector<ArrivedSample> arrived = inbox->Take(limit, kInboxBytesAtOnce);
  for (const ArrivedSample& sample : arrived) Receive(sample, inputs);
  return arrived.size();
}

std::size_t Intake::Take(dds_entity_t reader, const TopicRow& row, std::size_t limit,
                         std::vector<v1::Input>* inputs, std::vector<v1::Output>* outputs) {
  std::size_t taken = 0;
  while (taken < limit) {
    const Loan loan(reader, limit - taken);
    if (loan.size() == 0) break;
    taken += loan.size();
    for (std::size_t i = 0; i < loan.size(); ++i) {
      if (!loan.info(i).valid_data) {
        if (services_.contains(loan.info(i).publication_handle)) {
          EndService(loan.info(i).publication_handle, inputs);
        }
        continue;
      }
      if (outputs == nullptr || row.source == Source::kWatchers) {
        if (inputs == nullptr) continue;
        FromWire(row.id, loan.sample(i), &inputs->emplace_back());
      } else if (Wanted(row, loan.sample(i))) {
        FromWire(row.id, loan.sample(i), &outputs->emplace_back());
      }
      if (row.id == TopicId::kServiceStatus) {
        FollowService(loan.sample(i), loan.info(i), outputs != nullptr, inputs);
      }
    }
  }
  return taken;
}

void Intake::Receive(const ArrivedSample& arrived, std::vector<v1::Input>* inputs) {
  const void* sample = buffers_.Decode(arrived);
  if (sample == nullptr) return;
  // It may have been forgotten while the sample waited, or have written only now.
  senders_.Add(readers_[arrived.topic], arrived.writer, arrived.sender);
  if (binds_ && IsForged(arrived, sample)) return;
  if (arrived.has_data() && !IsRemoval(arrived, sample)) {
    ReceiveData(TopicOf(arrived), sample, arrived.sender, inputs);
  }
  if (arrived.is_disposed()) {
    AddRemoval(TopicOf(arrived), sample, arrived.has_data(), arrived.sender, inputs);
  }
}

void Intake::BindSimulators() {
  binds_ = true;
  senders_.LookUpPartitions();
}

std::vector<Intake::Forgery> Intake::TakeForgeries() {
  std::vector<Forgery> taken;
  for (auto& [partition, forgery] : std::exchange(forgeries_, {})) taken.push_back(forgery);
  return taken;
}

/// Of a program that has left before its first sample was taken nobody knows for whom it may speak:
/// its samples are dropped as well.
bool Intake::IsForged(const ArrivedSample& arrived, const void* sample) {
  const std::string& partition = senders_.PartitionOf(arrived.writer);
  const std::uint64_t subject = SubjectOf(TopicOf(arrived), sample);
  if (!partition.empty() && subject == SimulatorIn(partition)) return false;
  ++forged_;
  if (forgeries_.size() < kForgersToldMax || forgeries_.contains(partition)) {
    Forgery& forgery = forgeries_[partition];
    forgery.partition = partition;
    forgery.simulator = subject;
    ++forgery.samples;
  }
  return true;
}

void Intake::ReceiveData(TopicId topic, const void* sample, std::uint64_t sender,
                         std::vector<v1::Input>* inputs) {
  v1::Input& input = inputs->emplace_back();
  input.set_sender(sender);
  FromWire(topic, sample, &input);
  const std::optional<std::uint64_t> simulator = ClaimedBy(topic, sample);
  // Samples may wait for longer than their writer lives: its end comes after them.
  if (simulator && senders_.AddSimulator(sender, *simulator) && !senders_.alive(sender)) {
    AddLiveliness(sender, *simulator, false, inputs);
  }
}

/// `sample` is its status. `is_output`: it is handed on as such, so that an end that was told
/// before is to be taken back.
void Intake::FollowService(const void* sample, const dds_sample_info_t& info, bool is_output,
                           std::vector<v1::Input>* inputs) {
  v1::Input heard;
  FromWire(TopicId::kServiceStatus, sample, &heard);
  const bool is_back = ended_services_.erase(info.publication_handle) > 0;
  if (is_back && is_output && inputs != nullptr) inputs->push_back(heard);
  services_[info.publication_handle] = heard.service_heard();
  // A status may outlast its writer in the reader: its end comes after it.
  if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) EndService(info.publication_handle, inputs);
}

void Intake::EndService(dds_instance_handle_t writer, std::vector<v1::Input>* inputs) {
  auto ended = services_.extract(writer);
  AddServiceEnd(ended.mapped().service_id(), inputs);
  if (ended_services_.size() == kEndedServicesMax) ended_services_.clear();
  ended_services_.insert_or_assign(writer, std::move(ended.mapped()));
}

void Intake::Follow(const std::vector<WriterChange>& changes, std::vector<v1::Input>* inputs) {
  for (const WriterChange& change : changes) {
    if (services_.contains(change.writer)) {
      if (!change.alive) EndService(change.writer, inputs);
      continue;
    }
    if (!change.alive && ended_services_.contains(change.writer)) continue;
    if (auto back = ended_services_.extract(change.writer)) {
      if (inputs != nullptr) *inputs->emplace_back().mutable_service_heard() = back.mapped();
      services_.insert(std::move(back));
      continue;
    }
    const std::optional<std::uint64_t> sender = senders_.Of(change.reader, change.writer);
    if (!sender || !senders_.SetAlive(*sender, change.alive)) continue;
    for (const std::uint64_t simulator : senders_.SimulatorsOf(*sender)) {
      AddLiveliness(*sender, simulator, change.alive, inputs);
    }
  }
}

bool Intake::Wanted(const TopicRow& row, const void* sample) const {
  if (own_ == 0) return true;
  if (row.id == TopicId::kClearance) return As<collision_v1_Clearance>(sample).simulator_id == own_;
  if (row.id == TopicId::kSimulatorReport)
    return As<collision_v1_SimulatorReport>(sample).simulator_id == own_;
  if (row.id == TopicId::kAgentBreach)
    return As<collision_v1_AgentBreach>(sample).simulator_id == own_;
  if (row.id == TopicId::kScreening)
    return As<collision_v1_ScreeningEvent>(sample).simulator_id == own_;
  if (row.id == TopicId::kRejection) return As<collision_v1_Rejection>(sample).simulator_id == own_;
  return true;
}

}  // namespace collision::dds
