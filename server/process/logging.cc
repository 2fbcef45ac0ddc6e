#include "server/process/logging.h"

#include <fcntl.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/dist_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <mutex>

#include "server/process/write_all.h"

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

/// What last failed of the log.
class FailedLines {
 public:
  void Note(const std::string& failure) {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (failure_.empty() || now - noted_ > kLogFailureStands)
      std::fprintf(stderr, "collisiond: log_file: %s\n", failure.c_str());
    failure_ = failure;
    noted_ = now;
  }

  std::string Get() {
    const std::lock_guard lock(mutex_);
    if (std::chrono::steady_clock::now() - noted_ > kLogFailureStands) failure_.clear();
    return failure_;
  }

  void Clear() {
    const std::lock_guard lock(mutex_);
    failure_.clear();
  }

 private:
  std::mutex mutex_;
  std::string failure_;
  std::chrono::steady_clock::time_point noted_;
};

FailedLines& TheFailedLines() {
  static FailedLines lines;
  return lines;
}

/// A file, appending. That of spdlog 1.10 does not notice a full disk.
class FileSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit FileSink(const std::string& path)
      : path_(path), file_(open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
    if (file_ < 0) throw spdlog::spdlog_ex(path + ": cannot be opened", errno);
  }
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;
  ~FileSink() override { close(file_); }

 private:
  void sink_it_(const spdlog::details::log_msg& line) override {
    spdlog::memory_buf_t text;
    formatter_->format(line, text);
    const int failed = WriteAll(file_, {text.data(), text.size()});
    if (failed != 0) TheFailedLines().Note(path_ + ": cannot be written: " + CauseOf(failed));
  }
  void flush_() override {}

  const std::string path_;
  const int file_;
};

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
  spdlog::sink_ptr sink;
  if (file.empty()) {
    sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  } else {
    sink = std::make_shared<FileSink>(file);
  }
  sink->set_formatter(FormatFor(file.empty() && ErrorsGoToTheJournal(), options.json));
  TheFailedLines().Clear();
  // Other threads may write a line meanwhile: the logger stays, its sink changes.
  static const auto sinks = std::make_shared<spdlog::sinks::dist_sink_mt>();
  static const auto logger = std::make_shared<spdlog::logger>("", sinks);
  sinks->set_sinks({std::move(sink)});
  logger->flush_on(spdlog::level::trace);
  logger->set_level(spdlog::level::from_str(options.level));
  if (spdlog::default_logger_raw() != logger.get()) spdlog::set_default_logger(logger);
}

std::string LogFailure() { return TheFailedLines().Get(); }

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
