// A simulator in ten lines: one ball that flies along x, in step with all simulators of its world.
#include <cstdio>

#include "client/api/world.h"

using namespace collision::client;
using namespace std::chrono_literals;

int main() {
  World world = World::Connect({.simulator = "ten-lines"});
  world.OnEvent([](const Event& event) { std::puts(Name(event.status)); });
  Agent ball = world.AddAgent({.name = "ball", .radius_m = 0.5, .acceleration_max_m_s2 = 1}, {});
  for (std::int64_t t = 0; t <= 60'000'000'000; t += 100'000'000) {
    ball.SetState({.stamp_ns = t, .position_m = {2e-9 * t, 0, 0}, .velocity_m_s = {2, 0, 0}});
    if (world.AdvanceTo(t, 10s) == Advance::kTimeout) return 1;
  }
}
