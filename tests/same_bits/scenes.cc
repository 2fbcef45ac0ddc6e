#include <iterator>

#include "tests/same_bits/scene.h"

namespace collision::server {

NetworkOptions Lossy(std::uint64_t seed) {
  return {.seed = seed, .loss = 0.05, .duplicate = 0.05, .delay_max_ns = 3'000'000};
}

std::vector<Scene> Scenes() {
  std::vector<Scene> all;
  for (std::vector<Scene>& some : std::vector{BallScenes(), CrowdedScenes(), ShapeScenes()}) {
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace collision::server
