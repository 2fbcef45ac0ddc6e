#include "tests/system/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {
#include <sys/pidfd.h>  // this header of glibc 2.36 forgets that there is C++
}

#include <algorithm>
#include <cerrno>
#include <system_error>

extern char** environ;

namespace collision::system_test {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void Throw(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// Both ends close in children; the reading end does not block.
void MakePipe(int ends[2]) {
  if (pipe2(ends, O_CLOEXEC) != 0) Throw(errno, "pipe2");
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
}

std::vector<std::string> Environment(const std::vector<std::string>& variables) {
  std::vector<std::string> environment = variables;
  for (char** inherited = environ; *inherited != nullptr; ++inherited) {
    const std::string variable = *inherited;
    const std::string name = variable.substr(0, variable.find('=') + 1);
    if (std::none_of(variables.begin(), variables.end(),
                     [&](const auto& v) { return v.rfind(name, 0) == 0; })) {
      environment.push_back(variable);
    }
  }
  return environment;
}

std::vector<char*> Pointers(const std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  for (const std::string& string : strings) pointers.push_back(const_cast<char*>(string.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// Starts the program in a process group of its own, so that whatever it starts can be ended with
/// it.
pid_t Spawn(const std::vector<std::string>& command, const std::vector<std::string>& variables,
            int out, int err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const std::vector<std::string> environment = Environment(variables);
  pid_t pid = -1;
  const int error = posix_spawnp(&pid, command.at(0).c_str(), &actions, &attributes,
                                 Pointers(command).data(), Pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) Throw(error, command[0]);
  return pid;
}

}  // namespace

Process::Process(const std::vector<std::string>& command,
                 const std::vector<std::string>& variables) {
  int out[2], err[2];
  MakePipe(out);
  MakePipe(err);
  out_.descriptor = out[0];
  err_.descriptor = err[0];
  pid_ = Spawn(command, variables, out[1], err[1]);
  close(out[1]);
  close(err[1]);
  pid_descriptor_ = pidfd_open(pid_, 0);
  if (pid_descriptor_ < 0) Throw(errno, "pidfd_open");
}

Process::~Process() {
  if (!status_) {
    Signal(SIGTERM);
    WaitForExit(std::chrono::seconds(5));
  }
  kill(-pid_, SIGKILL);
  if (!status_) waitpid(pid_, nullptr, 0);
  for (const int descriptor : {out_.descriptor, err_.descriptor, pid_descriptor_})
    close(descriptor);
}

void Process::Signal(int signal) {
  if (!status_) kill(pid_, signal);
}

bool Process::WaitUntil(const std::function<bool()>& condition, std::chrono::nanoseconds patience) {
  const auto deadline = Clock::now() + patience;
  while (!condition()) {
    if (status_) return false;
    // What there is is taken, also if this process was not run for so long.
    const std::chrono::nanoseconds left = deadline - Clock::now();
    Gather(std::max(left, std::chrono::nanoseconds(0)));
    if (left.count() <= 0) return condition();
  }
  return true;
}

bool Process::WaitForOutput(const std::string& text, std::chrono::nanoseconds patience) {
  const auto has = [&](const Stream& stream) {
    return stream.text.find(text) != std::string::npos;
  };
  return WaitUntil([&] { return has(out_) || has(err_); }, patience);
}

std::optional<int> Process::WaitForExit(std::chrono::nanoseconds patience) {
  WaitUntil([&] { return status_.has_value(); }, patience);
  return status_;
}

/// Waits for output or for the program's end, and takes what there is.
void Process::Gather(std::chrono::nanoseconds timeout) {
  // A negative descriptor is passed over.
  pollfd descriptors[] = {
      {out_.descriptor, POLLIN, 0}, {err_.descriptor, POLLIN, 0}, {pid_descriptor_, POLLIN, 0}};
  const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
  poll(descriptors, 3, static_cast<int>(milliseconds));
  Read(&out_);
  Read(&err_);
  int status = 0;
  if (descriptors[2].revents == 0 || waitpid(pid_, &status, WNOHANG) != pid_) return;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  // What it wrote between the reading above and its end.
  Read(&out_);
  Read(&err_);
}

void Process::Read(Stream* stream) {
  char buffer[65536];
  while (stream->descriptor >= 0) {
    const ssize_t count = read(stream->descriptor, buffer, sizeof buffer);
    if (count > 0) {
      stream->text.append(buffer, static_cast<std::size_t>(count));
    } else if (count < 0 && errno == EINTR) {
      continue;
    } else if (count < 0 && errno == EAGAIN) {
      return;
    } else {
      // The end: poll() would report it again and again.
      close(stream->descriptor);
      stream->descriptor = -1;
    }
  }
}

Outcome RunToEnd(const std::vector<std::string>& command,
                 const std::vector<std::string>& variables) {
  Process process(command, variables);
  const auto status = process.WaitForExit();
  return {status, process.out(), process.err()};
}

}  // namespace collision::system_test
