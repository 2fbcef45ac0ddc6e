#include <iterator>

#include "tests/same_bits/scene.h"

namespace collision::server {

std::vector<Scene> Scenes() {
  std::vector<Scene> all;
  for (std::vector<Scene>& some : std::vector{BallScenes(), CrowdedScenes(), ShapeScenes()}) {
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace collision::server
