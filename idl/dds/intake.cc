#include "idl/dds/intake.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "idl/dds/conversion.h"
#include "idl/identity.h"

namespace collision::dds {
namespace {

constexpr std::size_t kLoan = 256;  // samples at a time: bounds the loan, nothing else
constexpr std::size_t kWritersMax =
    4096;  // four per simulator, many simulators; beyond it, ask again
constexpr std::size_t kSimulatorsMax =
    4096;  // beyond it, a return is not announced: its clock says it

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

}  // namespace

std::optional<std::uint64_t> Senders::Of(dds_entity_t reader, dds_instance_handle_t writer) {
  if (const auto known = known_.find(writer); known != known_.end()) return known->second;
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, writer);
  if (endpoint == nullptr) return std::nullopt;
  const auto* guid = reinterpret_cast<const char*>(endpoint->participant_key.v);
  const std::uint64_t sender = Fnv1a({guid, sizeof endpoint->participant_key.v});
  dds_builtintopic_free_endpoint(endpoint);
  if (known_.size() == kWritersMax) known_.clear();
  known_.emplace(writer, sender);
  return sender;
}

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
  if (info.valid_data) ReceiveData(reader, row, sample, info, inputs);
  if (info.sample_rank > 0 || info.instance_state == DDS_ALIVE_INSTANCE_STATE) return;
  const bool disposed = info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE;
  ReceiveEnd(row, sample, disposed, senders_.Of(reader, info.publication_handle).value_or(0),
             inputs);
}

void Intake::ReceiveData(dds_entity_t reader, const TopicRow& row, const void* sample,
                         const dds_sample_info_t& info, std::vector<v1::Input>* inputs) {
  const std::optional<std::uint64_t> sender = senders_.Of(reader, info.publication_handle);
  if (!sender) {
    ++orphaned_;
    return;
  }
  if (row.id == TopicId::kSimulatorClock) {
    const std::uint64_t simulator = As<collision_v1_SimulatorClock>(sample).simulator_id;
    if (gone_.erase(simulator) > 0) {
      v1::Input& input = inputs->emplace_back();
      input.set_sender(*sender);
      input.mutable_liveliness()->set_simulator_id(simulator);
      input.mutable_liveliness()->set_alive(true);
    }
  }
  v1::Input& input = inputs->emplace_back();
  input.set_sender(*sender);
  FromWire(row.id, sample, &input);
}

void Intake::ReceiveEnd(const TopicRow& row, const void* sample, bool disposed,
                        std::uint64_t sender, std::vector<v1::Input>* inputs) {
  if (row.id == TopicId::kAgentDescription && disposed) {
    v1::Input& input = inputs->emplace_back();
    input.set_sender(sender);
    input.mutable_agent_removal()->set_simulator_id(
        As<collision_v1_AgentDescription>(sample).simulator_id);
    input.mutable_agent_removal()->set_slot(As<collision_v1_AgentDescription>(sample).slot);
  }
  if (row.id == TopicId::kSimulatorClock) {
    const std::uint64_t simulator = As<collision_v1_SimulatorClock>(sample).simulator_id;
    if (gone_.size() == kSimulatorsMax) gone_.clear();
    if (!gone_.insert(simulator).second) return;
    v1::Input& input = inputs->emplace_back();
    input.set_sender(sender);
    input.mutable_liveliness()->set_simulator_id(simulator);
    input.mutable_liveliness()->set_alive(false);
  }
}

bool Intake::Wanted(const TopicRow& row, const void* sample) const {
  if (own_ == 0) return true;
  if (row.id == TopicId::kClearance) return As<collision_v1_Clearance>(sample).simulator_id == own_;
  if (row.id == TopicId::kRejection) return As<collision_v1_Rejection>(sample).simulator_id == own_;
  return true;
}

}  // namespace collision::dds
