// Goal:   over real DDS a World and a service hear each other, and a Monitor hears both.
// Method: a service made by hand from a DDS session on loopback, in this process and thread: it
//         grants, reports one event, and checks what it received. Every wait is for an arrival,
//         with a bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>

#include "client/library/network/message_monitor.h"
#include "collision/monitor.h"
#include "collision/shape.h"
#include "collision/world.h"
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

  /// Runs `step` until it returns true.
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
  callbacks.event = [&](const Event&) { ++events_monitored; };
  callbacks.description = [&](const DescribedAgent&) { ++descriptions_monitored; };
  Monitor monitor({.world = kWorld, .domain = kDomain, .simulators = true}, callbacks);

  v1::ServiceStatus status;
  status.set_service_id(1);
  status.set_world(kWorld);
  service.Write(status);
  service.Flush();
  ASSERT_TRUE(world.WaitForService(std::chrono::seconds(30)));

  Agent ball = world.AddAgent({.name = "ball", .radius_m = 0.5, .acceleration_max_m_s2 = 0}, {});
  EXPECT_EQ(world.AdvanceTo(1000, milliseconds(0)), Advance::kTimeout);
  std::vector<v1::Input> inputs;
  const auto clock_arrived = [&](std::int64_t clock_ns) {
    return Until([&] {
      service.Receive(milliseconds(10), 100, &inputs, nullptr);
      return !inputs.empty() && std::any_of(inputs.begin(), inputs.end(), [&](const auto& input) {
        return input.simulator_clock().clock_ns() == clock_ns && input.has_simulator_clock();
      });
    });
  };
  ASSERT_TRUE(clock_arrived(0));

  v1::Clearance clearance;
  clearance.set_simulator_id(SimulatorId("smoke"));
  clearance.set_run(kRun);
  clearance.set_granted_until_ns(1000);
  clearance.set_contacts_sequence(1);
  service.Write(clearance);
  v1::CollisionEvent event;
  event.mutable_lower()->set_simulator_id(SimulatorId("smoke"));
  event.mutable_lower()->set_run(kRun);
  event.set_status(v1::EVENT_CONFIRMED);
  event.set_contacts_sequence(1);
  service.Write(event);
  service.Flush();
  ball.SetState({.stamp_ns = 1000, .position_m = {1, 2, 3}});
  ASSERT_EQ(world.AdvanceTo(1000, std::chrono::seconds(30)), Advance::kReached);
  world.Poll(milliseconds(1));  // Nothing more of this time follows.
  ASSERT_TRUE(clock_arrived(1000));
  std::vector<Event> events = world.TakeEvents();
  ASSERT_TRUE(Until([&] {
    if (events.empty()) world.Poll(milliseconds(10));
    for (const Event& more : world.TakeEvents()) events.push_back(more);
    return !events.empty();
  }));
  EXPECT_EQ(events[0].status, EventStatus::kConfirmed);

  ASSERT_TRUE(Until([&] {
    monitor.Poll(milliseconds(10));
    return events_monitored > 0 && descriptions_monitored > 0;
  }));

  { const Agent gone = std::move(ball); }
  ASSERT_TRUE(Until([&] {
    service.Receive(milliseconds(10), 100, &inputs, nullptr);
    return std::any_of(inputs.begin(), inputs.end(),
                       [](const v1::Input& input) { return input.has_agent_removal(); });
  }));
  EXPECT_TRUE(monitor.service_alive());
}

// Goal:   a shape arrives whole, and its removal too, as often as it comes and goes.
// Method: 20,000 triangles, published twice; a late monitor must receive them as well.
TEST_F(DdsSmokeTest, AShapeComesAndGoes) {
  DdsSession service = Service();
  World world = World::Connect(
      {.world = kWorld, .simulator = "shapes", .domain = kDomain, .run = kRun, .chunk_size = 8});
  Triangles strip;
  for (std::uint32_t i = 0; i < 20'002; ++i) strip.vertices_m.push_back({0.01 * i, i % 2 * 0.5, 0});
  for (std::uint32_t i = 0; i < 20'000; ++i) strip.indices.push_back({i, i + 1, i + 2});
  const auto shape = Shape::Make(strip);
  std::vector<v1::Input> inputs;
  for (int round = 0; round < 2; ++round) {
    inputs.clear();
    std::map<std::uint32_t, std::string> parts;
    std::size_t seen = 0, removals = 0;
    std::uint32_t number = 0;
    const auto hear = [&] {
      world.Poll();
      service.Receive(milliseconds(10), 100, &inputs, nullptr);
      for (; seen < inputs.size(); ++seen) {
        const v1::Input& input = inputs[seen];
        if (input.has_shape_part()) {
          number = input.shape_part().shape();
          parts[input.shape_part().part()] = input.shape_part().bytes();
        }
        removals += input.has_shape_removal() && input.shape_removal().shape() == number;
      }
    };
    Agent ship = world.AddAgent(
        {.name = "ship", .radius_m = 300, .acceleration_max_m_s2 = 0, .shape = shape}, {});
    ASSERT_TRUE(Until([&] {
      hear();
      return parts.size() == shape->bytes().size() / 49152 + 1;
    }));
    std::string bytes;
    for (const auto& [part, content] : parts) bytes += content;
    EXPECT_EQ(bytes, shape->bytes());
    std::size_t monitored = 0;
    MessageMonitor::Callbacks callbacks;
    callbacks.shape_part = [&](const v1::ShapePart&) { ++monitored; };
    MessageMonitor monitor({.world = kWorld, .domain = kDomain, .simulators = true}, callbacks);
    EXPECT_TRUE(Until([&] {
      world.Poll();
      monitor.Poll(milliseconds(10));
      return monitored >= parts.size();
    }));
    EXPECT_EQ(removals, 0u);
    { const Agent gone = std::move(ship); }
    EXPECT_TRUE(Until([&] {
      hear();
      return removals > 0;
    }));
  }
}

}  // namespace
}  // namespace collision::client
