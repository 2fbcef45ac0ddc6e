// A scene as channels of messages.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "client/programs/foxglove/channel.h"
#include "client/programs/foxglove/channels/channel_source.h"
#include "client/programs/foxglove/messages/channel_message.h"
#include "client/programs/scene/board.h"
#include "client/programs/scene/scene.h"

namespace collision::client {

/// Puts a scene on one board for each channel; a ChannelReader takes messages from it. A channel
/// that has no reader costs nothing; its first reader gets all that stands with the next Put().
class FoxgloveChannels {
 public:
  FoxgloveChannels();
  FoxgloveChannels(const FoxgloveChannels&) = delete;
  FoxgloveChannels& operator=(const FoxgloveChannels&) = delete;

  /// Takes what has changed in the scene, of each step. Where time has begun anew all is put anew.
  /// Returns whether any message is new. One thread.
  bool Put(const Scene& scene, const SceneChanges& changes, bool service_alive);

  /// The world's time in the newest step, >= 0: set before its messages are put. Any thread.
  std::int64_t now_ns() const { return now_ns_; }

  /// How many messages are kept of a channel; 0 if it is not read.
  std::size_t kept(ChannelId id) const { return At(id).board.size(); }

 private:
  friend class ChannelReader;

  struct Entry {
    Board board = {};
    std::atomic<int> readers = 0;
    bool is_shown = false;  ///< All that stands is on the board.
    std::unique_ptr<ChannelSource> source = nullptr;
  };

  Entry& At(ChannelId id) { return entries_[static_cast<std::size_t>(id) - 1]; }
  const Entry& At(ChannelId id) const { return entries_[static_cast<std::size_t>(id) - 1]; }
  bool TakeTime(std::int64_t now_ns);
  bool TakeWorld(const Scene& scene, const SceneChanges& changes);

  std::array<Entry, static_cast<std::size_t>(ChannelId::kNearestNumbers)> entries_;
  std::atomic<std::int64_t> now_ns_ = 0;
  ShownWorld world_;
  bool is_read_ = false;  ///< Any channel was in the last step, so that world_ is complete.
};

/// Reads one channel from now on: what stands, then what changes, of each item the newest alone.
/// One thread, another one than that of Put() if need be.
class ChannelReader {
 public:
  /// `channels` outlives it.
  ChannelReader(FoxgloveChannels* channels, ChannelId id) : entry_(channels->At(id)) {
    ++entry_.readers;
  }
  ~ChannelReader() { --entry_.readers; }
  ChannelReader(const ChannelReader&) = delete;
  ChannelReader& operator=(const ChannelReader&) = delete;

  /// The oldest change that was not returned yet (channel_message.h); null: there is none.
  Payload Next() {
    Board::News news = entry_.board.After(seen_, 0);
    seen_ = news.seen;
    return news.items.empty() ? nullptr : std::move(news.items.front().payload);
  }

 private:
  FoxgloveChannels::Entry& entry_;
  std::uint64_t seen_ = 0;
};

}  // namespace collision::client
