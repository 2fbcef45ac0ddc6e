#include "client/programs/foxglove/channel.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <set>

#include "client/programs/foxglove/messages/foxglove.pb.h"
#include "idl/messages.pb.h"

namespace collision::client {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FileDescriptor;
using google::protobuf::FileDescriptorSet;

/// A file stands behind those that it imports.
void AddWithImports(const FileDescriptor& file, std::set<std::string>* names,
                    FileDescriptorSet* all) {
  if (!names->insert(file.name()).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) {
    AddWithImports(*file.dependency(i), names, all);
  }
  file.CopyTo(all->add_file());
}

Channel ProtobufChannel(ChannelId id, const std::string& topic, const Descriptor& type) {
  std::set<std::string> names;
  FileDescriptorSet files;
  AddWithImports(*type.file(), &names, &files);
  return {.id = static_cast<std::uint32_t>(id),
          .topic = topic,
          .encoding = "protobuf",
          .schema_name = type.full_name(),
          .schema = files.SerializeAsString(),
          .schema_encoding = "protobuf"};
}

Channel CdrChannel(ChannelId id, const std::string& topic, const std::string& type,
                   const std::string& fields) {
  // The types that a message uses follow it, each behind a line of 80.
  const std::string time = std::string(80, '=') +
                           "\nMSG: builtin_interfaces/Time\n"
                           "int32 sec\n"
                           "uint32 nanosec\n";
  return {.id = static_cast<std::uint32_t>(id),
          .topic = topic,
          .encoding = "cdr",
          .schema_name = type,
          .schema = fields + time,
          .schema_encoding = "ros2msg"};
}

// numbers_channel.cc writes the fields in this order.
constexpr char kWorldFields[] =
    "# NaN: there is none.\n"
    "builtin_interfaces/Time stamp\n"
    "uint32 agents\n"
    "uint32 pairs_tracked\n"
    "uint32 events_possible  # open now\n"
    "uint32 events_confirmed  # open now\n"
    "uint64 contacts  # confirmed so far\n"
    "float64 earliest_contact_s  # ahead of the stamp: no contact begins before\n"
    "float64 least_clearance_s  # ahead of the stamp, of all agents\n"
    "float64 cpu_s  # processor time of the service so far\n"
    "uint64 memory_bytes  # of the service\n";

constexpr char kNearestFields[] =
    "# The pair that is expected to touch next, or touches; NaN and no names: there is none.\n"
    "builtin_interfaces/Time stamp\n"
    "float64 gap_lower_m\n"
    "float64 gap_upper_m\n"
    "float64 begin_earliest_s  # ahead of the stamp\n"
    "float64 begin_latest_s  # likewise\n"
    "string lower\n"
    "string higher\n";

std::vector<Channel> MakeChannels() {
  return {
      ProtobufChannel(ChannelId::kScene, "/scene", *foxglove::SceneUpdate::descriptor()),
      ProtobufChannel(ChannelId::kTransforms, "/tf", *foxglove::FrameTransforms::descriptor()),
      ProtobufChannel(ChannelId::kEvents, "/events", *v1::CollisionEvent::descriptor()),
      ProtobufChannel(ChannelId::kStatus, "/status", *v1::ServiceStatus::descriptor()),
      ProtobufChannel(ChannelId::kLog, "/log", *foxglove::Log::descriptor()),
      CdrChannel(ChannelId::kWorldNumbers, "/numbers/world", "collision/msg/WorldNumbers",
                 kWorldFields),
      CdrChannel(ChannelId::kNearestNumbers, "/numbers/nearest", "collision/msg/NearestNumbers",
                 kNearestFields),
  };
}

}  // namespace

const std::vector<Channel>& Channels() {
  static const std::vector<Channel> all = MakeChannels();
  return all;
}

bool IsChannel(std::uint32_t id) { return id >= 1 && id <= Channels().size(); }

}  // namespace collision::client
