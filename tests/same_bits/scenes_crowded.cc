// Many agents: every method of the broad phase, on clusters of very different sizes.
#include <string>

#include "tests/same_bits/scene.h"

namespace collision::server {
namespace {

/// Clusters far apart, in which radii and speeds are of three orders of magnitude.
std::vector<SimulatedAgent> Clusters(int count, std::int64_t end_ns, Random* random) {
  std::vector<SimulatedAgent> agents;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d cluster((i % 7) * 150.0, (i % 3) * 90.0, 0);
    // One statement each: compilers evaluate operands in different orders.
    const double distance = random->Uniform(0, 30);
    const Eigen::Vector3d offset = distance * random->UnitVector();
    const double speed = random->LogUniform(0.01, 20);
    const Eigen::Vector3d velocity = speed * random->UnitVector();
    const double size = random->LogUniform(0.01, 3);
    agents.push_back({.radius = size,
                      .acceleration_max = random->LogUniform(0.001, 5),
                      .motion = Straight(cluster + offset, velocity, end_ns)});
  }
  return agents;
}

Scene Clustered(const std::string& name, v1::Config::BroadPhase method, int count,
                std::int64_t end_ns) {
  v1::Config config = ConfigFor(1);
  config.set_agents_max(4000);
  config.set_broad_phase(method);
  const auto fill = [count, end_ns](Scenario* scenario) {
    Random random(99);
    scenario->Add({.name = "alpha", .sender = 1, .period_ns = 200'000'000, .end_ns = end_ns},
                  Clusters(count, end_ns, &random));
  };
  return {.name = name, .config = config, .fill = fill};
}

}  // namespace

std::vector<Scene> CrowdedScenes() {
  return {Clustered("all-pairs", v1::Config::ALL_PAIRS, 250, 2 * kSecond),
          Clustered("adaptive", v1::Config::AUTO, 250, 2 * kSecond),
          Clustered("spatial-index", v1::Config::SPATIAL_INDEX, 250, 2 * kSecond),
          Clustered("clusters", v1::Config::AUTO, 1500, kSecond)};
}

}  // namespace collision::server
