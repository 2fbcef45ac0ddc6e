// What a monitor hears, as items that viewers are shown.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "client/library/network/message_monitor.h"
#include "client/programs/gateway/scene/board.h"
#include "client/programs/gateway/scene/event_book.h"
#include "client/programs/gateway/scene/shape_store.h"
#include "client/programs/gateway/scene/state_table.h"
#include "client/programs/shared/world_view.h"

namespace collision::gateway {

/// Takes the messages of one world, and puts on a board what they change. One thread; board and
/// shapes are read by others.
class Scene {
 public:
  /// Both outlive the scene.
  Scene(Board* board, ShapeStore* shapes) : board_(*board), shapes_(*shapes) {}
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// They refer to the scene, which outlives the monitor that holds them.
  client::MessageMonitor::Callbacks Callbacks();

  /// Of the connection, which no message tells.
  struct Connection {
    bool service_alive = false;
    std::uint64_t contacts_missed = 0;
    std::string unreadable = {};  ///< Why nothing of the service can be read; empty: it can.
    friend bool operator==(const Connection&, const Connection&) = default;
  };

  /// Puts what has changed since the last call on the board. Returns whether anything had.
  bool Publish(const Connection& connection);

  /// Something new for all viewers, so that they know that the gateway is there.
  void Beat();

  const client::WorldView& view() const { return view_; }

 private:
  using Slot = std::pair<std::uint64_t, std::uint32_t>;  ///< Simulator, slot.

  void Put(const std::string& name, std::string json);
  void PutAgent(const Slot& slot);
  void PutGone(const std::string& key);
  void PutNow();

  Board& board_;
  ShapeStore& shapes_;
  client::WorldView view_;
  EventBook events_;
  StateTable states_;
  std::set<Slot> known_;      ///< Agents that are described.
  std::set<Slot> described_;  ///< Of them, those of which something but their state has changed.
  std::string presence_;      ///< What the newest status says of simulators.
  std::uint64_t gone_ = 0;    ///< Events that are not kept any more.
  std::optional<Connection> connection_;
  bool has_status_ = false, has_earliest_ = false;  ///< Newer ones than on the board.
  std::int64_t now_ns_ = 0;                         ///< The newest that the service has told.
  std::int64_t shown_ns_ = 0;                       ///< On the board.
  bool changed_ = false;
};

}  // namespace collision::gateway
