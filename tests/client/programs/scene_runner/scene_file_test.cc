#include "client/programs/scene_runner/scene_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "client/programs/scene_runner/metrics.h"
#include "tests/support/temporary_path.h"

namespace collision::client {
namespace {

class SceneFileTest : public testing::Test {
 protected:
  SceneFileTest() : folders_{TemporaryPath("scenes"), "", ""} {
    std::filesystem::create_directories(folders_.scenes);
  }

  std::string ErrorOf(const std::string& text) {
    std::ofstream(folders_.scenes + "/test.textproto") << text;
    try {
      LoadScene(folders_, "test");
    } catch (const std::runtime_error& error) {
      const std::string what = error.what();
      return what.substr(what.find("test"));
    }
    return "no error";
  }

  Folders folders_;
};

// Goal:   every shipped scene is well-formed and its arguments name nothing unknown.
TEST_F(SceneFileTest, ShippedScenesLoad) {
  folders_.scenes = COLLISION_SCENES_DIR;
  const std::string list = ListScenes(folders_);
  for (const std::string name :
       {"iridium-cosmos", "low-orbit", "swarm-100", "swarm-1000", "swarm", "corridor"}) {
    EXPECT_NE(list.find(name + " "), std::string::npos);
    if (name == "corridor") continue;  // not offered without the data folder
    const v1::Scene scene = LoadScene(folders_, name);
    EXPECT_EQ(scene.processes_size(), 2);
    for (const auto& process : scene.processes()) {
      for (const std::string& argument : process.arguments()) {
        Substitute(argument, {{"SECONDS", "1"}, {"SCENES", "s"}, {"DATA", "d"}, {"LOG", "l"}});
      }
    }
  }
  EXPECT_NE(list.find("not offered: needs the data folder"), std::string::npos);
}

// Goal:   the error of a malformed scene names file, line and field.
TEST_F(SceneFileTest, ErrorsNameTheirPlace) {
  const std::string good = "seconds: 1\nprocesses { name: \"a\" program: \"b\" }\n";
  EXPECT_EQ(ErrorOf(good), "no error");
  EXPECT_EQ(ErrorOf("seconds: 1\nspeed: 2\n").substr(0, 17), "test.textproto:2:");
  EXPECT_NE(ErrorOf("seconds: 1\nspeed: 2\n").find("speed"), std::string::npos);
  EXPECT_EQ(ErrorOf("seconds: -1\n"),
            "test.textproto: seconds: -1.000000, allowed: greater than 0");
  EXPECT_EQ(ErrorOf("seconds: 1\n"), "test.textproto: processes: 0, allowed: 1 or more");
  EXPECT_EQ(ErrorOf(good + "data_file: \"x.csv\"\n"), "test: needs the data folder: x.csv");
}

// Goal:   the error of an unknown name lists the known ones.
TEST_F(SceneFileTest, AnUnknownSceneListsTheNames) {
  folders_.scenes = COLLISION_SCENES_DIR;
  try {
    LoadScene(folders_, "iridium");
    ADD_FAILURE();
  } catch (const NoSuchScene& error) {
    EXPECT_STREQ(
        error.what(),
        "no scene \"iridium\"; there are: corridor, drone-arms, floor, iridium-cosmos, keep-out, "
        "low-orbit, "
        "robots, spaceships, spaceships-100, spaceships-500, swarm, swarm-100, swarm-1000, "
        "terrain, "
        "terrain-million");
  }
}

TEST(ChangeConfig, SetsFieldsOverTheScenesOwn) {
  v1::Scene scene;
  scene.mutable_config()->set_agents_max(7);
  scene.mutable_config()->set_time_budget_us(2000);
  ChangeConfig("time_budget_us: 100 clock { skew_max_s: 0.25 }", &scene);
  EXPECT_EQ(scene.config().agents_max(), 7u);
  EXPECT_EQ(scene.config().time_budget_us(), 100);
  EXPECT_EQ(scene.config().clock().skew_max_s(), 0.25);
  EXPECT_THROW(ChangeConfig("time_budgte_us: 100", &scene), std::invalid_argument);
}

TEST(Substitute, ReplacesKnownNamesOnly) {
  EXPECT_EQ(Substitute("${A}/x${B}", {{"A", "1"}, {"B", "2"}}), "1/x2");
  EXPECT_THROW(Substitute("${C}", {{"A", "1"}}), std::runtime_error);
  EXPECT_THROW(Substitute("${A", {{"A", "1"}}), std::runtime_error);
}

TEST(Quantile, IsTheNearestRank) {
  EXPECT_EQ(Quantile({}, 0.5), 0);
  EXPECT_EQ(Quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(Quantile({3, 1, 2}, 1), 3);
  EXPECT_EQ(Quantile({3, 1, 2}, 0), 1);
}

}  // namespace
}  // namespace collision::client
