#include "tests/bench/service/crowd.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <thread>
#include <vector>

#include "client/api/shape.h"
#include "client/api/world.h"
#include "tests/bench/harness/measure.h"
#include "tests/bench/service/driver.h"
#include "tests/bench/service/parts.h"
#include "tests/bench/service/process.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::nanoseconds kPeriod{1'000'000'000 / 60};
constexpr double kSpread = 0.5;    // of the places [m]
constexpr double kSwing = 0.1;     // [m]
constexpr double kSwingRate = 2;   // [rad/s]
constexpr double kAway = -10'000;  // from the other simulator's agents [m]
constexpr std::uint32_t kBeside = 100;
constexpr double kJoinSeconds = 20;
constexpr double kAnswerSeconds = 5;
constexpr double kCrowdMeetsSeconds = 5;
constexpr double kSettleSeconds = 2.5;

/// 3,160 triangles within 1 m of the centre.
client::Triangles Torus() {
  constexpr std::uint32_t kAround = 79, kAcross = 20;
  client::Triangles torus;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t j = 0; j < kAcross; ++j) {
      const double a = 2 * std::numbers::pi * i / kAround, b = 2 * std::numbers::pi * j / kAcross;
      const double away = 0.7 + 0.3 * std::cos(b);
      torus.vertices_m.push_back({away * std::cos(a), away * std::sin(a), 0.3 * std::sin(b)});
      const std::uint32_t k = (i + 1) % kAround, l = (j + 1) % kAcross;
      torus.indices.push_back({i * kAcross + j, k * kAcross + j, k * kAcross + l});
      torus.indices.push_back({i * kAcross + j, k * kAcross + l, i * kAcross + l});
    }
  }
  return torus;
}

struct Place {
  client::Vector3 at, swing;
  double phase;
};

client::State StateAt(const Place& place, std::int64_t stamp_ns) {
  const double angle =
      kSwingRate * 1e-9 * static_cast<double>(stamp_ns % 1'000'000'000'000) + place.phase;
  client::State state{.stamp_ns = stamp_ns};
  for (std::size_t i = 0; i < 3; ++i) {
    state.position_m[i] = place.at[i] + place.swing[i] * std::sin(angle);
    state.velocity_m_s[i] = kSwingRate * place.swing[i] * std::cos(angle);
  }
  state.position_error_m = state.velocity_error_m_s = state.rotation_error_rad = 1e-6;
  return state;
}

std::vector<Place> Places() {
  Random random(1);
  std::vector<Place> places(kCrowdAgents);
  for (Place& place : places) {
    for (std::size_t i = 0; i < 3; ++i) {
      place.at[i] = random.Uniform(-kSpread, kSpread);
      place.swing[i] = random.Uniform(-kSwing, kSwing);
    }
    place.at[0] += kAway;
    place.phase = random.Uniform(0, 2 * std::numbers::pi);
  }
  return places;
}

struct Latency {
  double p50 = 0, p99 = 0;
  std::size_t events = 0;
};

std::optional<Latency> Measure(const ServiceSettings& settings, bool crowded) {
  const std::string world = "bench-" + std::to_string(WallNs() % 1'000'000'000);
  ServiceProcess service("ours", world, settings.domain);
  ServiceDriver driver(world, settings.domain, kBeside);
  if (!driver.Join(kJoinSeconds)) return std::nullopt;
  std::optional<ServiceProcess> crowd;
  if (crowded) crowd.emplace(kCrowd, world, settings.domain);
  driver.Idle(kCrowdMeetsSeconds);
  std::vector<double> seconds;
  const double cpu = service.CpuSeconds();
  const Stopwatch watch;
  for (int lap = 0; lap < (settings.quick ? 1 : 5); ++lap) {
    for (std::uint32_t pair = 0; pair < driver.pairs(); ++pair) {
      if (const auto event = driver.JumpToEvent(pair, kAnswerSeconds)) seconds.push_back(*event);
      driver.Idle(0.001 * (1 + pair % 17));  // at any time within a step
    }
    driver.Idle(kSettleSeconds);
  }
  if (seconds.empty()) return std::nullopt;
  std::fprintf(stderr, "bench: %s: processor %.0f %%\n", crowded ? "crowded" : "alone",
               100 * (service.CpuSeconds() - cpu) / watch.seconds());
  return Latency{Quantile(seconds, 0.5), Quantile(seconds, 0.99), seconds.size()};
}

void Tell(const char* name, const Latency& latency, ServiceReport* report) {
  report->Add({Padded("crowd/" + std::string(name), 26) +
                   Padded("p50 " + SecondsText(latency.p50), 15) +
                   Padded("p99 " + SecondsText(latency.p99), 15) + std::to_string(latency.events) +
                   " events",
               {Text("part", "crowd"), Text("beside", name), Number("event_p50_s", latency.p50),
                Number("event_p99_s", latency.p99),
                Number("events", static_cast<double>(latency.events))}});
}

}  // namespace

void FlyCrowd(const std::string& world, std::uint32_t domain) {
  auto connection = client::World::Connect({.world = world,
                                            .simulator = kCrowd,
                                            .domain = domain,
                                            .lock_step = false,
                                            .on_demand = false});
  const auto shape = client::Shape::Make(Torus());
  const std::vector<Place> places = Places();
  std::vector<client::Agent> agents;
  for (const Place& place : places) {
    agents.push_back(connection.AddAgent({.name = "a" + std::to_string(agents.size()),
                                          .radius_m = 1.001,
                                          .acceleration_max_m_s2 = 1,
                                          .angular_acceleration_max_rad_s2 = 1,
                                          .shape = shape},
                                         StateAt(place, WallNs())));
  }
  for (;;) {
    const std::int64_t now_ns = WallNs();
    for (std::size_t i = 0; i < agents.size(); ++i) agents[i].SetState(StateAt(places[i], now_ns));
    connection.Publish(now_ns);
    connection.Poll();
    std::this_thread::sleep_until(std::chrono::system_clock::time_point(
        std::chrono::duration_cast<std::chrono::system_clock::duration>(
            std::chrono::nanoseconds(now_ns) + kPeriod)));
  }
}

void CrowdPart(const ServiceSettings& settings, ServiceReport* report) {
  if (!settings.Wants("crowd")) return;
  std::fprintf(stderr, "bench: a crowd of %u meshes\n", kCrowdAgents);
  const auto alone = Measure(settings, false), beside = Measure(settings, true);
  if (!alone || !beside) return report->Add({"crowd: no answer in time"});
  Tell("alone", *alone, report);
  Tell("beside", *beside, report);
  report->Figure("crowd_event_p50_ratio", beside->p50 / alone->p50);
  report->Figure("crowd_event_p99_ratio", beside->p99 / alone->p99);
}

}  // namespace collision::bench
