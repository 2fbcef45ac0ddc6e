// Goal:   each scene runs to its end and its checker is satisfied.
// Method: as ./run demo does it: the scene runner's exit status is the checker's judgement.
#include <gtest/gtest.h>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

void ExpectSceneSucceeds(std::vector<std::string> words) {
  words.insert(words.begin(), Program("scene-runner"));
  words.insert(words.end(), {"--scenes", ConfigFile("scenes"), "--bin", COLLISION_BIN_DIR});
  const std::string data = COLLISION_DATA_DIR;
  if (!data.empty()) words.insert(words.end(), {"--data", data});
  const Outcome outcome = RunToEnd(words);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

TEST(Scenes, IridiumCosmos) { ExpectSceneSucceeds({"iridium-cosmos"}); }

TEST(Scenes, Swarm100) { ExpectSceneSucceeds({"swarm-100", "--seconds", "5"}); }

TEST(ScenesWithData, Corridor) { ExpectSceneSucceeds({"corridor"}); }

}  // namespace
}  // namespace collision::system_test
