#include "idl/dds/neighbours/neighbours.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <utility>

#include "dds/dds.h"
#include "dds/ddsi/ddsi_sertype.h"  // what ddsi_typelib.h needs and does not include
#include "dds/ddsi/ddsi_typelib.h"
#include "dds/ddsrt/log.h"
#include "idl/dds/endpoints.h"
#include "idl/dds/entity.h"
#include "idl/dds/headroom.h"
#include "idl/dds/security/credentials.h"
#include "idl/dds/topics.h"

namespace collision {
namespace {

constexpr std::string_view kTopicsBegin = "collision/";

/// What one reader of a built-in topic holds now, whether or not it was read before.
template <class Sample, class Function>
void Each(dds_entity_t reader, Function&& function) {
  constexpr std::size_t kAtOnce = 4096;
  std::vector<void*> samples(kAtOnce, nullptr);
  std::vector<dds_sample_info_t> infos(kAtOnce);
  const dds_return_t count = dds_read(reader, samples.data(), infos.data(), kAtOnce, kAtOnce);
  for (dds_return_t i = 0; i < count; ++i) {
    if (infos[i].valid_data && infos[i].instance_state == DDS_ALIVE_INSTANCE_STATE)
      function(*static_cast<const Sample*>(samples[i]), infos[i].instance_handle);
  }
  if (count > 0) dds_return_loan(reader, samples.data(), count);
}

std::string Property(const dds_qos_t* qos, const char* name) {
  char* value = nullptr;
  if (!dds_qget_prop(qos, name, &value) || value == nullptr) return "";
  std::string text = value;
  dds_free(value);
  return text;
}

std::vector<std::string> PartitionsOf(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  char** names = nullptr;
  std::vector<std::string> partitions;
  if (!dds_qget_partition(qos, &count, &names)) return partitions;
  for (std::uint32_t i = 0; i < count; ++i) {
    partitions.emplace_back(names[i]);
    dds_free(names[i]);
  }
  dds_free(names);
  return partitions;
}

/// The last byte of the GUID says what an endpoint is. Source: DDSI-RTPS 2.3, table 9.1.
bool IsKeyed(const dds_guid_t& guid) {
  constexpr unsigned char kWriterWithKey = 0x02, kReaderWithKey = 0x07;
  const unsigned char kind = guid.v[15] & 0x3f;
  return kind == kWriterWithKey || kind == kReaderWithKey;
}

std::string_view Name(dds_durability_kind_t kind) {
  constexpr std::array<std::string_view, 4> kNames = {"volatile", "transient-local", "transient",
                                                      "persistent"};
  return kNames.at(static_cast<std::size_t>(kind));
}

/// Of the policies by which a reader of one kind can refuse a writer of another (DDS 1.4, 2.2.3)
/// those that ours do not leave at their defaults, and ownership.
std::string MisfitOfQos(const dds::TopicRow& row, const dds_qos_t* qos, bool writes) {
  dds_reliability_kind_t reliability = DDS_RELIABILITY_RELIABLE;
  if (writes && dds_qget_reliability(qos, &reliability, nullptr) &&
      reliability != DDS_RELIABILITY_RELIABLE) {
    return "it offers best effort, and readers request reliable";
  }
  const auto ours =
      row.late_joiners_depth > 0 ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE;
  dds_durability_kind_t durability = ours;
  dds_qget_durability(qos, &durability);
  if (writes ? durability < ours : durability > ours) {
    return "durability: it " + std::string(writes ? "offers " : "requests ") +
           std::string(Name(durability)) + ", " +
           (writes ? "and readers request " : "and writers offer ") + std::string(Name(ours));
  }
  dds_ownership_kind_t ownership = DDS_OWNERSHIP_SHARED;
  if (dds_qget_ownership(qos, &ownership) && ownership != DDS_OWNERSHIP_SHARED)
    return "ownership: it is exclusive, and must be shared";
  if (row.id != dds::TopicId::kServiceStatus) return "";
  dds_liveliness_kind_t liveliness = DDS_LIVELINESS_AUTOMATIC;
  dds_duration_t lease = 0;
  if (!dds_qget_liveliness(qos, &liveliness, &lease) || !writes) return "";
  if (lease <= dds::kServiceLeaseMax.count()) return "";
  return "liveliness: its lease is longer than the 2 s that readers request";
}

/// What the type information of both tells; nothing where one of them has none.
bool IsSameType(dds_entity_t topic, dds_builtintopic_endpoint_t* endpoint) {
  const dds_typeinfo_t* theirs = nullptr;
  dds_typeinfo_t* ours = nullptr;
  if (dds_builtintopic_get_endpoint_type_info(endpoint, &theirs) != DDS_RETCODE_OK ||
      theirs == nullptr || dds_get_typeinfo(topic, &ours) != DDS_RETCODE_OK || ours == nullptr) {
    return true;
  }
  const bool is_same = ddsi_typeid_compare(ddsi_typeinfo_minimal_typeid(theirs),
                                           ddsi_typeinfo_minimal_typeid(ours)) == 0;
  dds_free_typeinfo(ours);
  return is_same;
}

/// Whether credentials let anyone who looks on have this topic; DDS reports each refusal.
bool IsForMonitors(const dds::TopicRow& row) { return row.source != dds::Source::kOperators; }

std::string Misfit(dds_entity_t participant, bool is_secured, dds_builtintopic_endpoint_t endpoint,
                   bool writes) {
  const std::string_view name = endpoint.topic_name;
  const auto row = std::ranges::find(dds::Topics(), name, &dds::TopicRow::name);
  if (row == dds::Topics().end()) return "topic of another version of the wire";
  if (std::string_view(endpoint.type_name) != row->type->m_typename)
    return "its type is \"" + std::string(endpoint.type_name) + "\", not \"" +
           row->type->m_typename + "\"";
  if (!IsKeyed(endpoint.key)) return "its type has no key";
  const dds_entity_t topic =
      is_secured && !IsForMonitors(*row)
          ? 0
          : dds_create_topic(participant, row->type, row->name, nullptr, nullptr);
  const dds::Entity owner(topic);
  if (topic > 0 && !IsSameType(topic, &endpoint)) {
    return "its type has other members: it was built from another collision.idl";
  }
  return MisfitOfQos(*row, endpoint.qos, writes);
}

}  // namespace

std::string OwnDdsAddress(std::uint32_t domain) {
  dds::RequireHeadroom();
  // Cyclone DDS tells it in its trace alone, of the category "config".
  static std::string address;
  address.clear();
  const dds_log_write_fn_t take = [](void*, const dds_log_data_t* line) {
    constexpr std::string_view kMark = "ownip: udp/";
    const std::string_view text(line->message, line->size);
    const std::size_t mark = text.find(kMark);
    if (mark == std::string_view::npos) return;
    const std::string_view rest = text.substr(mark + kMark.size());
    address = rest.substr(0, rest.find_first_not_of("0123456789."));
  };
  const char* profile = std::getenv("CYCLONEDDS_URI");
  const std::string before = profile == nullptr ? "" : profile;
  const std::string traced = (before.empty() ? "" : before + ",") +
                             "<CycloneDDS><Domain Id=\"any\"><Tracing><Category>config</Category>"
                             "<OutputFile>/dev/null</OutputFile></Tracing></Domain></CycloneDDS>";
  setenv("CYCLONEDDS_URI", traced.c_str(), 1);
  dds_set_trace_sink(take, nullptr);
  const dds_entity_t participant = dds_create_participant(domain, nullptr, nullptr);
  if (participant > 0) dds_delete(participant);
  dds_set_trace_sink(nullptr, nullptr);
  profile == nullptr ? unsetenv("CYCLONEDDS_URI") : setenv("CYCLONEDDS_URI", before.c_str(), 1);
  return address;
}

DdsLookout::DdsLookout(std::uint32_t domain, const std::string& credentials,
                       const std::string& world) {
  const dds::Qos qos = dds::MakeQos();
  if (!credentials.empty()) {
    credentials_ = std::make_unique<dds::Credentials>(credentials, domain);
    credentials_->Apply(qos.get());
  }
  dds::RequireHeadroom();
  participant_ = dds::Check(dds_create_participant(domain, qos.get(), nullptr),
                            "DDS participant in domain " + std::to_string(domain));
  const auto read = [this](dds_entity_t topic) {
    return dds_create_reader(participant_, topic, nullptr, nullptr);
  };
  programs_ = read(DDS_BUILTIN_TOPIC_DCPSPARTICIPANT);
  writers_ = read(DDS_BUILTIN_TOPIC_DCPSPUBLICATION);
  readers_ = read(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION);
  if (credentials_) ShowReader(world);
}

void DdsLookout::ShowReader(const std::string& world) const {
  const auto row =
      std::ranges::find(dds::Topics(), dds::TopicId::kServiceStatus, &dds::TopicRow::id);
  const dds_entity_t topic = dds_create_topic(participant_, row->type, row->name, nullptr, nullptr);
  const dds::Qos qos = dds::MakeQos();
  const char* partition = world.c_str();
  dds_qset_partition(qos.get(), 1, &partition);
  const dds_entity_t subscriber = dds_create_subscriber(participant_, qos.get(), nullptr);
  dds_create_reader(subscriber, topic, nullptr, nullptr);
}

DdsLookout::DdsLookout(DdsLookout&& other) noexcept
    : credentials_(std::move(other.credentials_)),
      participant_(std::exchange(other.participant_, 0)),
      programs_(other.programs_),
      writers_(other.writers_),
      readers_(other.readers_) {}

DdsLookout::~DdsLookout() {
  if (participant_ > 0) dds_delete(participant_);
}

/// The participants of this process in the domain of one of them.
std::vector<dds_instance_handle_t> OwnParticipants(dds_entity_t one) {
  dds_domainid_t domain = 0;
  std::array<dds_entity_t, 16> own{};
  if (dds_get_domainid(one, &domain) != DDS_RETCODE_OK) return {};
  const dds_return_t count = dds_lookup_participant(domain, own.data(), own.size());
  std::vector<dds_instance_handle_t> handles;
  for (std::size_t i = 0; i < own.size() && static_cast<dds_return_t>(i) < count; ++i) {
    dds_instance_handle_t handle = 0;
    if (dds_get_instance_handle(own.at(i), &handle) == DDS_RETCODE_OK) handles.push_back(handle);
  }
  return handles;
}

DdsNeighbours DdsLookout::Look() const {
  DdsNeighbours seen;
  const std::vector<dds_instance_handle_t> own = OwnParticipants(participant_);
  Each<dds_builtintopic_participant_t>(
      programs_, [&](const dds_builtintopic_participant_t& one, dds_instance_handle_t handle) {
        DdsProgram& program = seen.programs[handle];
        program.process = Property(one.qos, "__ProcessName");
        program.pid = Property(one.qos, "__Pid");
        program.host = Property(one.qos, "__Hostname");
        program.addresses = Property(one.qos, "__NetworkAddresses");
        program.is_own = std::ranges::count(own, handle) > 0;
      });
  for (const bool writes : {true, false}) {
    Each<dds_builtintopic_endpoint_t>(
        writes ? writers_ : readers_,
        [&](const dds_builtintopic_endpoint_t& one, dds_instance_handle_t) {
          if (!std::string_view(one.topic_name).starts_with(kTopicsBegin)) return;
          seen.peers.push_back(
              {.program = one.participant_instance_handle,
               .writes = writes,
               .topic = one.topic_name,
               .partitions = PartitionsOf(one.qos),
               .misfit = Misfit(participant_, credentials_ != nullptr, one, writes)});
        });
  }
  return seen;
}

}  // namespace collision
