// A world that is heard, as messages for the page, one behind the other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/library/network/message_monitor.h"
#include "client/programs/scene/board.h"
#include "client/programs/scene/page_items.h"
#include "client/programs/scene/scene.h"

namespace collision::client {

/// Hears a world, and hands out what is new for a page that has all of before. Each state is told
/// once, and shapes come along with their bytes. One thread.
class PageStream {
 public:
  explicit PageStream(std::unique_ptr<Receiver> receiver);
  PageStream(const PageStream&) = delete;
  PageStream& operator=(const PageStream&) = delete;

  /// Hears what comes within `timeout`. Returns how many messages came.
  std::size_t Poll(std::chrono::nanoseconds timeout) { return monitor_.Poll(timeout); }

  /// By the names that the board has; states are named "states", rounded to `step`
  /// (StateTable::PackAfter()).
  std::vector<Board::Item> TakeNew(double step = 0);

  /// What had changed in the scene at the last TakeNew().
  const SceneChanges& changes() const { return changes_; }

  /// The world's time has begun anew since it was first told, or since BeginAnew(): what comes now
  /// is of another epoch, and would take from a page what it has.
  bool IsOver() const;

  /// What comes next is for a page that has nothing.
  void BeginAnew();

  const Scene& scene() const { return scene_; }
  const MessageMonitor& monitor() const { return monitor_; }

 private:
  ShapeStore shapes_;
  Scene scene_{&shapes_};
  Board board_;
  SceneChanges changes_;
  PageItems items_{&board_, StatesOnBoard::kNone};
  std::uint64_t seen_ = 0, seen_states_ = 0;
  std::optional<v1::ServiceStamp> begun_;  ///< Of the first status.
  MessageMonitor monitor_;
};

}  // namespace collision::client
