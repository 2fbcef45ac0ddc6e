// How tests read what the daemon says of its event log.
#pragma once

#include <string>

namespace collision::system_test {

/// The line of collisiond's log that sums up the events, from "event log:" to its end; empty if
/// there is none. Two runs had the same events if their lines are equal.
inline std::string EventLogLine(const std::string& log) {
  const auto begin = log.rfind("event log:");
  return begin == std::string::npos ? "" : log.substr(begin, log.find('\n', begin) - begin);
}

}  // namespace collision::system_test
