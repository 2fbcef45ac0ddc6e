// Goal:   each scene runs to its end and its checker is satisfied; interrupted, it leaves nothing
// running. Method: as ./run demo does it: the scene runner's exit status is the checker's
// judgement.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/sanitized.h"
#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

std::vector<std::string> SceneRunner(std::vector<std::string> words) {
  words.insert(words.begin(), Program("scene-runner"));
  words.insert(words.end(), {"--scenes", ConfigFile("scenes"), "--bin", COLLISION_BIN_DIR});
  const std::string data = COLLISION_DATA_DIR;
  if (!data.empty()) words.insert(words.end(), {"--data", data});
  return words;
}

const std::vector<std::string> kLoopback = {"CYCLONEDDS_URI=file://" +
                                            ConfigFile("cyclonedds-loopback.xml")};

void ExpectSceneSucceeds(const std::vector<std::string>& words) {
  const Outcome outcome = RunToEnd(SceneRunner(words), kLoopback);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

TEST(Scenes, Swarm100SatisfiesTheChecker) { ExpectSceneSucceeds({"swarm-100", "--seconds", "5"}); }

// Convex solids, against each other and against triangles.
TEST(Scenes, DroneArmsSatisfyTheChecker) { ExpectSceneSucceeds({"drone-arms", "--seconds", "6"}); }

// Assemblies: nothing within a robot, everything between them.
TEST(Scenes, RobotsSatisfyTheChecker) { ExpectSceneSucceeds({"robots", "--seconds", "3"}); }

// Its fine tree takes longer than any simulator waits: time must begin with the coarse one. The
// checker takes most of a minute; under a sanitizer, where it takes many, the run is what counts.
TEST(Scenes, AMillionTrianglesSatisfyTheChecker) {
  std::vector<std::string> words = {"terrain-million", "--seconds", "0.5"};
  if (kSanitized) words.push_back("--unjudged");
  ExpectSceneSucceeds(words);
}

// Cylinders, a cone and balls meet a half-space, with a level and a margin.
TEST(Scenes, AFloorSatisfiesTheChecker) { ExpectSceneSucceeds({"floor"}); }

/// A number of a report, as --json writes it, those of 64 bits in quotes; -1: it is not there.
double NumberIn(const std::string& json, const std::string& field) {
  const std::string key = "\"" + field + "\": ";
  const std::size_t at = json.find(key);
  if (at == std::string::npos) return -1;
  const std::size_t value = at + key.size();
  return std::stod(json.substr(json[value] == '"' ? value + 1 : value));
}

/// The report of a scene that succeeds.
std::string ReportOf(std::vector<std::string> words) {
  const std::string path = testing::TempDir() + words[0] + "." + std::to_string(getpid()) + ".json";
  words.insert(words.end(), {"--json", path});
  ExpectSceneSucceeds(words);
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::remove(path.c_str());
  return text.str();
}

/// The median of a field of type Quantiles.
double MedianIn(const std::string& json, const std::string& field) {
  const std::size_t at = json.find("\"" + field + "\"");
  return at == std::string::npos ? -1 : NumberIn(json.substr(at), "p50");
}

// Goal:   satisfied with and without a known acceleration; with it the begin bracket is 50 times
//         narrower, and 30 s ahead 25 times less of the time to the contact is lost.
TEST(Scenes, IridiumCosmosIsSharperWithItsAccelerationKnown) {
  const std::string known = ReportOf({"iridium-cosmos"});
  const std::string unknown =
      ReportOf({"iridium-cosmos", "--arguments", "--known-acceleration never"});
  EXPECT_LT(MedianIn(known, "begin_width_s") * 50, MedianIn(unknown, "begin_width_s"));
  EXPECT_LT((1 - NumberIn(known, "announcement_tightness_median")) * 25,
            1 - NumberIn(unknown, "announcement_tightness_median"));
}

// Goal:   with the acceleration of gravity known, 30 s ahead the time clear is nearly all of the
//         time to a contact, and few alarms are false.
TEST(Scenes, LowOrbitKnowsWhereItsSatellitesAre) {
  const std::string json = ReportOf({"low-orbit"});
  EXPECT_GE(NumberIn(json, "contacts_true"), 10);
  EXPECT_GE(NumberIn(json, "announcement_tightness_median"), 0.99);
  EXPECT_GE(MedianIn(json, "announcement_lead_s"), 29);
  EXPECT_LE(NumberIn(json, "false_alarms_per_contact"), 0.5);
  EXPECT_GE(NumberIn(json, "message_ratio"), 50);
}

// As dense as the swarm of 10,000. Drones start at rest, so that the first seconds are its
// quietest: what counts here is that both figures are reported and that nothing was late.
TEST(Scenes, SwarmSendsWhatIsNeeded) {
  const std::string json = ReportOf({"swarm-1000", "--seconds", "3"});
  EXPECT_GE(NumberIn(json, "message_ratio"), 10);
  EXPECT_EQ(NumberIn(json, "agents"), 1000);
  EXPECT_GT(NumberIn(json, "real_time_fraction"), 0);
}

// Two levels, one of them with a hysteresis: what they tell is judged by the true distances.
TEST(Scenes, LevelsSatisfyTheChecker) {
  const std::string json = ReportOf({"keep-out", "--seconds", "5"});
  for (const char* level : {"near", "close"}) {
    EXPECT_NE(json.find("\"level\": \"" + std::string(level) + "\""), json.npos) << level;
  }
}

TEST(Scenes, AStreamSendsEverything) {
  const std::string json = ReportOf({"swarm-100", "--seconds", "2", "--stream"});
  EXPECT_EQ(NumberIn(json, "message_ratio"), 1);
}

/// What the daemon's log tells of the events of a run: their number and hash.
std::string EventLogOf(const std::vector<std::string>& scene) {
  const std::string folder = testing::TempDir() + "repeat." + std::to_string(getpid());
  std::vector<std::string> words = scene;
  words.insert(words.end(), {"--logs", folder, "--unjudged"});
  ExpectSceneSucceeds(words);
  std::ostringstream log;
  log << std::ifstream(folder + "/collisiond.log").rdbuf();
  std::filesystem::remove_all(folder);
  return EventLogLine(log.str());
}

// Goal:   the events of a scene in lock-step follow from its simulators alone, which bounce where
//         they hear of a contact.
// Method: the same scenes again and again, also while the machine is kept busy, with balls and with
//         meshes, whose trees take their time. Not judged: an observer that gets no processor may
//         miss a forecast, of which a reader keeps the last two.
TEST(Scenes, InLockStepTheEventsAreTheSameEveryTime) {
  const std::vector<std::string> scenes[] = {{"swarm-100", "--seconds", "5"},
                                             {"keep-out", "--seconds", "3"},
                                             {"spaceships", "--seconds", "6"}};
  for (const std::vector<std::string>& scene : scenes) {
    const std::string first = EventLogOf(scene);
    EXPECT_NE(first.find("hash"), std::string::npos);
    EXPECT_EQ(first.find(" 0 events"), std::string::npos) << first;
    EXPECT_EQ(EventLogOf(scene), first);
    const Process busy({"sh", "-c", "while :; do :; done"});
    const Process as_busy({"sh", "-c", "while :; do :; done"});
    EXPECT_EQ(EventLogOf(scene), first);
  }
}

TEST(Scenes, AnInterruptedRunLeavesNoProcessBehind) {
  // Orphans of our children become ours, so that they can be seen.
  ASSERT_EQ(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    Process runner(SceneRunner({"swarm-100", "--real-time", "--seconds", "60"}), kLoopback);
    ASSERT_TRUE(runner.WaitForOutput("possible")) << runner.out() << runner.err();
    runner.Signal(signal);
    ASSERT_TRUE(runner.WaitForExit().has_value());
    EXPECT_NE(runner.WaitForExit(), 0);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a process was left behind";
  }
}

TEST(ScenesWithData, CorridorSatisfiesTheChecker) { ExpectSceneSucceeds({"corridor"}); }

}  // namespace
}  // namespace collision::system_test
