// One program, run as a user would run it, from a test.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace collision::system_test {

/// Longer than anything takes on a busy machine under a sanitizer: a test that waits so long has
/// failed.
inline constexpr std::chrono::seconds kPatience{240};

/// A running program. Its output is gathered while a caller waits; its process group is killed, by
/// its id, at the latest in the destructor. Used from one thread.
class Process {
 public:
  /// Starts command[0] (looked up in PATH) with the environment of the test and `variables`
  /// ("NAME=value") on top. Throws std::system_error if it cannot be started.
  explicit Process(const std::vector<std::string>& command,
                   const std::vector<std::string>& variables = {});
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  void Signal(int signal);

  /// Waits until `condition` holds, which is asked after each piece of output, or the program
  /// ended, or `patience` is over. Returns whether it holds.
  bool WaitUntil(const std::function<bool()>& condition,
                 std::chrono::nanoseconds patience = kPatience);

  /// Waits until `text` stands in what the program wrote to stdout or stderr.
  bool WaitForOutput(const std::string& text, std::chrono::nanoseconds patience = kPatience);

  /// The program's exit status, 128 + signal if one killed it; nothing if it still runs after
  /// `patience`.
  std::optional<int> WaitForExit(std::chrono::nanoseconds patience = kPatience);

  pid_t pid() const { return pid_; }
  const std::string& out() const { return out_.text; }
  const std::string& err() const { return err_.text; }

 private:
  struct Stream {
    int descriptor = -1;
    std::string text;
  };

  void Gather(std::chrono::nanoseconds timeout);
  static void Read(Stream* stream);

  pid_t pid_ = -1;
  int pid_descriptor_ = -1;
  Stream out_;
  Stream err_;
  std::optional<int> status_;
};

/// What a program that ended by itself left behind.
struct Outcome {
  std::optional<int> status;
  std::string out;
  std::string err;
};

/// Runs a program to its end.
Outcome RunToEnd(const std::vector<std::string>& command,
                 const std::vector<std::string>& variables = {});

}  // namespace collision::system_test
