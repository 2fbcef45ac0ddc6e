// One run of a scene under one condition.
#pragma once

#include <cstdint>
#include <string>

#include "tests/repeat/condition.h"

namespace collision::repeat {

/// Where a flight finds what it needs.
struct Places {
  std::string bin;     ///< Programs.
  std::string config;  ///< Network profiles, and scenes in the folder of that name.
  std::string data;    ///< Real data sets; may be empty.
  std::string logs;    ///< What flights leave behind.
};

struct FlightPlan {
  std::string scene;
  double seconds = 0;  ///< Simulated.
  double speed = 0;    ///< At most so many simulated seconds a second; 0: no limit.
  Condition condition;
  std::uint64_t seed = 1;  ///< Of stops, delays and losses.
  bool judged = true;      ///< By the checker, which may take longer than the flight.
};

struct Flight {
  bool ended = false;      ///< The scene ran to its end.
  bool satisfied = false;  ///< And its programs did not fail, nor the checker object, if asked.
  std::string event_log;   ///< Number and hash of the events, as collisiond logs them.
  double wall_s = 0;
  int stops = 0;     ///< How often a process was stopped.
  std::string said;  ///< The last lines of a flight that is not satisfied.
};

/// Flies. `folder` is emptied first and then holds the configuration, all logs and the report. Ends
/// early when the program is asked to stop. Throws std::runtime_error if a network cannot be made.
Flight Fly(const FlightPlan& plan, const Places& places, const std::string& folder);

}  // namespace collision::repeat
