// The fixed scenes whose event logs must be the same bits in every build.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/simulation/scenario.h"

namespace collision::server {

/// One run of the whole daemon on a simulated network.
struct Scene {
  std::string name;
  v1::Config config;
  NetworkOptions network = {};
  std::function<void(Scenario*)> fill;  ///< Adds the simulators; from any thread.
};

/// All of them, in a fixed order. A change of one changes its hash, on which nothing depends:
/// builds are compared with each other.
std::vector<Scene> Scenes();

std::vector<Scene> BallScenes();
std::vector<Scene> CrowdedScenes();
std::vector<Scene> ShapeScenes();

}  // namespace collision::server
