// Which part of a recording a command takes.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <string>

#include "client/programs/recordings/replayed_world.h"

namespace collision::client {

/// FILE, --from and --until.
void AddReplayOptions(CLI::App* command, std::string* file, std::string* from, std::string* until);

/// --rate, with what it is about.
void AddRateOption(CLI::App* command, const std::string& what, double* rate_hz);

/// Says what is wrong on standard error, and returns the code.
int FailWith(const std::string& what, int code);

/// Throws BadInput for what is no time.
ReplayRequest ReplayOf(const std::string& file, const std::string& from, const std::string& until);

/// Throws BadInput if the output would take the place of the recording.
void CheckOutput(const std::string& output, const std::string& recording);

/// One line on standard error, at most once a second, if that is a terminal: how far it is.
class Progress {
 public:
  explicit Progress(std::string what);
  /// Ends the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Tell(std::int64_t world_ns);

 private:
  const std::string what_;
  const bool is_shown_;
  bool has_told_ = false;
  std::chrono::steady_clock::time_point due_{};
};

}  // namespace collision::client
