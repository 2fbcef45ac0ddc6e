// `collisionctl top`: the nearest pairs, again and again.
#pragma once

#include <chrono>
#include <functional>

#include "client/library/network/message_monitor.h"
#include "client/programs/shared/world_view.h"

namespace collision::client {

struct TopOptions {
  std::size_t rows = 20;
  std::chrono::nanoseconds period{1'000'000'000};
  bool once = false;
  bool json = false;
};

/// Shows them on standard output until `is_stopped` or, on a terminal, until q: there as a picture
/// that is drawn anew, elsewhere, as JSON and once as text behind what is there. The view has a
/// status.
void RunTop(const TopOptions& options, MessageMonitor* monitor, WorldView* view,
            const std::function<bool()>& is_stopped);

}  // namespace collision::client
