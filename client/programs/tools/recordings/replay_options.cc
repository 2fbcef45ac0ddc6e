#include "client/programs/tools/recordings/replay_options.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <system_error>
#include <utility>

#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/tools/collisionctl/kept/kept_options.h"

namespace collision::client {
namespace {

std::optional<std::int64_t> TimeOf(const char* option, const std::string& word) {
  if (word.empty()) return std::nullopt;
  const std::int64_t now_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
                                  std::chrono::system_clock::now().time_since_epoch())
                                  .count();
  const auto time = WallTimeOf(word, now_ns);
  if (!time) {
    throw BadInput(std::string(option) + " \"" + word +
                   "\"; allowed: YESTERDAY, TODAY, a number of seconds before now, or a time (UTC) "
                   "such as 2026-11-28T03:00");
  }
  return time;
}

}  // namespace

void AddReplayOptions(CLI::App* command, std::string* file, std::string* from, std::string* until) {
  command
      ->add_option("FILE", *file,
                   "What collisiond --record wrote, a segment of the flight recorder, or a folder "
                   "of them")
      ->required();
  command->add_option("--from", *from, "Of a folder: begin with the segment of this time (UTC)");
  command->add_option("--until", *until, "Up to this time (UTC)");
}

void AddRateOption(CLI::App* command, const std::string& what, double* rate_hz) {
  constexpr double kRateMin = 0.1, kRateMax = 100;
  command->add_option("--rate", *rate_hz, what + ", a second of the world, 0.1 to 100")
      ->check(Between(kRateMin, kRateMax))
      ->capture_default_str();
}

int FailWith(const std::string& what, int code) {
  std::cerr << "collisionctl: " << what << '\n';
  return code;
}

ReplayRequest ReplayOf(const std::string& file, const std::string& from, const std::string& until) {
  return {.file = file, .from_ns = TimeOf("--from", from), .until_ns = TimeOf("--until", until)};
}

void CheckOutput(const std::string& output, const std::string& recording) {
  std::error_code none;  // where one of them does not exist
  if (std::filesystem::equivalent(output, recording, none)) {
    throw BadInput(output + ": is the recording itself; name another file");
  }
}

Progress::Progress(std::string what)
    : what_(std::move(what)), is_shown_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (has_told_) std::fputc('\n', stderr);
}

void Progress::Tell(std::int64_t world_ns) {
  const auto now = std::chrono::steady_clock::now();
  if (!is_shown_ || now < due_) return;
  due_ = now + std::chrono::seconds(1);
  has_told_ = true;
  std::fprintf(stderr, "\r%s: the world's time is %.1f s ", what_.c_str(),
               1e-9 * static_cast<double>(world_ns));
}

}  // namespace collision::client
