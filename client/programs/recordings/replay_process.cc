#include "client/programs/recordings/replay_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace collision::client {
namespace {

std::runtime_error CannotStart(const std::string& program, int error) {
  return std::runtime_error(program +
                            " cannot be started: " + std::generic_category().message(error));
}

/// Of the child: nothing to read, its output to a pipe, no other file.
class FileActions {
 public:
  explicit FileActions(int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

}  // namespace

ReplayProcess::ReplayProcess(const std::vector<std::string>& words, int niceness) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw CannotStart(words.front(), errno);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const int error =
      posix_spawn(&pid_, argv[0], FileActions(ends[1]).get(), nullptr, argv.data(), environ);
  close(ends[1]);
  output_ = ends[0];
  if (error != 0) {
    close(output_);
    throw CannotStart(words.front(), error);
  }
  if (niceness > 0) {
    setpriority(PRIO_PROCESS, static_cast<id_t>(pid_), getpriority(PRIO_PROCESS, 0) + niceness);
  }
}

ReplayProcess::~ReplayProcess() {
  Kill();
  Wait();
}

void ReplayProcess::Kill() {
  const std::lock_guard lock(mutex_);
  if (pid_ > 0) kill(pid_, SIGKILL);
}

int ReplayProcess::Wait() {
  if (pid_ < 0) return code_;
  close(output_);
  // Its id stays its own until it is reaped, which happens within the lock.
  siginfo_t ended{};
  while (waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  const std::lock_guard lock(mutex_);
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
  return code_;
}

}  // namespace collision::client
