// A message of a channel with its time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "client/programs/scene/payload.h"

namespace collision::client {

/// Before the message, as Foxglove's WebSocket protocol wants it: u64 time [ns], little-endian.
inline constexpr std::size_t kMessageTimeBytes = 8;

/// `time_ns`: the world's time when it was put, >= 0.
inline Payload MakeChannelMessage(std::int64_t time_ns, const std::string& message) {
  std::string bytes;
  bytes.reserve(kMessageTimeBytes + message.size());
  for (std::size_t i = 0; i < kMessageTimeBytes; ++i) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(time_ns) >> (8 * i));
  }
  return MakePayload(bytes + message);
}

inline std::int64_t TimeOf(const std::string& channel_message) {
  std::uint64_t time = 0;
  for (std::size_t i = kMessageTimeBytes; i-- > 0;) {
    time = time << 8 | static_cast<unsigned char>(channel_message[i]);
  }
  return static_cast<std::int64_t>(time);
}

/// The message alone. Refers to `channel_message`.
inline std::string_view MessageOf(const std::string& channel_message) {
  return std::string_view(channel_message).substr(kMessageTimeBytes);
}

}  // namespace collision::client
