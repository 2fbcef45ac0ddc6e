#include "client/programs/scene_runner/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace collision::client {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kReapPeriod{5};
constexpr int kCannotExecute = 127;

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// In the child: only calls that are safe after fork().
[[noreturn]] void Execute(char* const* argv, int output, pid_t parent, Streams streams) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kCannotExecute);
  if (streams == Streams::kFile) {
    setpgid(0, 0);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (nothing >= 0) dup2(nothing, STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
  }
  dup2(output, STDERR_FILENO);
  execv(argv[0], argv);
  const char* error = std::strerror(errno);
  const char* parts[] = {argv[0], ": ", error, "\n"};
  for (const char* part : parts) {
    if (write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
  }
  _exit(kCannotExecute);
}

}  // namespace

ChildProcess::ChildProcess(std::string name, const std::vector<std::string>& arguments,
                           const std::string& output_path, Streams streams)
    : name_(std::move(name)), output_path_(output_path) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const int output = open(output_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (output < 0) throw std::runtime_error(output_path + ": " + std::strerror(errno));
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) Execute(argv.data(), output, parent, streams);
  close(output);
  if (pid_ < 0) throw std::runtime_error(name_ + ": cannot be started: " + std::strerror(errno));
}

ChildProcess::~ChildProcess() {
  if (!Running()) return;
  Terminate();
  Finish(steady_clock::now() + kGrace);
}

bool ChildProcess::Reap(int options) {
  if (status_) return true;
  int status = 0;
  rusage usage{};
  if (wait4(pid_, &status, options, &usage) != pid_) return false;
  status_ = status;
  cpu_seconds_ = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  return true;
}

bool ChildProcess::Running() { return !Reap(WNOHANG); }

void ChildProcess::Terminate() {
  if (Running()) kill(pid_, SIGTERM);
}

void ChildProcess::Finish(steady_clock::time_point deadline) {
  while (Running() && steady_clock::now() < deadline) std::this_thread::sleep_for(kReapPeriod);
  if (!Running()) return;
  kill(pid_, SIGKILL);
  Reap(0);
}

bool ChildProcess::succeeded() const {
  return status_ && WIFEXITED(*status_) && WEXITSTATUS(*status_) == 0;
}

std::string ChildProcess::Ending() const {
  if (!status_) return "still running";
  if (WIFSIGNALED(*status_)) return std::string("signal ") + strsignal(WTERMSIG(*status_));
  return "exit code " + std::to_string(WEXITSTATUS(*status_));
}

std::string ChildProcess::LastLines(std::size_t count) const {
  std::ifstream file(output_path_);
  std::deque<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line);
    if (lines.size() > count) lines.pop_front();
  }
  std::string text;
  for (const std::string& line : lines) text += "    " + line + "\n";
  return text;
}

}  // namespace collision::client
