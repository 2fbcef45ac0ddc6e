// Goal:   a World says who it is, and refuses a service that does not fit, in one sentence.
// Method: a network under the test's control.
#include <gtest/gtest.h>

#include "client/library/identity/library_version.h"
#include "idl/limits.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

// A service of another wire revision may mean anything: nothing of it is read, and that is told.
TEST(WorldHello, AServiceThatDoesNotFitIsRefusedInOneSentence) {
  const auto network = std::make_shared<FakeNetwork>();
  World world = ConnectTo(network, {.frame = "ENU 1"});
  EXPECT_EQ(network->hello.simulator_id(), SimulatorId(kSimulator));
  EXPECT_EQ(network->hello.incarnation(), kIncarnation);
  EXPECT_EQ(network->hello.wire_revision(), wire::kWireRevision);
  EXPECT_EQ(network->hello.clock_kind(), v1::CLOCK_LOCK_STEP);
  EXPECT_EQ(network->hello.frame(), "ENU 1");
  EXPECT_EQ(network->hello.version(), LibraryVersion());
  EXPECT_FALSE(network->hello.version().empty());
  network->Grant(10);
  v1::ServiceHello* hello = network->arriving.emplace_back().mutable_service_hello();
  hello->set_service_id(1);
  hello->set_wire_revision(wire::kWireRevision);
  hello->set_frame("ENU 2");
  world.Poll();
  EXPECT_NE(world.granted_until_ns(), 10);
  const std::vector<Rejection> rejections = world.TakeRejections();
  ASSERT_EQ(rejections.size(), 1u);
  EXPECT_EQ(rejections[0].reason, "REJECTED_MISMATCH");
  EXPECT_EQ(rejections[0].field, "frame");
  EXPECT_EQ(world.standing_refusals().size(), 1u);
  EXPECT_EQ(world.ended_because(),
            "\"tester\" does not fit the service: frame \"ENU 1\"; the world has \"ENU 2\"");
}

}  // namespace
}  // namespace collision::client
