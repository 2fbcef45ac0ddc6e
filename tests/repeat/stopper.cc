#include "tests/repeat/stopper.h"

#include <signal.h>
#include <unistd.h>

extern "C" {
#include <sys/pidfd.h>  // this header of glibc 2.36 forgets that there is C++
}

#include <filesystem>
#include <iterator>
#include <utility>

namespace collision::repeat {
namespace {

// [s] About half of the time.
constexpr double kRunMin = 0.005, kRunMax = 0.1;
constexpr double kStopMin = 0.002, kStopMax = 0.1;

std::chrono::nanoseconds Time(double seconds) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
}

}  // namespace

Stopper::Stopper(std::string folder, std::uint64_t seed)
    : folder_(std::move(folder)), random_(seed) {}

Stopper::~Stopper() {
  GoOn();
  for (const auto& [id, descriptor] : processes_) close(descriptor);
}

void Stopper::FindProcesses() {
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const pid_t id = std::stoi(entry.path().filename().string());
    if (processes_.contains(id)) continue;
    const int descriptor = pidfd_open(id, 0);
    if (descriptor >= 0) processes_.emplace(id, descriptor);
  }
}

std::chrono::nanoseconds Stopper::Turn() {
  if (stopped_) {
    GoOn();
    return Time(random_.LogUniform(kRunMin, kRunMax));
  }
  FindProcesses();
  if (processes_.empty()) return Time(kRunMin);
  const auto chosen = static_cast<std::ptrdiff_t>(random_.Below(processes_.size()));
  const int descriptor = std::next(processes_.begin(), chosen)->second;
  if (pidfd_send_signal(descriptor, SIGSTOP, nullptr, 0) == 0) {
    stopped_ = descriptor;
    ++stops_;
  }
  return Time(random_.LogUniform(kStopMin, kStopMax));
}

void Stopper::GoOn() {
  if (stopped_) pidfd_send_signal(*stopped_, SIGCONT, nullptr, 0);
  stopped_.reset();
}

}  // namespace collision::repeat
