// The daemon's log: lines for people.
#pragma once

#include <spdlog/common.h>

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace collision::server {

/// Sends spdlog's default logger to standard error, or to `file` (appending) if it is not empty.
/// `level`: trace, debug, info, warn, error, critical or off. Throws spdlog::spdlog_ex if the file
/// cannot be opened.
void StartLogging(const std::string& level, const std::string& file);

/// Writes "matter: text", at most once per kMatterPeriod and matter; what was held back is counted,
/// and the count told. A matter is a short constant phrase ("state refused"), never built from
/// input. Any thread.
void Log(spdlog::level::level_enum level, std::string_view matter, std::string_view text);

/// Tells what is still held back; call it before the program ends. Any thread.
void EndLogging();

/// Fast enough to see a matter at once, slow enough that no input can fill a disk.
inline constexpr std::chrono::seconds kMatterPeriod{1};

/// The rate limit behind Log(), for one thread and with its time as an argument.
class MatterLimiter {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Sink = std::function<void(spdlog::level::level_enum, const std::string& line)>;

  explicit MatterLimiter(Sink sink) : sink_(std::move(sink)) {}

  void Write(Time now, spdlog::level::level_enum level, std::string_view matter,
             std::string_view text);

  /// Tells every count that is held back, whatever the time.
  void TellAll();

 private:
  struct Matter {
    Time told;
    std::uint64_t held_back = 0;
    spdlog::level::level_enum level = spdlog::level::info;
  };
  Matter& Find(Time now, std::string_view matter);
  void TellOverdue(Time now, std::string_view besides);
  void Tell(const std::string& name, Matter* matter);

  Sink sink_;
  std::map<std::string, Matter, std::less<>> matters_;
};

}  // namespace collision::server
