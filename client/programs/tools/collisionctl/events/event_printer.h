// The events that `collisionctl events` prints.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <utility>

#include "client/programs/shared/world_view.h"
#include "client/programs/tools/collisionctl/events/event_filter.h"

namespace collision::client {

struct EventFormat {
  bool json = false;     ///< One document a line.
  bool explain = false;  ///< A sentence in place of the line; in JSON beside the rest.
};

/// Prints those events of a view that fit, a line each. One thread.
class EventPrinter {
 public:
  /// `out` outlives this.
  EventPrinter(EventFormat format, EventFilter filter, std::ostream* out)
      : format_(format), selection_(std::move(filter)), out_(*out) {}

  /// The newest revision of each.
  void PrintCurrent(WorldView* view);

  /// Every revision that has come since the last call. `told`: when it was published, in words that
  /// stand before each; empty: now.
  void PrintNew(WorldView* view, const std::string& told = {});

  /// Says once how many contacts were lost since it was said last; `missed`: in all.
  void PrintGap(std::uint64_t missed);

 private:
  void Print(const v1::CollisionEvent& event, const WorldView& view, const std::string& told = {});

  const EventFormat format_;
  EventSelection selection_;
  std::ostream& out_;
  std::uint64_t missed_ = 0;  ///< So many were told.
};

}  // namespace collision::client
