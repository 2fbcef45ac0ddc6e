// A program that writes clearances in the partition "*", in which it would meet the readers of
// every world, until it is ended; it says "writes" once it does. DOMAIN follows its name;
// credentials: COLLISION_CREDENTIALS.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <string>

#include "idl/dds/entity.h"
#include "idl/dds/security/credentials.h"
#include "idl/dds/topics.h"

namespace collision::dds {
namespace {

void WriteForAll(std::uint32_t domain, const std::string& credentials) {
  const Qos secured = MakeQos(), everywhere = MakeQos(), reliable = MakeQos();
  const Credentials shown(credentials, domain);
  shown.Apply(secured.get());
  const Entity participant(
      Check(dds_create_participant(domain, secured.get(), nullptr), "participant"));
  dds_qset_partition1(everywhere.get(), "*");
  const dds_entity_t publisher =
      Check(dds_create_publisher(participant.get(), everywhere.get(), nullptr), "publisher");
  const TopicRow& row = Row(TopicId::kClearance);
  const dds_entity_t topic =
      Check(dds_create_topic(participant.get(), row.type, row.name, nullptr, nullptr), "topic");
  dds_qset_reliability(reliable.get(), DDS_RELIABILITY_RELIABLE, 0);
  dds_qset_durability(reliable.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  const dds_entity_t writer =
      Check(dds_create_writer(publisher, topic, reliable.get(), nullptr), "writer");
  const dds_entity_t nothing = Check(dds_create_waitset(participant.get()), "waitset");
  for (bool first = true;; first = false) {
    collision_v1_Clearance clearance{};
    clearance.granted_until_ns = std::numeric_limits<std::int64_t>::max();
    clearance.stamp.term = std::numeric_limits<std::uint32_t>::max();
    Check(dds_write(writer, &clearance), "sample");
    if (first) std::printf("writes\n");
    std::fflush(stdout);
    dds_waitset_wait(nothing, nullptr, 0, DDS_MSECS(20));
  }
}

}  // namespace
}  // namespace collision::dds

int main(int count, char** words) {
  const char* credentials = std::getenv("COLLISION_CREDENTIALS");
  if (count != 2 || credentials == nullptr) {
    std::fprintf(stderr, "usage: COLLISION_CREDENTIALS=DIR star-writer DOMAIN\n");
    return 2;
  }
  try {
    collision::dds::WriteForAll(static_cast<std::uint32_t>(std::stoul(words[1])), credentials);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "star-writer: %s\n", error.what());
  }
  return 1;
}
