// A simulator in ten lines: two balls that meet, in step with all simulators of their world.
#include <cstdio>

#include "collision/event_text.h"
#include "collision/world.h"

using namespace collision::client;
using namespace std::chrono_literals;

State At(std::int64_t t, double x, double v) {
  return {.stamp_ns = t, .position_m = {x + v * 1e-9 * t, 0, 0}, .velocity_m_s = {v, 0, 0}};
}

int main() {
  World world = World::Connect({.simulator = "ten-lines"});
  AgentDescription ball = {.name = "ada", .radius_m = 0.5, .acceleration_max_m_s2 = 1};
  Agent ada = world.AddAgent(ball, At(0, -10, 2));
  ball.name = "bob";
  Agent bob = world.AddAgent(ball, At(0, 10, -2));
  const auto name = [&](const AgentId& id) { return world.Name(id); };
  world.OnEvent([&](const Event& event) { std::puts(EventLine(event, name, 0).c_str()); });
  for (std::int64_t t = 0; t <= 10'000'000'000; t += 100'000'000) {
    ada.SetState(At(t, -10, 2));
    bob.SetState(At(t, 10, -2));
    if (world.AdvanceTo(t, 10s) == Advance::kTimeout) return 1;
  }
}
