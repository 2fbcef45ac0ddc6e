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

/// "SCENE of N s: what is wrong", of each scene and length that has flights with different event
/// logs, or flights that did not satisfy the checker or whose service told no event log. A scene
/// without a single event proves nothing, so it is named, too.
std::vector<std::string> Faults(const std::vector<Row>& rows);

std::string Json(const std::vector<Row>& rows);

}  // namespace collision::repeat
