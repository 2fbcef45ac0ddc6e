#include "tests/bench/harness/measure.h"

#include <malloc.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>

namespace collision::bench {
namespace {

constexpr int kLookEveryMs = 20;
/// On a machine that others use too, a child gets this much longer by the clock on the wall.
constexpr double kWallOverCpuMax = 4;

double Now(clockid_t clock) {
  timespec now{};
  if (clock_gettime(clock, &now) != 0) return 0;
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The processor's time that a child has used [s].
double CpuOf(pid_t child) {
  clockid_t clock;
  return clock_getcpuclockid(child, &clock) == 0 ? Now(clock) : 0;
}

/// Everything written to `fd` until its end, or until the child has used its time; nullopt: that.
std::optional<std::vector<char>> ReadUntilEnd(int fd, pid_t child, double cut_off) {
  const Stopwatch watch;
  std::vector<char> bytes;
  for (;;) {
    if (CpuOf(child) > cut_off || watch.seconds() > kWallOverCpuMax * cut_off) return std::nullopt;
    pollfd waiting{fd, POLLIN, 0};
    if (poll(&waiting, 1, kLookEveryMs) <= 0) continue;
    char chunk[4096];
    const ssize_t count = read(fd, chunk, sizeof chunk);
    if (count <= 0) return bytes;
    bytes.insert(bytes.end(), chunk, chunk + count);
  }
}

template <typename Watch>
double LeastOf(int runs, const std::function<void()>& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const Watch watch;
    work();
    least = std::min(least, watch.seconds());
  }
  return least;
}

[[noreturn]] void WorkAndLeave(int fd, const std::function<std::vector<double>()>& work) {
  int status = 1;
  try {
    const std::vector<double> values = work();
    const char* bytes = reinterpret_cast<const char*>(values.data());
    std::size_t left = values.size() * sizeof(double);
    while (left > 0) {
      const ssize_t count = write(fd, bytes, left);
      if (count <= 0) break;
      bytes += count, left -= static_cast<std::size_t>(count);
    }
    status = left == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench: %s\n", error.what());
  }
  // Not exit(): what the libraries leave to the end is none of ours, and may wait for threads.
  _exit(status);
}

}  // namespace

double WallNow() { return Now(CLOCK_MONOTONIC); }

double CpuNow() { return Now(CLOCK_PROCESS_CPUTIME_ID); }

double Quantile(std::vector<double> values, double fraction) {
  const auto at = static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

std::optional<double> QuantileOf(const std::vector<double>& values, double fraction) {
  if (values.empty()) return std::nullopt;
  return Quantile(values, fraction);
}

double LeastSeconds(int runs, const std::function<void()>& work) {
  return LeastOf<Stopwatch>(runs, work);
}

double LeastCpuSeconds(int runs, const std::function<void()>& work) {
  return LeastOf<CpuStopwatch>(runs, work);
}

ApartResult RunApart(double cut_off, const std::function<std::vector<double>()>& work) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) return {};
  if (child == 0) {
    close(ends[0]);
    WorkAndLeave(ends[1], work);
  }
  close(ends[1]);
  const auto bytes = ReadUntilEnd(ends[0], child, cut_off);
  close(ends[0]);
  if (!bytes) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (!bytes) return {ApartStatus::kCutOff, {}};
  if (status != 0) return {};
  const auto* values = reinterpret_cast<const double*>(bytes->data());
  return {ApartStatus::kDone, {values, values + bytes->size() / sizeof(double)}};
}

void KeepMemory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
}

}  // namespace collision::bench
