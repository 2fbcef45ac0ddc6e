#include "idl/dds/security/stranger_watch.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace collision::dds {
namespace {

constexpr std::size_t kReadMax = 16384;  // programs or endpoints; of more the rest is not seen
constexpr std::size_t kWordMax = 64;     // bytes of what a program says of itself

std::string PropertyOf(const dds_qos_t* qos, const char* name) {
  char* value = nullptr;
  if (!dds_qget_prop(qos, name, &value) || value == nullptr) return "?";
  std::string text = value;
  dds_free(value);
  if (text.size() > kWordMax) text.resize(kWordMax);
  return text;
}

std::array<unsigned char, 16> IdOf(const dds_builtintopic_guid_t& guid) {
  std::array<unsigned char, 16> id{};
  std::copy(std::begin(guid.v), std::end(guid.v), id.begin());
  return id;
}

/// Calls `use` for all samples of the instances in these states that a reader of a builtin topic
/// has. Those of living ones stay there.
template <typename Sample, typename Use>
void ForEach(dds_entity_t reader, std::uint32_t states, Use use) {
  std::vector<void*> samples(kReadMax);
  std::vector<dds_sample_info_t> infos(kReadMax);
  const auto get = states == DDS_ALIVE_INSTANCE_STATE ? &dds_read_mask : &dds_take_mask;
  const dds_return_t count = get(reader, samples.data(), infos.data(), kReadMax, kReadMax,
                                 DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | states);
  for (dds_return_t i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (infos[at].valid_data) use(*static_cast<const Sample*>(samples[at]));
  }
  if (count > 0) dds_return_loan(reader, samples.data(), count);
}

constexpr std::uint32_t kEnded =
    DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE | DDS_NOT_ALIVE_NO_WRITERS_INSTANCE_STATE;

}  // namespace

StrangerWatch::StrangerWatch(dds_entity_t participant) {
  const auto read = [participant](dds_entity_t topic) {
    const dds_entity_t reader = dds_create_reader(participant, topic, nullptr, nullptr);
    if (reader < 0) throw std::runtime_error("DDS builtin topic: no reader");
    return reader;
  };
  participants_ = read(DDS_BUILTIN_TOPIC_DCPSPARTICIPANT);
  publications_ = read(DDS_BUILTIN_TOPIC_DCPSPUBLICATION);
  subscriptions_ = read(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION);
  dds_guid_t own{};
  dds_get_guid(participant, &own);
  std::copy(std::begin(own.v), std::end(own.v), own_.begin());
}

std::map<StrangerWatch::Id, std::string> StrangerWatch::Present() const {
  std::map<Id, std::string> present;
  const auto note = [&](const dds_builtintopic_participant_t& participant) {
    const Id id = IdOf(participant.key);
    if (id == own_) return;
    present[id] = PropertyOf(participant.qos, "__ProcessName") + " (pid " +
                  PropertyOf(participant.qos, "__Pid") + " on " +
                  PropertyOf(participant.qos, "__Hostname") + ")";
  };
  ForEach<dds_builtintopic_participant_t>(participants_, DDS_ALIVE_INSTANCE_STATE, note);
  ForEach<dds_builtintopic_participant_t>(participants_, kEnded, [](const auto&) {});
  return present;
}

void StrangerWatch::SettleAdmitted(dds_entity_t endpoints) {
  const auto settle = [this](const dds_builtintopic_endpoint_t& endpoint) {
    const auto known = programs_.find(IdOf(endpoint.participant_key));
    if (known != programs_.end()) known->second.is_settled = true;
  };
  ForEach<dds_builtintopic_endpoint_t>(endpoints, DDS_ALIVE_INSTANCE_STATE, settle);
  // A program that was here for less than a period; the end of its participant may go unnoticed
  // until its lease is over.
  ForEach<dds_builtintopic_endpoint_t>(endpoints, kEnded, settle);
}

std::vector<std::string> StrangerWatch::Look(Time now) {
  if (now < due_) return {};
  due_ = now + kPeriod;
  const std::map<Id, std::string> present = Present();
  for (const auto& [id, words] : present) {
    const auto known = programs_.find(id);
    if (known != programs_.end()) {
      known->second.last_seen = now;
    } else if (programs_.size() < kProgramsMax) {
      programs_[id] = {.first_seen = now, .last_seen = now};
    }
  }
  std::erase_if(programs_,
                [&](const auto& entry) { return now - entry.second.last_seen > kPatience; });
  const bool unsettled =
      std::ranges::any_of(programs_, [](const auto& entry) { return !entry.second.is_settled; });
  if (!unsettled) return {};
  SettleAdmitted(publications_);
  SettleAdmitted(subscriptions_);
  std::vector<std::string> strangers;
  for (auto& [id, program] : programs_) {
    const auto seen = present.find(id);
    if (program.is_settled || seen == present.end() || now - program.first_seen < kPatience) {
      continue;
    }
    strangers.push_back(seen->second);
    program.is_settled = true;
  }
  return strangers;
}

}  // namespace collision::dds
