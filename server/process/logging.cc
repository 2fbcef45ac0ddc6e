#include "server/process/logging.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <iterator>
#include <mutex>

namespace collision::server {
namespace {

constexpr const char* kOther = "other matters";

/// The priority of syslog that fits a level, in the form that the journal takes: "<6>".
class JournalPriority final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& line, const std::tm&,
              spdlog::memory_buf_t& text) override {
    constexpr std::string_view kPriorities[] = {"<7>", "<7>", "<6>", "<4>", "<3>", "<2>", "<2>"};
    const std::string_view priority = kPriorities[line.level];
    text.append(priority.data(), priority.data() + priority.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<JournalPriority>();
  }
};

/// The text of a line as a string of JSON. Source: RFC 8259, section 7.
class JsonText final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& line, const std::tm&,
              spdlog::memory_buf_t& text) override {
    text.push_back('"');
    for (const char c : line.payload) {
      if (c == '"' || c == '\\') text.push_back('\\');
      if (static_cast<unsigned char>(c) < 0x20) {
        fmt::format_to(std::back_inserter(text), "\\u{:04x}", static_cast<int>(c));
      } else {
        text.push_back(c);
      }
    }
    text.push_back('"');
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<JsonText>();
  }
};

std::unique_ptr<spdlog::pattern_formatter> FormatFor(bool journal, bool json) {
  const auto time = json ? spdlog::pattern_time_type::utc : spdlog::pattern_time_type::local;
  auto format = std::make_unique<spdlog::pattern_formatter>(time);
  format->add_flag<JournalPriority>('P').add_flag<JsonText>('J');
  if (json) {
    format->set_pattern(std::string(journal ? "%P" : "") +
                        R"({"time": "%Y-%m-%dT%H:%M:%S.%fZ", "level": "%l", "message": %J})");
  } else {
    format->set_pattern(journal ? "%P%v" : "%Y-%m-%dT%H:%M:%S.%f%z %^%l%$ %v");
  }
  return format;
}

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

bool ErrorsGoToTheJournal() {
  const char* stream = std::getenv("JOURNAL_STREAM");
  struct stat errors {};
  if (stream == nullptr || fstat(STDERR_FILENO, &errors) != 0) return false;
  return stream == fmt::format("{}:{}", errors.st_dev, errors.st_ino);
}

void StartLogging(const LogOptions& options) {
  const std::string& file = options.file;
  auto logger = file.empty() ? std::make_shared<spdlog::logger>(
                                   "", std::make_shared<spdlog::sinks::stderr_color_sink_mt>())
                             : std::make_shared<spdlog::logger>(
                                   "", std::make_shared<spdlog::sinks::basic_file_sink_mt>(file));
  logger->set_level(spdlog::level::from_str(options.level));
  logger->flush_on(spdlog::level::trace);
  logger->set_formatter(FormatFor(file.empty() && ErrorsGoToTheJournal(), options.json));
  spdlog::set_default_logger(std::move(logger));
}

void Log(spdlog::level::level_enum level, std::string_view matter, std::string_view text) {
  LogAbout(level, matter, {}, text);
}

void LogAbout(spdlog::level::level_enum level, std::string_view matter, std::string_view subject,
              std::string_view text) {
  if (!spdlog::default_logger_raw()->should_log(level)) return;
  ProcessLog& log = TheLog();
  const std::lock_guard lock(log.mutex);
  log.limiter.Write(std::chrono::steady_clock::now(), level, matter, text, subject);
}

void EndLogging() {
  ProcessLog& log = TheLog();
  const std::lock_guard lock(log.mutex);
  log.limiter.WriteAllCounts();
}

void MatterLimiter::Write(Time now, spdlog::level::level_enum level, std::string_view matter,
                          std::string_view text, std::string_view subject) {
  const Name name(matter, subject);
  WriteOverdueCounts(now, name);
  Matter& known = Find(now, name);
  if (now - known.written < kMatterPeriod) {
    ++known.held_back;
    known.level = level;
    return;
  }
  std::string line = std::string(matter) + ": " + std::string(text);
  if (known.held_back > 0)
    line += " (lines suppressed before: " + std::to_string(known.held_back) + ")";
  known = {.written = now};
  sink_(level, line);
}

MatterLimiter::Matter& MatterLimiter::Find(Time now, const Name& name) {
  const Matter unwritten{.written = now - kMatterPeriod};
  if (matters_.size() < kMattersMax || matters_.contains(name)) {
    return matters_.try_emplace(name, unwritten).first->second;
  }
  ForgetIdle(now);
  const bool full = matters_.size() >= kMattersMax;
  return matters_.try_emplace(full ? Name(kOther, {}) : name, unwritten).first->second;
}

/// Simulators come and go: what holds no line back and could write one at once says nothing more.
void MatterLimiter::ForgetIdle(Time now) {
  std::erase_if(matters_, [now](const auto& matter) {
    return matter.second.held_back == 0 && now - matter.second.written >= kMatterPeriod;
  });
}

void MatterLimiter::WriteOverdueCounts(Time now, const Name& besides) {
  for (auto& [name, matter] : matters_) {
    if (name == besides || matter.held_back == 0 || now - matter.written < kMatterPeriod) continue;
    WriteCount(name, &matter);
    matter.written = now;
  }
}

void MatterLimiter::WriteAllCounts() {
  for (auto& [name, matter] : matters_) WriteCount(name, &matter);
}

void MatterLimiter::WriteCount(const Name& name, Matter* matter) {
  if (matter->held_back == 0) return;
  const std::string about = name.second.empty() ? "" : " (" + name.second + ")";
  sink_(matter->level,
        name.first + about + ": lines suppressed: " + std::to_string(matter->held_back));
  matter->held_back = 0;
}

}  // namespace collision::server
