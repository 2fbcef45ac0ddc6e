#include "server/process/process_meter.h"

#include <sys/resource.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

namespace collision::server {
namespace {

std::int64_t Read(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

std::uint64_t MicrosecondsOf(const timeval& time) {
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000 +
         static_cast<std::uint64_t>(time.tv_usec);
}

/// Source: proc(5), /proc/self/statm: sizes in pages, the second one resident.
std::uint64_t ResidentBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  if (!(file >> all >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

ProcessMeter::ProcessMeter() : started_ns_(Read(CLOCK_REALTIME)), boot_ns_(Read(CLOCK_BOOTTIME)) {}

std::int64_t ProcessMeter::uptime_ns() const { return Read(CLOCK_BOOTTIME) - boot_ns_; }

std::int64_t ProcessMeter::NowNs() { return Read(CLOCK_MONOTONIC); }

ProcessUsage ProcessMeter::Usage() const {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return {.cpu_us = MicrosecondsOf(used.ru_utime) + MicrosecondsOf(used.ru_stime),
          .memory_bytes = ResidentBytes()};
}

std::string BuildText() {
#ifdef __clang__
  std::string text = "Clang " + std::to_string(__clang_major__) + "." +
                     std::to_string(__clang_minor__) + "." + std::to_string(__clang_patchlevel__);
#else
  std::string text = "GCC " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__) +
                     "." + std::to_string(__GNUC_PATCHLEVEL__);
#endif
#ifdef NDEBUG
  return text + ", debug checks off";
#else
  return text + ", debug checks on";
#endif
}

}  // namespace collision::server
