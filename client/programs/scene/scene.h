// What a monitor hears, as a world that viewers are shown.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client/library/network/message_monitor.h"
#include "client/programs/scene/event_book.h"
#include "client/programs/scene/shape_store.h"
#include "client/programs/scene/state_table.h"
#include "client/programs/shared/world_view.h"

namespace collision::client {

/// What has changed in a scene.
struct SceneChanges {
  using Slot = std::pair<std::uint64_t, std::uint32_t>;  ///< Simulator, slot.

  std::set<Slot> agents;              ///< Of them anything but their states.
  std::vector<std::uint32_t> chunks;  ///< Of states.
  EventBook::Changes events;
  std::vector<std::string> shapes;  ///< That are whole now: their hashes, 32 bytes.
  bool status = false, earliest = false;
  bool now = false;
};

/// Takes the messages of one world. One thread; the shapes are read by others.
class Scene {
 public:
  /// `shapes` outlives the scene.
  explicit Scene(ShapeStore* shapes) : shapes_(*shapes) {}
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// They refer to the scene, which outlives the monitor that holds them.
  MessageMonitor::Callbacks Callbacks();

  /// Since the last call.
  SceneChanges TakeChanges();

  const WorldView& view() const { return view_; }
  const EventBook& events() const { return events_; }
  const ShapeStore& shapes() const { return shapes_; }
  const StateTable& states() const { return states_; }

  /// The number of an agent in the table of states; nullopt: there are too many.
  std::optional<std::uint32_t> NumberOf(const SceneChanges::Slot& slot) const {
    return states_.Known(slot.first, slot.second);
  }

  /// The newest time that the service has told.
  std::int64_t now_ns() const { return now_ns_; }

 private:
  ShapeStore& shapes_;
  WorldView view_;
  EventBook events_;
  StateTable states_;
  std::set<SceneChanges::Slot> known_;  ///< Agents that are described.
  std::string presence_;                ///< What the newest status says of simulators.
  std::int64_t now_ns_ = 0;
  std::int64_t taken_ns_ = 0;  ///< In the changes that were taken.
  SceneChanges changes_;
};

}  // namespace collision::client
