#include "tests/bench/service/crowd.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "collision/shape.h"
#include "collision/world.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

constexpr std::chrono::nanoseconds kPeriod{1'000'000'000 / 60};
constexpr double kSpread = 0.5;    // of the places [m]
constexpr double kSwing = 0.1;     // [m]
constexpr double kSwingRate = 2;   // [rad/s]
constexpr double kAway = -10'000;  // from the other simulator's agents [m]

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

std::int64_t WallNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
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

}  // namespace

void FlyCrowd(const std::string& world, std::uint32_t domain) {
  // As if on another machine: what counts is what it costs the service.
  if (nice(19) == -1) std::perror("nice");
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
    do {
      connection.Poll(std::chrono::nanoseconds(now_ns - WallNs()) + kPeriod);
    } while (WallNs() < now_ns + kPeriod.count());
  }
}

}  // namespace collision::bench
