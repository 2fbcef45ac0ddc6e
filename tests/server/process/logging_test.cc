#include "server/process/logging.h"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_path.h"

namespace collision::server {
namespace {

using Lines = std::vector<std::string>;
constexpr auto kInfo = spdlog::level::info;

MatterLimiter::Time At(double seconds) {
  return MatterLimiter::Time(std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9)));
}

struct Recorded {
  Lines lines;
  MatterLimiter limiter{
      [this](spdlog::level::level_enum, const std::string& line) { lines.push_back(line); }};
};

// Goal:   one line per matter and period; no line vanishes silently, and matters do not disturb
// each other.
TEST(MatterLimiter, TellsHowManyLinesItHeldBack) {
  Recorded log;
  for (int i = 0; i < 10; ++i) log.limiter.Write(At(0.1 * i), kInfo, "refused", std::to_string(i));
  log.limiter.Write(At(0.95), kInfo, "late", "x");
  EXPECT_EQ(log.lines, (Lines{"refused: 0", "late: x"}));
  log.limiter.Write(At(1), kInfo, "refused", "10");
  EXPECT_EQ(log.lines.back(), "refused: 10 (lines suppressed before: 9)");
  log.limiter.Write(At(2), kInfo, "refused", "11");
  EXPECT_EQ(log.lines.back(), "refused: 11");
}

// Goal:   the count of an ended matter is logged too: with the next line of any other, or at
// the end.
TEST(MatterLimiter, TellsTheLastCount) {
  Recorded log;
  for (int i = 0; i < 3; ++i) log.limiter.Write(At(0), kInfo, "refused", "a");
  log.limiter.Write(At(5), kInfo, "late", "b");
  EXPECT_EQ(log.lines, (Lines{"refused: a", "refused: lines suppressed: 2", "late: b"}));
  log.limiter.Write(At(5.5), kInfo, "refused", "c");
  EXPECT_EQ(log.lines.size(), 3u) << "a logged count is a line of the matter";
  log.limiter.WriteAllCounts();
  log.limiter.WriteAllCounts();
  EXPECT_EQ(log.lines.back(), "refused: lines suppressed: 1");
  EXPECT_EQ(log.lines.size(), 4u);
}

// Goal:   what is refused of one simulator does not hide what is refused of another; simulators
//         that come and go take no place for good.
TEST(MatterLimiter, SubjectsDoNotDisturbEachOther) {
  Recorded log;
  for (int i = 0; i < 3; ++i) log.limiter.Write(At(0), kInfo, "refused", "a", "alpha");
  log.limiter.Write(At(0), kInfo, "refused", "b", "beta");
  EXPECT_EQ(log.lines, (Lines{"refused: a", "refused: b"}));
  log.limiter.WriteAllCounts();
  EXPECT_EQ(log.lines.back(), "refused (alpha): lines suppressed: 2");
  for (int i = 0; i < 1000; ++i) {
    log.limiter.Write(At(1 + 0.01 * i), kInfo, "refused", "x", std::to_string(i));
  }
  EXPECT_EQ(log.lines.size(), 1003u);
}

// Goal:   matters built from input by mistake cannot flood the log or grow memory without bound.
// Method: 1,000 matters at once: 256 are known, the rest share one limit.
TEST(MatterLimiter, BoundsTheNumberOfMatters) {
  Recorded log;
  for (int i = 0; i < 1000; ++i) log.limiter.Write(At(0), kInfo, std::to_string(i), "x");
  EXPECT_EQ(log.lines.size(), 257u);
  log.limiter.WriteAllCounts();
  EXPECT_EQ(log.lines.back(), "other matters: lines suppressed: 743");
}

// Goal:   the process's log goes to the file, from the level on, and keeps what was there.
TEST(Logging, WritesToTheFileFromTheLevelOn) {
  const std::string path = TemporaryPath("logging_test.log");
  std::ofstream(path) << "before\n";
  StartLogging({.level = "warn", .file = path});
  Log(spdlog::level::info, "chatter", "unheard");
  for (int i = 0; i < 3; ++i) Log(spdlog::level::warn, "refused", "NaN");
  EndLogging();
  StartLogging({.level = "info"});
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_TRUE(text.str().starts_with("before\n"));
  EXPECT_NE(text.str().find(" warning refused: NaN\n"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("suppressed"), std::string::npos);
  EXPECT_EQ(text.str().find("unheard"), std::string::npos);
  std::remove(path.c_str());
  EXPECT_THROW(StartLogging({.level = "info", .file = "/dev/null/log"}), spdlog::spdlog_ex);
}

// Goal:   a program reads each line of the log as JSON, whatever its text holds.
// Goal:   lines that are lost are told elsewhere.
TEST(Logging, WhatCannotBeWrittenIsAFailure) {
  StartLogging({.level = "warn", .file = "/dev/full"});
  EXPECT_EQ(LogFailure(), "");
  Log(spdlog::level::warn, "lost", "NaN");
  EXPECT_NE(LogFailure().find("/dev/full: cannot be written: No space left on device"),
            std::string::npos)
      << LogFailure();
  StartLogging({.level = "info"});
  EXPECT_EQ(LogFailure(), "") << "a reload has named another file";
}

TEST(Logging, WritesJson) {
  const std::string path = TemporaryPath("logging_test.json");
  std::remove(path.c_str());
  StartLogging({.file = path, .json = true});
  spdlog::warn("a \"quoted\" \\ text\nof two lines, \u00e9");
  StartLogging({});
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  const std::string line = text.str();
  EXPECT_TRUE(line.starts_with("{\"time\": \"2")) << line;
  EXPECT_TRUE(
      line.ends_with("Z\", \"level\": \"warning\", \"message\": \"a \\\"quoted\\\" "
                     "\\\\ text\\u000aof two lines, \u00e9\"}\n"))
      << line;
  std::remove(path.c_str());
}

// Goal:   the journal gets priorities, and no times, which it has.
// Method: standard error is a file, and JOURNAL_STREAM names it; then another one.
TEST(Logging, WritesPrioritiesToTheJournal) {
  const std::string path = TemporaryPath("logging_test.journal");
  const int before = dup(STDERR_FILENO);
  ASSERT_NE(std::freopen(path.c_str(), "w", stderr), nullptr);
  struct stat errors {};
  fstat(STDERR_FILENO, &errors);
  const std::string stream = fmt::format("{}:{}", errors.st_dev, errors.st_ino);
  setenv("JOURNAL_STREAM", stream.c_str(), 1);
  StartLogging({.level = "debug"});
  spdlog::debug("of no concern");
  spdlog::error("it fails");
  setenv("JOURNAL_STREAM", "0:0", 1);
  StartLogging({.level = "info"});
  spdlog::info("not the journal");
  unsetenv("JOURNAL_STREAM");
  std::fflush(stderr);
  dup2(before, STDERR_FILENO);
  close(before);
  StartLogging({.level = "info"});
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_TRUE(text.str().starts_with("<7>of no concern\n<3>it fails\n2")) << text.str();
  EXPECT_TRUE(text.str().ends_with("info not the journal\n")) << text.str();
  std::remove(path.c_str());
}

}  // namespace
}  // namespace collision::server
