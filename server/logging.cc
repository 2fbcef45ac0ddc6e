#include "server/logging.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <mutex>

namespace collision::server {
namespace {

/// Matters are constants of the program, some dozens. Whatever comes beyond shares one limit, so
/// that a matter wrongly built from input can grow nothing.
constexpr std::size_t kMattersMax = 256;
constexpr std::string_view kOther = "other matters";

/// The process has one log, as it has one default logger.
struct ProcessLog {
  std::mutex mutex;
  MatterLimiter limiter{[](spdlog::level::level_enum level, const std::string& line) {
    spdlog::default_logger_raw()->log(level, line);
  }};
};

ProcessLog& TheLog() {
  static ProcessLog log;
  return log;
}

}  // namespace

void StartLogging(const std::string& level, const std::string& file) {
  auto logger = file.empty() ? std::make_shared<spdlog::logger>(
                                   "", std::make_shared<spdlog::sinks::stderr_color_sink_mt>())
                             : std::make_shared<spdlog::logger>(
                                   "", std::make_shared<spdlog::sinks::basic_file_sink_mt>(file));
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::trace);
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%f%z %^%l%$ %v");
  spdlog::set_default_logger(std::move(logger));
}

void Log(spdlog::level::level_enum level, std::string_view matter, std::string_view text) {
  if (!spdlog::default_logger_raw()->should_log(level)) return;
  ProcessLog& log = TheLog();
  const std::lock_guard lock(log.mutex);
  log.limiter.Write(std::chrono::steady_clock::now(), level, matter, text);
}

void EndLogging() {
  ProcessLog& log = TheLog();
  const std::lock_guard lock(log.mutex);
  log.limiter.TellAll();
}

void MatterLimiter::Write(Time now, spdlog::level::level_enum level, std::string_view matter,
                          std::string_view text) {
  TellOverdue(now, matter);
  Matter& known = Find(now, matter);
  if (now - known.told < kMatterPeriod) {
    ++known.held_back;
    known.level = level;
    return;
  }
  std::string line = std::string(matter) + ": " + std::string(text);
  if (known.held_back > 0) line += " (after " + std::to_string(known.held_back) + " held back)";
  known = {.told = now};
  sink_(level, line);
}

MatterLimiter::Matter& MatterLimiter::Find(Time now, std::string_view matter) {
  const bool full = matters_.size() >= kMattersMax && !matters_.contains(matter);
  const std::string name(full ? kOther : matter);
  return matters_.try_emplace(name, Matter{.told = now - kMatterPeriod}).first->second;
}

void MatterLimiter::TellOverdue(Time now, std::string_view besides) {
  for (auto& [name, matter] : matters_) {
    if (name == besides || matter.held_back == 0 || now - matter.told < kMatterPeriod) continue;
    Tell(name, &matter);
    matter.told = now;
  }
}

void MatterLimiter::TellAll() {
  for (auto& [name, matter] : matters_) Tell(name, &matter);
}

void MatterLimiter::Tell(const std::string& name, Matter* matter) {
  if (matter->held_back == 0) return;
  sink_(matter->level, name + ": " + std::to_string(matter->held_back) + " held back");
  matter->held_back = 0;
}

}  // namespace collision::server
