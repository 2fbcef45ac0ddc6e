// A reader or writer of one of the topics that no other program can meet, for the doctor to find.
//
//   stranger TROUBLE WORLD DOMAIN
//
// TROUBLE: best-effort, volatile, exclusive, long-lease, no-key, other-name, other-members,
// other-version, persistent-reader. It says "here" on standard output, and stays until it is
// killed.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

#include "dds/dds.h"
#include "idl/dds/entity.h"
#include "idl/dds/topics.h"

namespace collision::dds {
namespace {

/// What a program that is built rightly would have, for one trouble to change.
struct Endpoint {
  TopicId topic = TopicId::kAgentStates;
  const dds_topic_descriptor_t* type = nullptr;
  std::string topic_name;
  bool writes = true;
  dds_qos_t* qos = dds_create_qos();
};

/// A copy with another type name, and without a key where `keyed` is false.
const dds_topic_descriptor_t* Changed(const dds_topic_descriptor_t& type, const char* name,
                                      bool keyed) {
  constexpr std::uint32_t kKeyFlags = DDS_TOPIC_FIXED_KEY | DDS_TOPIC_FIXED_KEY_XCDR2;
  static dds_topic_descriptor_t changed = {
      .m_size = type.m_size,
      .m_align = type.m_align,
      .m_flagset = keyed ? type.m_flagset : type.m_flagset & ~kKeyFlags,
      .m_nkeys = keyed ? type.m_nkeys : 0,
      .m_typename = name,
      .m_keys = keyed ? type.m_keys : nullptr,
      .m_nops = type.m_nops,
      .m_ops = type.m_ops,
      .m_meta = type.m_meta,
      .type_information = type.type_information,
      .type_mapping = type.type_mapping,
      .restrict_data_representation = type.restrict_data_representation};
  return &changed;
}

const std::map<std::string, std::function<void(Endpoint*)>> kTroubles = {
    {"best-effort",
     [](Endpoint* one) { dds_qset_reliability(one->qos, DDS_RELIABILITY_BEST_EFFORT, 0); }},
    {"volatile", [](Endpoint* one) { dds_qset_durability(one->qos, DDS_DURABILITY_VOLATILE); }},
    {"exclusive", [](Endpoint* one) { dds_qset_ownership(one->qos, DDS_OWNERSHIP_EXCLUSIVE); }},
    {"long-lease",
     [](Endpoint* one) {
       one->topic = TopicId::kServiceStatus;
       dds_qset_liveliness(one->qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(3));
     }},
    {"no-key",
     [](Endpoint* one) {
       const dds_topic_descriptor_t& type = *Row(TopicId::kWatch).type;
       one->topic = TopicId::kWatch;
       one->type = Changed(type, type.m_typename, false);
     }},
    {"other-name",
     [](Endpoint* one) { one->type = Changed(*Row(one->topic).type, "lab::States", true); }},
    {"other-members",
     [](Endpoint* one) {
       one->type = Changed(*Row(TopicId::kWatch).type, Row(one->topic).type->m_typename, true);
     }},
    {"other-version", [](Endpoint* one) { one->topic_name = "collision/v2/agent_states"; }},
    {"persistent-reader",
     [](Endpoint* one) {
       one->topic = TopicId::kContact;
       one->writes = false;
       dds_qset_durability(one->qos, DDS_DURABILITY_PERSISTENT);
     }},
};

int Stay(const std::string& trouble, const std::string& world, std::uint32_t domain) {
  Endpoint one;
  dds_qset_reliability(one.qos, DDS_RELIABILITY_RELIABLE, 0);
  dds_qset_durability(one.qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  kTroubles.at(trouble)(&one);
  const TopicRow& row = Row(one.topic);
  const bool of_simulator = row.source == Source::kSimulators;
  dds_qset_partition1(one.qos, (of_simulator ? world + ".stranger" : world).c_str());
  const Entity participant(Check(dds_create_participant(domain, nullptr, nullptr), "participant"));
  const dds_entity_t topic =
      Check(dds_create_topic(participant.get(), one.type == nullptr ? row.type : one.type,
                             one.topic_name.empty() ? row.name : one.topic_name.c_str(), nullptr,
                             nullptr),
            "topic");
  Check(one.writes ? dds_create_writer(participant.get(), topic, one.qos, nullptr)
                   : dds_create_reader(participant.get(), topic, one.qos, nullptr),
        "endpoint");
  dds_delete_qos(one.qos);
  std::puts("here");
  std::fflush(stdout);
  for (;;) pause();
}

}  // namespace
}  // namespace collision::dds

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  return collision::dds::Stay(argv[1], argv[2],
                              static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10)));
}
