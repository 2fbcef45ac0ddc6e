#include "idl/dds/intake.h"

#include <algorithm>
#include <array>
#include <optional>

#include "idl/dds/conversion.h"

namespace collision::dds {
namespace {

constexpr std::size_t kLoan = 256;  // samples at a time: bounds the loan, nothing else

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

void AddServiceEnd(std::uint64_t service, std::vector<v1::Input>* inputs) {
  v1::ServiceHeard& heard = *inputs->emplace_back().mutable_service_heard();
  heard.set_service_id(service);
  heard.set_ended(true);
}

v1::SimulatorLiveliness& AddLiveliness(std::uint64_t sender, std::uint64_t simulator, bool alive,
                                       std::vector<v1::Input>* inputs) {
  v1::Input& input = inputs->emplace_back();
  input.set_sender(sender);
  input.mutable_liveliness()->set_simulator_id(simulator);
  input.mutable_liveliness()->set_alive(alive);
  return *input.mutable_liveliness();
}

/// A sample that was written only to be disposed of: it tells the sequence of the removal.
bool IsRemoval(TopicId topic, const void* sample, const dds_sample_info_t& info) {
  return topic == TopicId::kAgentDescription &&
         info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE && info.sample_rank == 0 &&
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

/// The simulator that a sample names itself: descriptions and clocks do, which makes them claims.
std::optional<std::uint64_t> ClaimedBy(TopicId topic, const void* sample) {
  if (topic == TopicId::kAgentDescription)
    return As<collision_v1_AgentDescription>(sample).simulator_id;
  if (topic == TopicId::kSimulatorClock)
    return As<collision_v1_SimulatorClock>(sample).simulator_id;
  return std::nullopt;
}

}  // namespace

std::size_t Intake::Take(dds_entity_t reader, const TopicRow& row, std::size_t limit,
                         std::vector<v1::Input>* inputs, std::vector<v1::Output>* outputs) {
  std::size_t taken = 0;
  while (taken < limit) {
    const Loan loan(reader, limit - taken);
    if (loan.size() == 0) break;
    taken += loan.size();
    for (std::size_t i = 0; i < loan.size(); ++i) {
      if (row.source == Source::kSimulators) {
        Receive(reader, row, loan.sample(i), loan.info(i), inputs);
      } else if (loan.info(i).valid_data && outputs == nullptr) {
        FromWire(row.id, loan.sample(i), &inputs->emplace_back());
        if (row.id == TopicId::kServiceStatus) FollowService(loan.info(i), inputs);
      } else if (loan.info(i).valid_data && Wanted(row, loan.sample(i))) {
        FromWire(row.id, loan.sample(i), &outputs->emplace_back());
      }
    }
  }
  return taken;
}

/// The state of the instance is that of now, not of the sample: it belongs behind the newest one.
void Intake::Receive(dds_entity_t reader, const TopicRow& row, const void* sample,
                     const dds_sample_info_t& info, std::vector<v1::Input>* inputs) {
  if (info.valid_data && !IsRemoval(row.id, sample, info)) {
    ReceiveData(reader, row, sample, info, inputs);
  }
  if (info.sample_rank > 0 || info.instance_state == DDS_ALIVE_INSTANCE_STATE) return;
  ReceiveEnd(reader, row, sample, info, inputs);
}

void Intake::ReceiveData(dds_entity_t reader, const TopicRow& row, const void* sample,
                         const dds_sample_info_t& info, std::vector<v1::Input>* inputs) {
  const std::optional<std::uint64_t> sender = senders_.Of(reader, info.publication_handle);
  if (!sender) {
    ++orphaned_;
    return;
  }
  v1::Input& input = inputs->emplace_back();
  input.set_sender(*sender);
  FromWire(row.id, sample, &input);
  const std::optional<std::uint64_t> simulator = ClaimedBy(row.id, sample);
  // Samples may outlast their writer in the reader: its end comes after them.
  if (simulator && senders_.AddSimulator(*sender, *simulator) && !senders_.alive(*sender)) {
    AddLiveliness(*sender, *simulator, false, inputs);
  }
}

void Intake::ReceiveEnd(dds_entity_t reader, const TopicRow& row, const void* sample,
                        const dds_sample_info_t& info, std::vector<v1::Input>* inputs) {
  const std::optional<std::uint64_t> sender = senders_.Of(reader, info.publication_handle);
  if (info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE) {
    AddRemoval(row.id, sample, info.valid_data, sender.value_or(0), inputs);
  }
  // Follow() reports each known writer by itself.
  if (row.id == TopicId::kSimulatorClock && !sender) {
    const auto& key = As<collision_v1_SimulatorClock>(sample);
    AddLiveliness(0, key.simulator_id, false, inputs).set_incarnation(key.incarnation);
  }
}

/// The last of `inputs` is a status of it.
void Intake::FollowService(const dds_sample_info_t& info, std::vector<v1::Input>* inputs) {
  const std::uint64_t service = inputs->back().service_heard().service_id();
  // A status may outlast its writer in the reader: its end comes after it.
  if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) return AddServiceEnd(service, inputs);
  services_[info.publication_handle] = service;
}

void Intake::Follow(const std::vector<WriterChange>& changes, std::vector<v1::Input>* inputs) {
  for (const WriterChange& change : changes) {
    if (const auto service = services_.find(change.writer); service != services_.end()) {
      if (change.alive) continue;
      AddServiceEnd(service->second, inputs);
      services_.erase(service);
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
  if (row.id == TopicId::kRejection) return As<collision_v1_Rejection>(sample).simulator_id == own_;
  return true;
}

}  // namespace collision::dds
