// Whether flights had the same events.
#pragma once

#include <string>
#include <vector>

#include "tests/repeat/flight.h"
#include "tests/repeat/scene_choice.h"

namespace collision::repeat {

struct Row {
  Series series;
  std::vector<Flight> flights;
};

/// One line of the table; its head.
std::string TableHead();
std::string TableLine(const Row& row);

/// "SCENE: what is wrong", of each scene that has flights with different event logs, or flights
/// that did not run to their end or whose service told no event log. A scene without a single event
/// proves nothing, nor do starved flights in which nothing was stopped: they are named, too. A
/// checker that is not satisfied is no fault here: it judges by what its monitor has heard, and a
/// monitor that gets no processor misses forecasts.
std::vector<std::string> Faults(const std::vector<Row>& rows);

std::string Json(const std::vector<Row>& rows);

}  // namespace collision::repeat
