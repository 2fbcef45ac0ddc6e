// Goal:   a program in C can do all that the library does, and is told what is wrong.
// Method: c_interface.c, linked as a stranger's program would be, beside real services; each
//         function of the header is called there.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

std::string SourceText(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(std::string(COLLISION_SOURCE_DIR) + "/" + path).rdbuf();
  return text.str();
}

void ExpectSuccess(Process* program) {
  EXPECT_EQ(program->WaitForExit(), 0) << program->out() << program->err();
}

TEST(CInterface, ValuesAreCheckedWithoutAService) {
  const TestWorld world(96);
  for (const char* part : {"alone", "real-time"})
    ExpectSuccess(world.StartHelper("c-interface", {part}).get());
}

TEST(CInterface, TwoBallsMeetAndAMonitorSeesIt) {
  const TestWorld world(97, "simulators_awaited: 1", "agents_max: 2");
  const auto daemon = world.StartDaemon();
  ExpectSuccess(world.StartHelper("c-interface", {"meeting"}).get());
}

TEST(CInterface, ASimulatorIsToldWhatHappensToIt) {
  const TestWorld world(98, "simulators_awaited: 2 waiting_after_s: 0.2");
  auto daemon = world.StartDaemon();
  const auto program = world.StartHelper("c-interface", {"trouble"});
  ASSERT_TRUE(program->WaitForOutput("evict ada")) << program->err() << daemon->err();
  EXPECT_EQ(world.Monitor({"evict", "ada"}).status, 0);
  ASSERT_TRUE(program->WaitForOutput("stop the service")) << program->err() << daemon->err();
  daemon->Signal(SIGTERM);
  EXPECT_EQ(daemon->WaitForExit(), 0);
  ASSERT_TRUE(program->WaitForOutput("start the service")) << program->err();
  daemon = world.StartDaemon();
  ExpectSuccess(program.get());
}

TEST(CInterface, AgentsCanBeLeftWithTheService) {
  const TestWorld world(99, "simulators_awaited: 1");
  const auto daemon = world.StartDaemon();
  ExpectSuccess(world.StartHelper("c-interface", {"leaves-agents"}).get());
  EXPECT_TRUE(world.MonitorComesToSay({"agents"}, "held: its simulator is not heard"));
}

TEST(CInterface, EveryFunctionIsTested) {
  const std::string header = SourceText("client/include/collision/collision.h");
  const std::string tests = SourceText("tests/system/c_interface.c");
  const std::regex declared(R"(COLLISION_C_API [\w\s*]*?\b(collision_\w+)\()");
  int functions = 0;
  for (std::sregex_iterator found(header.begin(), header.end(), declared), end; found != end;
       ++found, ++functions) {
    EXPECT_NE(tests.find((*found)[1].str() + "("), std::string::npos) << (*found)[1];
  }
  EXPECT_GE(functions, 40);
}

}  // namespace
}  // namespace collision::system_test
