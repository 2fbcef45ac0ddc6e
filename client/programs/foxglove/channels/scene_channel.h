// What a 3D panel draws: bodies and contacts.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client/programs/foxglove/channels/channel_source.h"

namespace collision::client {

/// foxglove.SceneUpdate. The name of an item is the id of its entity, or says that it is gone; so a
/// viewer that reads slowly never keeps what has left.
///   agent/N   the body of the agent with number N, in a frame of its own: it is sent once, and
///             again when its shape or level changes; /tf moves it
///   chunk/C   in a crowded world, the agents of a chunk as balls in the world's frame
///   contact/S a contact that lasts: its point, normal and names; S is used again
///   all       all of before is deleted
class SceneChannel final : public ChannelSource {
 public:
  /// The body of an agent that takes more bytes keeps its first color.
  static constexpr std::size_t kRecoloredBytesMax = 1 << 16;

  /// Contacts that are shown at a time.
  static constexpr std::size_t kContactsMax = 1000;

  /// A contact is shown so much longer than it lasts, in the world's time.
  static constexpr std::int64_t kAfterContactNs = 2'000'000'000;

  void PutAll(const SceneStep& step, ChannelBoard* board) override;
  void PutChanges(const SceneStep& step, ChannelBoard* board) override;

 private:
  void PutAgent(const SceneStep& step, std::uint32_t number, ChannelBoard* board);
  void PutChunk(const SceneStep& step, std::uint32_t chunk, ChannelBoard* board);
  void PutEvent(const SceneStep& step, std::uint64_t number, ChannelBoard* board);
  void EndContact(std::uint64_t number, std::int64_t now_ns);
  void RemoveEnded(const SceneStep& step, ChannelBoard* board);

  bool is_crowded_ = false;
  std::map<std::uint32_t, std::size_t> shown_;       ///< Bytes of an agent's entity, by number.
  std::map<std::uint64_t, std::uint32_t> contacts_;  ///< Their places, by number of the event.
  std::set<std::uint32_t> free_;                     ///< Places that were used.
  /// When, and which place is freed.
  std::deque<std::pair<std::int64_t, std::uint32_t>> ended_;
};

}  // namespace collision::client
