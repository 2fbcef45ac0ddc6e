// What makes the messages of one channel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "client/programs/foxglove/channels/shown_world.h"
#include "client/programs/foxglove/messages/channel_message.h"
#include "client/programs/foxglove/messages/foxglove.pb.h"
#include "client/programs/scene/board.h"
#include "client/programs/scene/scene.h"

namespace collision::client {

/// A scene at one moment, with what has changed since the last one.
struct SceneStep {
  const Scene& scene;
  const SceneChanges& changes;
  const ShownWorld& world;
  std::int64_t now_ns = 0;  ///< The world's time, >= 0.
  bool service_alive = false;
};

/// A board on which messages get their time. One thread.
class ChannelBoard {
 public:
  ChannelBoard(Board* board, std::int64_t now_ns) : board_(*board), now_ns_(now_ns) {}

  void Put(const std::string& name, const std::string& bytes) {
    board_.Put(name, MakeChannelMessage(now_ns_, bytes));
    is_new_ = true;
  }
  void Put(const std::string& name, const google::protobuf::MessageLite& message) {
    Put(name, message.SerializeAsString());
  }
  void Remove(const std::string& name) { board_.Remove(name); }

  bool is_new() const { return is_new_; }

 private:
  Board& board_;
  const std::int64_t now_ns_;
  bool is_new_ = false;
};

/// Puts messages on the board of its channel, items by name. One thread.
class ChannelSource {
 public:
  ChannelSource() = default;
  virtual ~ChannelSource() = default;
  ChannelSource(const ChannelSource&) = delete;
  ChannelSource& operator=(const ChannelSource&) = delete;

  /// The board is empty: puts all that stands, and forgets what was before.
  virtual void PutAll(const SceneStep& step, ChannelBoard* board) = 0;

  /// Puts what has changed in this step; each step since PutAll() passes here.
  virtual void PutChanges(const SceneStep& step, ChannelBoard* board) = 0;
};

/// An instant as Foxglove has it; what lies before 0 is 0.
inline void SetTime(std::int64_t instant_ns, google::protobuf::Timestamp* time) {
  constexpr std::int64_t kNanosecondsOfSecond = 1'000'000'000;
  const std::int64_t ns = std::max<std::int64_t>(0, instant_ns);
  time->set_seconds(ns / kNanosecondsOfSecond);
  time->set_nanos(static_cast<std::int32_t>(ns % kNanosecondsOfSecond));
}

/// From `now_ns` to an instant [s]; NaN if it is never, or not known.
inline double SecondsAhead(std::int64_t instant_ns, std::int64_t now_ns) {
  using Limits = std::numeric_limits<std::int64_t>;
  if (instant_ns == Limits::max() || instant_ns == Limits::min()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return 1e-9 * (static_cast<double>(instant_ns) - static_cast<double>(now_ns));
}

}  // namespace collision::client
