#include "client/simulators/pace.h"

#include <cmath>
#include <stdexcept>

#include "client/simulators/stop_signal.h"

namespace collision::client {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kServiceTimeout{20};
constexpr std::chrono::seconds kGrantTimeout{30};
constexpr milliseconds kStopCheck{50};  // how long a wait may overlook a signal

World Connect(const SimulatorOptions& options) {
  WorldOptions world;
  world.world = options.world;
  world.simulator = options.simulator;
  world.domain = options.domain;
  world.lock_step = !options.real_time;
  return World::Connect(world);
}

}  // namespace

Pace::Pace(const SimulatorOptions& options) : options_(options), world_(Connect(options)) {
  const auto deadline = steady_clock::now() + kServiceTimeout;
  while (!world_.WaitForService(kStopCheck)) {
    if (StopRequested()) break;
    if (steady_clock::now() > deadline) {
      throw std::runtime_error("no service in world \"" + options.world + "\", domain " +
                               std::to_string(options.domain));
    }
  }
  start_ = steady_clock::now();
  if (!options_.real_time) return;
  const std::int64_t now_ns =
      std::chrono::duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  start_ns_ = options_.start_ns >= 0 ? options_.start_ns : now_ns;
  start_ += nanoseconds(start_ns_ - now_ns);
}

std::int64_t Pace::end_ns() const { return start_ns_ + std::llround(options_.seconds * 1e9); }

bool Pace::WaitForWall(steady_clock::time_point until) {
  while (!StopRequested()) {
    const auto left = until - steady_clock::now();
    if (left <= nanoseconds(0)) return true;
    world_.Poll(std::min<nanoseconds>(left, kStopCheck));
  }
  return false;
}

bool Pace::AdvanceTo(std::int64_t clock_ns) {
  const std::int64_t elapsed_ns = clock_ns - start_ns_;
  if (options_.real_time) {
    if (!WaitForWall(start_ + nanoseconds(elapsed_ns))) return false;
    world_.Publish(clock_ns);
    world_.Poll();
    return true;
  }
  if (options_.speed > 0) {
    const auto due = nanoseconds(std::llround(static_cast<double>(elapsed_ns) / options_.speed));
    if (!WaitForWall(start_ + due)) return false;
  }
  auto deadline = steady_clock::now() + kGrantTimeout;
  std::int64_t granted_ns = world_.granted_until_ns();
  while (!StopRequested()) {
    if (world_.AdvanceTo(clock_ns, kStopCheck) == Advance::kReached) return true;
    if (world_.granted_until_ns() != granted_ns) {
      granted_ns = world_.granted_until_ns();
      deadline = steady_clock::now() + kGrantTimeout;
    }
    if (steady_clock::now() > deadline) {
      throw std::runtime_error("the service granted no time beyond " + std::to_string(granted_ns) +
                               " ns for 30 s");
    }
  }
  return false;
}

void Pace::Linger() {
  while (options_.linger && !StopRequested()) world_.Poll(kStopCheck);
}

}  // namespace collision::client
