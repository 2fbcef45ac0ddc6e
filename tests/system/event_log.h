// How tests read what the daemon says of its event log.
#pragma once

#include <string>

namespace collision::system_test {

/// The last line with this text, from there to its end; empty if there is none.
inline std::string LogLine(const std::string& text, const std::string& log) {
  const auto begin = log.rfind(text);
  return begin == std::string::npos ? "" : log.substr(begin, log.find('\n', begin) - begin);
}

/// The line of collisiond's log that sums up the events. Two runs had the same events if their
/// lines are equal.
inline std::string EventLogLine(const std::string& log) { return LogLine("event log:", log); }

}  // namespace collision::system_test
