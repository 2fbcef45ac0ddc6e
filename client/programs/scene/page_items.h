// A scene as the items of the page's protocol.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "client/programs/scene/board.h"
#include "client/programs/scene/scene.h"

namespace collision::client {

/// Whether chunks of states are items of the board. A recording has each state once instead.
enum class StatesOnBoard { kAll, kNone };

/// Puts what has changed in a scene on a board. One thread; the board is read by others.
class PageItems {
 public:
  /// `board` outlives it.
  explicit PageItems(Board* board, StatesOnBoard states = StatesOnBoard::kAll)
      : board_(*board), states_(states) {}
  PageItems(const PageItems&) = delete;
  PageItems& operator=(const PageItems&) = delete;

  /// Of the connection, which no message tells.
  struct Connection {
    bool service_alive = false;
    std::uint64_t contacts_missed = 0;
    std::string unreadable = {};  ///< Why nothing of the service can be read; empty: it can.
    friend bool operator==(const Connection&, const Connection&) = default;
  };

  /// Returns whether anything is new.
  bool Put(const Scene& scene, const SceneChanges& changes, const Connection& connection);

  /// Something new for all viewers, so that they know that the gateway is there.
  void Beat();

 private:
  void PutJson(const std::string& name, std::string json);
  void PutAgent(const Scene& scene, const SceneChanges::Slot& slot);
  void PutEvents(const Scene& scene, const EventBook::Changes& changes);
  void PutConnection(const Connection& connection);

  Board& board_;
  const StatesOnBoard states_;
  std::optional<Connection> connection_;
  std::uint64_t gone_ = 0;  ///< Events that are not kept any more.
  bool changed_ = false;
};

}  // namespace collision::client
