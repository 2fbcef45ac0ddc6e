// The daemon's log: lines for people.
#pragma once

#include <spdlog/common.h>

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace collision::server {

/// Whether standard error is the journal's, as JOURNAL_STREAM says. Source: systemd.exec(5).
bool ErrorsGoToTheJournal();

struct LogOptions {
  std::string level = "info";  ///< trace, debug, info, warn, error, critical or off.
  std::string file = {};       ///< Empty: standard error.
  bool json = false;           ///< A line is {"time": ..., "level": ..., "message": ...}.
};

/// Sends spdlog's default logger to standard error, or to the file (appending). The journal gets
/// priorities in place of a time and a level, which it has; before a line of JSON, too. Throws
/// spdlog::spdlog_ex if the file cannot be opened.
void StartLogging(const LogOptions& options);

/// Why the log could not be written within the last kLogFailureStands; empty: it could, or nothing
/// was to be written. Standard error is told, too. Any thread.
std::string LogFailure();

/// So long a line that was lost counts as a failure of the log.
inline constexpr std::chrono::minutes kLogFailureStands{1};

/// Writes "matter: text", at most once per kMatterPeriod and matter; lines in between are held back
/// and counted, and the next line says how many. A matter is a short constant phrase ("input
/// refused"), never built from input: no input can fill a disk. Any thread.
void Log(spdlog::level::level_enum level, std::string_view matter, std::string_view text);

/// The same for a matter of one simulator: what is said of one does not hold back what is said of
/// others. `subject`: the name of a simulator of the world. Any thread.
void LogAbout(spdlog::level::level_enum level, std::string_view matter, std::string_view subject,
              std::string_view text);

/// Writes the counts of lines that are still held back; call it before the program ends. Any
/// thread.
void EndLogging();

/// Matters of which one is written in a period; all further ones share one more.
inline constexpr std::size_t kMattersMax = 256;

/// Short enough to see a matter at once, long enough that no input can fill a disk.
inline constexpr std::chrono::seconds kMatterPeriod{1};

/// The rate limit behind Log(), for one thread and with its time as an argument.
class MatterLimiter {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Sink = std::function<void(spdlog::level::level_enum, const std::string& line)>;

  explicit MatterLimiter(Sink sink) : sink_(std::move(sink)) {}

  void Write(Time now, spdlog::level::level_enum level, std::string_view matter,
             std::string_view text, std::string_view subject = {});

  /// Writes every count of lines held back, whatever the time.
  void WriteAllCounts();

 private:
  struct Matter {
    Time written;
    std::uint64_t held_back = 0;
    spdlog::level::level_enum level = spdlog::level::info;
  };
  using Name = std::pair<std::string, std::string>;  ///< Matter, subject.

  Matter& Find(Time now, const Name& name);
  void ForgetIdle(Time now);
  void WriteOverdueCounts(Time now, const Name& besides);
  void WriteCount(const Name& name, Matter* matter);

  Sink sink_;
  std::map<Name, Matter> matters_;
};

}  // namespace collision::server
