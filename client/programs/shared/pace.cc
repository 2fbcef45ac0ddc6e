#include "client/programs/shared/pace.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "client/library/notices/notices.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/grant_patience.h"
#include "client/programs/shared/stop_signal.h"
#include "collision/event_text.h"
#include "idl/scene.pb.h"

namespace collision::client {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kServiceTimeout{20};
constexpr milliseconds kStopCheck{50};  // period of looking for a stop signal

/// The wall clock as it was when it was first read, carried on by the steady clock: so the stamps
/// of a run go on evenly if the clock is set, and the service says if they are too far off.
std::int64_t CarriedWallClock() {
  static const auto steady = steady_clock::now();
  static const auto wall = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<nanoseconds>(wall + (steady_clock::now() - steady)).count();
}

World Connect(const SimulatorOptions& options) {
  WorldOptions world;
  world.world = options.world;
  world.simulator = options.simulator;
  world.domain = options.domain;
  world.credentials = options.credentials;
  world.lock_step = !options.real_time;
  world.on_demand = !options.stream;
  world.wall_clock = CarriedWallClock;
  return World::Connect(world);
}

std::string GrantedText(std::int64_t granted_ns) {
  if (granted_ns == std::numeric_limits<std::int64_t>::min()) return "";
  return " beyond " + InstantText(granted_ns, 0, 3);
}

}  // namespace

Pace::Pace(const SimulatorOptions& options) : options_(options), world_(Connect(options)) {
  if (!options.quiet) {
    std::fprintf(stderr, "%s: %s, %s\n", options.simulator.c_str(),
                 PlaceText(options.world, options.domain).c_str(),
                 options.real_time ? "real time" : "lock-step");
  }
  world_.OnNotice([this](const Notice& notice) { Hear(notice); });
  world_.OnWaiting([this](const std::vector<std::string>& names) { waited_for_ = names; });
  world_.OnServiceLost([this] { has_service_ = false; });
  world_.OnServiceBack([this] { has_service_ = true; });
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
  const std::int64_t now_ns = CarriedWallClock();
  start_ns_ = options_.start_ns >= 0 ? options_.start_ns : now_ns;
  start_ += nanoseconds(start_ns_ - now_ns);
}

std::int64_t Pace::end_ns() const { return start_ns_ + std::llround(options_.seconds * 1e9); }

bool Pace::WaitForWall(steady_clock::time_point until) {
  while (!StopRequested()) {
    const auto left = until - steady_clock::now();
    if (left <= nanoseconds(0)) return true;
    world_.Poll(std::min<nanoseconds>(left, kStopCheck));
    TakeRefusals();
  }
  return false;
}

bool Pace::AdvanceTo(std::int64_t clock_ns) {
  const std::int64_t elapsed_ns = clock_ns - start_ns_;
  if (options_.real_time) {
    if (!WaitForWall(start_ + nanoseconds(elapsed_ns))) return false;
    world_.Publish(clock_ns);
    world_.Poll();
    TakeRefusals();
    return true;
  }
  if (options_.speed > 0) {
    const auto due = nanoseconds(std::llround(static_cast<double>(elapsed_ns) / options_.speed));
    if (!WaitForWall(start_ + due)) return false;
  }
  std::int64_t granted_ns = world_.granted_until_ns();
  GrantPatience patience(granted_ns, steady_clock::now());
  while (!StopRequested()) {
    const bool reached = world_.AdvanceTo(clock_ns, kStopCheck) == Advance::kReached;
    TakeRefusals();
    if (reached) return true;
    const auto now = steady_clock::now();
    granted_ns = world_.granted_until_ns();
    if (patience.Lasts(granted_ns, HasReason(), now)) continue;
    RequireAgentsTaken();
    throw std::runtime_error("the service granted no time" + GrantedText(granted_ns) + " for " +
                             std::to_string(kGrantTimeout.count()) + " s");
  }
  return false;
}

bool Pace::HasReason() const {
  const auto other = [this](const std::string& name) { return name != options_.simulator; };
  return has_service_ && std::ranges::any_of(waited_for_, other);
}

void Pace::Hear(const Notice& notice) const {
  const bool is_end = notice.kind == NoticeKind::kWrongClock || notice.kind == NoticeKind::kEnded;
  if (is_end && !notice.over) throw RefusedError(notice.text);
  std::fprintf(stderr, "%s: %s\n", options_.simulator.c_str(), notice.text.c_str());
}

void Pace::TakeRefusals() {
  for (const Rejection& rejection : world_.TakeRejections()) {
    refused_ = std::max(refused_, rejection.count);
    if (rejection.lasting && refused_for_good_.empty()) refused_for_good_ = rejection.reason;
  }
  const std::string ended = world_.ended_because();
  if (!ended.empty()) throw RefusedError(ended);
}

void Pace::RequireAgentsTaken() const {
  const std::string other = world_.waits_for_name();
  if (!other.empty()) throw RefusedError(other);
  if (refused_for_good_.empty()) return;
  throw RefusedError("the service refused this simulator's agents: " + refused_for_good_);
}

void Pace::ReportTraffic(bool quiet) const {
  const Traffic& traffic = world_.traffic();
  const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  if (!quiet) {
    std::printf("states: %llu set, %llu sent in %llu samples\n", count(traffic.states_set),
                count(traffic.states_sent), count(traffic.samples_sent));
  }
  if (options_.traffic.empty()) return;
  v1::SimulatorTraffic report;
  report.set_simulator(options_.simulator);
  report.set_states_set(traffic.states_set);
  report.set_states_sent(traffic.states_sent);
  report.set_samples_sent(traffic.samples_sent);
  report.set_bytes_sent(traffic.bytes_sent);
  std::ofstream file(options_.traffic);
  file << report.Utf8DebugString();
  file.close();
  if (!file) throw std::runtime_error(options_.traffic + ": could not be written");
}

void Pace::CheckRefusals() {
  world_.Poll();
  TakeRefusals();
  if (refused_ == 0) return;
  std::fprintf(stderr, "%s: the service refused %llu samples\n", options_.simulator.c_str(),
               static_cast<unsigned long long>(refused_));
  RequireAgentsTaken();
}

void Pace::Fly(double rate_hz, std::size_t state_every,
               const std::function<bool(const PaceStep&)>& step) {
  std::int64_t t0_ns = start_ns();
  for (std::size_t i = 1; AdvanceTo(t0_ns) && t0_ns < end_ns(); ++i) {
    const std::int64_t elapsed_ns = std::llround(static_cast<double>(i) * 1e9 / rate_hz);
    const std::int64_t t1_ns = std::min(end_ns(), start_ns() + elapsed_ns);
    if (!step({t0_ns, t1_ns, i % state_every == 0 || t1_ns == end_ns()})) return;
    t0_ns = t1_ns;
  }
}

void Pace::Linger() {
  if (options_.linger && !StopRequested()) world_.Finish();
  while (options_.linger && !StopRequested()) {
    world_.Poll(kStopCheck);
    TakeRefusals();
  }
}

}  // namespace collision::client
