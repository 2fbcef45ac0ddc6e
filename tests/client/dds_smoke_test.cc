// Goal:   over real DDS a World and a service hear each other, and a Monitor hears both.
// Method: a service made by hand from a DDS session on loopback, in this process and thread: it
//         grants, reports one event, and looks at what it was told. Every wait is for an arrival,
//         with a bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "client/monitor.h"
#include "client/world.h"
#include "idl/dds/session.h"
#include "idl/identity.h"

namespace collision::client {
namespace {

using std::chrono::milliseconds;

constexpr char kLoopback[] =
    "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface "
    "name=\"lo\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery>"
    "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
    "<Peers><Peer Address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";
constexpr std::uint32_t kDomain = 171;
constexpr char kWorld[] = "client-smoke";
constexpr int kTriesMax = 3000;  // Of 10 ms each.
constexpr std::uint32_t kRun = 3;

class DdsSmokeTest : public testing::Test {
 protected:
  DdsSmokeTest() { setenv("CYCLONEDDS_URI", kLoopback, 1); }

  static DdsSession Service() {
    DdsSessionOptions options;
    options.world = kWorld;
    options.domain = kDomain;
    options.role = DdsRole::kService;
    return DdsSession(options);
  }

  /// Runs `step` until it says that it is done.
  static bool Until(const std::function<bool()>& step) {
    for (int i = 0; i < kTriesMax; ++i) {
      if (step()) return true;
    }
    return false;
  }
};

TEST_F(DdsSmokeTest, ASimulatorAServiceAndAMonitorMeet) {
  DdsSession service = Service();
  World world = World::Connect(
      {.world = kWorld, .simulator = "smoke", .domain = kDomain, .run = kRun, .chunk_size = 8});
  Monitor::Callbacks callbacks;
  int events_monitored = 0, descriptions_monitored = 0;
  callbacks.event = [&](const v1::CollisionEvent&) { ++events_monitored; };
  callbacks.description = [&](const v1::AgentDescription&) { ++descriptions_monitored; };
  Monitor monitor({.world = kWorld, .domain = kDomain, .simulators = true}, callbacks);

  v1::ServiceStatus status;
  status.set_service_id(1);
  status.set_world(kWorld);
  service.Write(status);
  service.Flush();
  ASSERT_TRUE(world.WaitForService(std::chrono::seconds(30)));

  Agent ball = world.AddAgent({.name = "ball", .radius_m = 0.5}, {});
  EXPECT_EQ(world.AdvanceTo(1000, milliseconds(0)), Advance::kTimeout);
  std::vector<v1::Input> inputs;
  const auto told = [&](std::int64_t clock_ns) {
    return Until([&] {
      service.Receive(milliseconds(10), 100, &inputs, nullptr);
      return !inputs.empty() && std::any_of(inputs.begin(), inputs.end(), [&](const auto& input) {
        return input.simulator_clock().clock_ns() == clock_ns && input.has_simulator_clock();
      });
    });
  };
  ASSERT_TRUE(told(0));

  v1::Clearance clearance;
  clearance.set_simulator_id(SimulatorId("smoke"));
  clearance.set_run(kRun);
  clearance.set_granted_until_ns(1000);
  service.Write(clearance);
  v1::CollisionEvent event;
  event.mutable_lower()->set_simulator_id(SimulatorId("smoke"));
  event.mutable_lower()->set_run(kRun);
  event.set_status(v1::EVENT_CONFIRMED);
  service.Write(event);
  service.Flush();
  ball.SetState({.stamp_ns = 1000, .position_m = {1, 2, 3}});
  ASSERT_EQ(world.AdvanceTo(1000, std::chrono::seconds(30)), Advance::kReached);
  ASSERT_TRUE(told(1000));
  std::vector<Event> events = world.TakeEvents();
  ASSERT_TRUE(Until([&] {
    if (events.empty()) world.Poll(milliseconds(10));
    for (const Event& more : world.TakeEvents()) events.push_back(more);
    return !events.empty();
  }));
  EXPECT_EQ(events[0].status, EventStatus::kConfirmed);

  { const Agent gone = std::move(ball); }
  ASSERT_TRUE(Until([&] {
    service.Receive(milliseconds(10), 100, &inputs, nullptr);
    return inputs.back().has_agent_removal();
  }));
  ASSERT_TRUE(Until([&] {
    monitor.Poll(milliseconds(10));
    return events_monitored > 0 && descriptions_monitored > 0;
  }));
  EXPECT_TRUE(monitor.service_alive());
}

}  // namespace
}  // namespace collision::client
