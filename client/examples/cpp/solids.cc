// A simulator of one body that is more than a ball: a box on four wheels, exact, in four lines.
#include <cstdio>

#include "collision/shape.h"
#include "collision/world.h"

using namespace collision::client;
using namespace std::chrono_literals;

namespace {

// A capsule lies along its z axis: this turns it along y.
constexpr Quaternion kAcross = {1, 1, 0, 0};

std::shared_ptr<const Shape> Rover() {
  const Solid wheel = Solid::Capsule(0.15, 0.05);
  return Shape::Make(
      {.solids = {Solid::Box({0.5, 0.25, 0.1}).Rounded(0.02), wheel.At({0.35, 0.35, -0.1}, kAcross),
                  wheel.At({0.35, -0.35, -0.1}, kAcross), wheel.At({-0.35, 0.35, -0.1}, kAcross),
                  wheel.At({-0.35, -0.35, -0.1}, kAcross)}});
}

}  // namespace

int main() {
  const auto shape = Rover();
  World world = World::Connect({.simulator = "rovers"});
  world.OnEvent([](const Event& event) { std::puts(Name(event.status)); });
  AgentDescription rover = {.name = "rover"};
  rover.acceleration_max_m_s2 = 1;
  rover.angular_acceleration_max_rad_s2 = 0.5;
  rover.shape = shape;
  Agent agent = world.AddAgent(rover, {});
  for (std::int64_t t = 0; t <= 60'000'000'000; t += 100'000'000) {
    agent.SetState({.stamp_ns = t, .position_m = {2e-9 * t, 0, 0}, .velocity_m_s = {2, 0, 0}});
    if (world.AdvanceTo(t, 10s) == Advance::kTimeout) return 1;
  }
}
