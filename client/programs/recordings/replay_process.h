// A child process whose output is read.
#pragma once

#include <sys/types.h>

#include <mutex>
#include <string>
#include <vector>

namespace collision::client {

/// Has nothing of this process but its standard error, ends with it at the latest when it next
/// writes, and is killed by the destructor. One thread, except for Kill().
class ReplayProcess {
 public:
  /// `words`: the program's path, then its arguments. `niceness`: added to that of this process.
  /// Throws std::runtime_error if it cannot be started.
  explicit ReplayProcess(const std::vector<std::string>& words, int niceness);
  ~ReplayProcess();
  ReplayProcess(const ReplayProcess&) = delete;
  ReplayProcess& operator=(const ReplayProcess&) = delete;

  /// A path under which its standard output can be read, once.
  std::string output_path() const { return "/dev/fd/" + std::to_string(output_); }

  /// Ends it at once: its output is over. Any thread.
  void Kill();

  /// Reads no more, and waits for its end: where it has more to say, that fails. Requires that what
  /// has opened output_path() is closed. Returns its exit code, or 1 if a signal has ended it; the
  /// first one again if it is called again.
  int Wait();

 private:
  int output_ = -1;
  std::mutex mutex_;
  pid_t pid_ = -1;  ///< Guarded by it; -1: it has ended and is known to have.
  int code_ = 0;
};

}  // namespace collision::client
