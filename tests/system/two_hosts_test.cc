// Goal:   daemon, simulators and monitor find each other across hosts, with the profile that is
// shipped. Method: two network namespaces; the service and the monitor live in one, the simulators
// in the other.
#include "tests/system/two_hosts.h"

#include <gtest/gtest.h>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

TEST(TwoHosts, SimulatorsElsewhereCollideAllTheSame) {
  const TwoHosts hosts;
  TestWorld world(67);
  world.MoveTo(hosts.host(0));
  const auto daemon = world.StartDaemon();
  // It has no credentials, and the cable leads to others.
  EXPECT_TRUE(Contains(daemon->err(), "not secured, and heard beyond this machine (network "))
      << daemon->err();
  const auto events = world.StartMonitor({"events", "--follow"});
  world.MoveTo(hosts.host(1));
  const auto left = world.StartSimulator(kLeft);
  const auto right = world.StartSimulator(kRight);
  EXPECT_TRUE(events->WaitForOutput("ended")) << events->out() << daemon->err() << left->err();
  EXPECT_EQ(left->WaitForExit(), 0) << left->err();
  EXPECT_EQ(right->WaitForExit(), 0) << right->err();
}

TEST(TwoHosts, AnUnpluggedCableEndsNoProgramAndLosesNoEvent) {
  const TwoHosts hosts;
  TestWorld world(68);
  world.MoveTo(hosts.host(0));
  const auto daemon = world.StartDaemon();
  const auto events = world.StartMonitor({"events", "--follow"});
  world.MoveTo(hosts.host(1));
  const auto left = world.StartSimulator(kLeft, {"--speed", "0.5"});
  const auto right = world.StartSimulator(kRight, {"--speed", "0.5"});
  ASSERT_TRUE(events->WaitForOutput("possible")) << events->out() << daemon->err() << left->err();
  hosts.Plug(false);
  // Long enough that samples are lost: nothing but the cable can bring more.
  EXPECT_FALSE(events->WaitForOutput("ended", std::chrono::seconds(2)));
  hosts.Plug(true);
  EXPECT_TRUE(events->WaitForOutput("ended")) << events->out();
  EXPECT_EQ(left->WaitForExit(), 0) << left->err();
  EXPECT_EQ(right->WaitForExit(), 0) << right->err();
}

}  // namespace
}  // namespace collision::system_test
