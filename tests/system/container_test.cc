// Goal:   programs of the image obey their options, as far as can be seen without an engine: the
//         start, the health check, the end.
// Method: docker/serve with the settings of the image, and the very command of HEALTHCHECK, with
//         the programs of this build, on this machine alone.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

std::string DockerFile(const std::string& name) {
  return std::string(COLLISION_SOURCE_DIR) + "/docker/" + name;
}

/// The shell command of the image's HEALTHCHECK.
std::string HealthCheck() {
  std::ostringstream text;
  text << std::ifstream(DockerFile("Dockerfile")).rdbuf();
  const std::string dockerfile = text.str();
  const std::string mark = "  CMD ";
  const auto begin = dockerfile.find(mark, dockerfile.find("\nHEALTHCHECK ")) + mark.size();
  return dockerfile.substr(begin, dockerfile.find('\n', begin) - begin);
}

/// The environment of a container of the image, as far as it can be had here.
class Container {
 public:
  Container(const std::string& world, const std::string& domain,
            const std::string& settings = DockerFile("collisiond.textproto"))
      : variables_{"PATH=" COLLISION_BIN_DIR ":" + std::string(std::getenv("PATH")),
                   "COLLISION_WORLD=" + world, "COLLISION_DOMAIN=" + domain,
                   "COLLISION_CONFIG=" + settings,
                   "CYCLONEDDS_URI=file://" + ConfigFile("cyclonedds-loopback.xml")} {}

  Outcome Serve(const std::string& option) const {
    return RunToEnd({DockerFile("serve"), option}, variables_);
  }
  std::unique_ptr<Process> Start() const {
    return std::make_unique<Process>(std::vector<std::string>{DockerFile("serve")}, variables_);
  }
  std::optional<int> Health() const {
    return RunToEnd({"/bin/sh", "-c", HealthCheck()}, variables_).status;
  }
  bool HealthComesToBe(int status) const {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < deadline) {
      if (Health() == status) return true;
    }
    return false;
  }

 private:
  std::vector<std::string> variables_;
};

TEST(Container, TakesWorldAndDomainFromTheEnvironmentAndTheRestFromItsFile) {
  const Outcome outcome = Container("lab", "72").Serve("--print-config");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* line : {"\nworld: \"lab\"\n", "\ndomain: 72\n", "\n  kind: REAL_TIME\n"}) {
    EXPECT_TRUE(Contains(outcome.out, line)) << line << outcome.out;
  }
}

TEST(Container, RefusesWhatTheDaemonRefuses) {
  EXPECT_EQ(Container("no such world", "0").Serve("--check-config").status, 2);
  EXPECT_EQ(Container("lab", "231").Serve("--check-config").status, 2);
  EXPECT_EQ(Container("lab", "").Serve("--check-config").status, 78);
  EXPECT_EQ(Container("lab", "0", "/no/such/file").Serve("--check-config").status, 78);
}

TEST(Container, NamesTheLineOfAMistakeInItsFile) {
  const Folder folder;
  const std::string file = folder.Write("bad.textproto", "# first\n\nagents_maximum: 3\n");
  const Outcome outcome = Container("lab", "0", file).Serve("--check-config");
  EXPECT_EQ(outcome.status, 78);
  EXPECT_TRUE(Contains(outcome.err, ":3:")) << outcome.err;
  EXPECT_TRUE(Contains(outcome.err, "agents_maximum")) << outcome.err;
}

// The image has the programs of the build, and not its folder.
TEST(Container, ProgramsNeedNoLibraryOfTheBuild) {
  for (const char* program : {"collisiond", "collisionctl", "ten-lines", "drone-swarm", "spaceship",
                              "scene-runner", "trajectory-player"}) {
    const Outcome libraries = RunToEnd({"ldd", Program(program)});
    EXPECT_EQ(libraries.status, 0) << libraries.err;
    EXPECT_FALSE(Contains(libraries.out, "libcollision")) << program << "\n" << libraries.out;
  }
}

TEST(Container, IsHealthyAsLongAsItServes) {
  const std::string domain = "71";
  const Container container("container-test", domain);
  EXPECT_EQ(container.Health(), 1) << "there is no service yet";
  const auto service = container.Start();
  ASSERT_TRUE(service->WaitForOutput("serves world")) << service->err();
  EXPECT_TRUE(container.HealthComesToBe(0));
  EXPECT_EQ(Container("another-world", domain).Health(), 1);

  service->Signal(SIGSTOP);
  EXPECT_TRUE(container.HealthComesToBe(1)) << "it stands still";
  service->Signal(SIGCONT);
  EXPECT_TRUE(container.HealthComesToBe(0));

  // It is the daemon itself that has the number of the script, and gets the signal.
  service->Signal(SIGTERM);
  EXPECT_EQ(service->WaitForExit(), 0) << service->err();
  EXPECT_TRUE(Contains(service->err(), "event log:")) << service->err();
  EXPECT_EQ(container.Health(), 1);
}

}  // namespace
}  // namespace collision::system_test
