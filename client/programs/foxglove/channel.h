// The channels in which Foxglove, Lichtblick, PlotJuggler and MCAP files get a world.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace collision::client {

/// The id of a channel, the same in every version.
enum class ChannelId : std::uint32_t {
  kScene = 1,       ///< Bodies and contacts.
  kTransforms,      ///< Where they are.
  kEvents,          ///< Collision events.
  kStatus,          ///< What the service says of itself.
  kLog,             ///< Sentences for people.
  kWorldNumbers,    ///< Plain numbers of the world.
  kNearestNumbers,  ///< Plain numbers of the pair that is expected to touch next.
};

/// A topic with all that a client must know to read its messages.
struct Channel {
  std::uint32_t id = 0;
  std::string topic;
  std::string encoding;         ///< Of messages: "protobuf", or "cdr".
  std::string schema_name;      ///< "foxglove.SceneUpdate".
  std::string schema;           ///< Bytes of a FileDescriptorSet with all imports, or a text.
  std::string schema_encoding;  ///< "protobuf", or "ros2msg".
};

/// All of them; the one with id i is at i - 1. PlotJuggler takes live what is "cdr" with "ros2msg",
/// and nothing else.
const std::vector<Channel>& Channels();

/// Whether there is a channel of this id.
bool IsChannel(std::uint32_t id);

}  // namespace collision::client
