// A child process, ended by its id.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace collision::client {

/// Where the standard streams of a child lead.
enum class Streams {
  kFile,     ///< All output goes to a file; there is no input.
  kTerminal  ///< Input and output are this program's own; errors go to the file.
};

/// Between SIGTERM and SIGKILL.
inline constexpr std::chrono::seconds kGrace{15};

/// The destructor ends the child: SIGTERM, and SIGKILL after kGrace. The child also gets SIGTERM if
/// this program dies. It has a process group of its own, so that Ctrl-C reaches only this program,
/// which then ends it in order; a child with the terminal stays in this group, or it could not
/// read.
class ChildProcess {
 public:
  /// Throws std::runtime_error if the program cannot be started.
  ChildProcess(std::string name, const std::vector<std::string>& arguments,
               const std::string& output_path, Streams streams = Streams::kFile);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  const std::string& name() const { return name_; }

  bool Running();

  /// Sends SIGTERM; returns at once.
  void Terminate();

  /// Waits until the child has ended; kills it at `deadline`.
  void Finish(std::chrono::steady_clock::time_point deadline);

  /// How the child ended: "exit code 1", "signal Aborted".
  std::string Ending() const;
  bool succeeded() const;

  /// Processor time of the ended program, user and system [s].
  double cpu_seconds() const { return cpu_seconds_; }

  /// The last lines of its output, each indented.
  std::string LastLines(std::size_t count) const;

 private:
  bool Reap(int options);

  std::string name_;
  std::string output_path_;
  pid_t pid_ = -1;
  std::optional<int> status_;  // as wait() gives it
  double cpu_seconds_ = 0;
};

}  // namespace collision::client
