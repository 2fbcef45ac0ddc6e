#include "idl/dds/watch/misfit_watch.h"

#include <array>

#include "dds/ddsrt/log.h"

namespace collision::dds {
namespace {

std::string NameOf(std::uint32_t policy) {
  switch (policy) {
    case DDS_RELIABILITY_QOS_POLICY_ID:
      return "reliability";
    case DDS_DURABILITY_QOS_POLICY_ID:
      return "durability";
    case DDS_OWNERSHIP_QOS_POLICY_ID:
      return "ownership";
    case DDS_LIVELINESS_QOS_POLICY_ID:
      return "liveliness";
    case DDS_DEADLINE_QOS_POLICY_ID:
      return "deadline";
    case DDS_DATA_REPRESENTATION_QOS_POLICY_ID:
      return "data representation";
    case DDS_TYPE_CONSISTENCY_ENFORCEMENT_QOS_POLICY_ID:
      return "type";
    default:
      return "policy " + std::to_string(policy);
  }
}

std::string TopicOf(dds_entity_t endpoint) {
  std::array<char, 64> name{};
  const dds_entity_t topic = dds_get_topic(endpoint);
  if (topic <= 0 || dds_get_name(topic, name.data(), name.size()) < 0) return "a topic";
  return name.data();
}

}  // namespace

MisfitWatch::MisfitWatch() : listener_(dds_create_listener(this)) {
  dds_lset_requested_incompatible_qos(
      listener_, [](dds_entity_t reader, dds_requested_incompatible_qos_status_t status, void* me) {
        static_cast<MisfitWatch*>(me)->Tell(reader, "writer", status.last_policy_id);
      });
  dds_lset_offered_incompatible_qos(
      listener_, [](dds_entity_t writer, dds_offered_incompatible_qos_status_t status, void* me) {
        static_cast<MisfitWatch*>(me)->Tell(writer, "reader", status.last_policy_id);
      });
}

MisfitWatch::~MisfitWatch() { dds_delete_listener(listener_); }

void MisfitWatch::Tell(dds_entity_t entity, const char* whose, std::uint32_t policy) {
  if (policy == DDS_PARTITION_QOS_POLICY_ID || policy == DDS_INVALID_QOS_POLICY_ID) return;
  const std::string text = std::string("a ") + whose + " of " + TopicOf(entity) +
                           " does not fit: " + NameOf(policy) +
                           "; collisionctl doctor says whose it is";
  {
    const std::lock_guard lock(mutex_);
    if (!told_.insert(text).second) return;
  }
  dds_log(DDS_LC_WARNING, __FILE__, __LINE__, __func__, "%s\n", text.c_str());
}

}  // namespace collision::dds
