// Goal:   a program that writes or disposes of ever-new keys costs the service no memory, and no
//         other simulator its answers.
// Method: the real service, a hostile program, and an honest one in lock-step beside it; memory as
//         the kernel counts it. A fifth of what is measured for tests/report/MEASURED.md.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>

#include "tests/support/sanitized.h"
#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

constexpr char kKeys[] = "200000";

/// 200,000 keys would take 110 MB, disposed of 220 MB, if a reader kept them.
constexpr double kGrowthMaxMb = 40;

double ResidentMb(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  std::string word;
  while (status >> word && word != "VmRSS:") {
  }
  double kilobytes = 0;
  status >> kilobytes;
  return kilobytes / 1000;
}

class Flood : public testing::TestWithParam<const char*> {};

TEST_P(Flood, CostsNoMemoryAndNoOtherItsAnswers) {
  const TestWorld world(82, "simulators_awaited: 1", "waiting_mb_max: 16\n");
  const auto daemon = world.StartDaemon();
  const auto honest = world.StartHelper("flood", {"answers", "8"});
  ASSERT_TRUE(honest->WaitForOutput("steps")) << honest->err() << daemon->err();
  const double before_mb = ResidentMb(daemon->pid());
  ASSERT_GT(before_mb, 0);
  const auto hostile = world.StartHelper("flood", {GetParam(), kKeys});
  ASSERT_TRUE(hostile->WaitForOutput("written:")) << hostile->err() << daemon->err();
  if (!kSanitized) {
    EXPECT_LT(ResidentMb(daemon->pid()) - before_mb, kGrowthMaxMb);
  }
  EXPECT_EQ(honest->WaitForExit(), 0) << honest->err();
  EXPECT_TRUE(Contains(honest->out(), "answers: ")) << honest->out();
  daemon->Signal(SIGTERM);
  EXPECT_EQ(daemon->WaitForExit(), 0) << daemon->err();
}

INSTANTIATE_TEST_SUITE_P(EverNew, Flood, testing::Values("keys", "disposals"),
                         [](const auto& kind) { return std::string(kind.param); });

// Goal:   whatever a participant writes, the service refuses or takes each message by itself, and
//         serves the honest simulator as before.
// Method: 20,000 messages of every topic with spoilt fields, for several names.
TEST(Hostile, MessagesCostTheHonestNothing) {
  const TestWorld world(130, "kind: REAL_TIME skew_max_s: 0.2");
  const auto daemon = world.StartDaemon();
  const auto honest = world.StartHelper("troubles", {"real-time"});
  ASSERT_TRUE(honest->WaitForOutput("here")) << honest->err();
  const auto hostile = world.StartHelper("hostile", {"20000"});
  ASSERT_TRUE(hostile->WaitForOutput("written: 20000")) << hostile->err() << daemon->err();
  EXPECT_EQ(hostile->WaitForExit(), 0) << hostile->err();
  EXPECT_TRUE(daemon->WaitForOutput("input refused")) << daemon->err();
  const Outcome status = world.Monitor({"status", "--json"});
  EXPECT_TRUE(Contains(status.out, "\"name\":\"troubled\"")) << status.out;
  const Outcome agents = world.Monitor({"agents", "--json"});
  for (const char* name : {"one", "two"})
    EXPECT_TRUE(Contains(agents.out, "\"name\":\"" + std::string(name) + "\"")) << agents.out;
  EXPECT_TRUE(world.MonitorComesToSay({"agents"}, "troubled")) << agents.out;
  daemon->Signal(SIGTERM);
  EXPECT_EQ(daemon->WaitForExit(), 0) << daemon->err();
}

}  // namespace
}  // namespace collision::system_test
