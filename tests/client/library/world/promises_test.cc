// Goal:   a simulator hears of every lowering once, and acknowledges it.
// Method: a network under the test's control.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "collision/world.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

using std::chrono::nanoseconds;

class PromisesTest : public testing::Test {
 protected:
  /// A clearance of agent 0 of this sequence, lowered so often.
  void Clear(std::uint64_t sequence, std::uint32_t lowerings, v1::ClearanceCause cause,
             std::int64_t void_from_ns = kNever) {
    v1::Clearance* clearance = network_->arriving.emplace_back().mutable_clearance();
    clearance->set_simulator_id(ball_.id().simulator);
    clearance->set_run(ball_.id().run);
    clearance->mutable_stamp()->set_service_id(1);
    clearance->mutable_stamp()->set_term(1);
    clearance->mutable_stamp()->set_sequence(sequence);
    v1::AgentClearance* agent = clearance->add_agents();
    agent->set_slot(0);
    agent->set_generation(1);
    agent->set_clear_until_ns(1000);
    agent->set_lowerings(lowerings);
    agent->set_cause(cause);
    agent->set_void_from_ns(void_from_ns);
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  World world_ = ConnectTo(network_);
  Agent ball_ = world_.AddAgent({.name = "ball", .radius_m = 1, .acceleration_max_m_s2 = 0}, {});
};

TEST_F(PromisesTest, EachLoweringIsToldOnceHoweverOftenItIsRepeated) {
  std::vector<std::string> told;
  world_.OnClearanceLowered([&](const AgentId& id, const Clearance& clearance) {
    EXPECT_EQ(id, ball_.id());
    told.push_back(clearance.cause);
  });
  int voids = 0;
  world_.OnVoid([&](const AgentId&, const Clearance& clearance) {
    EXPECT_EQ(clearance.void_from_ns, 70);
    ++voids;
  });
  Clear(5, 0, v1::CAUSE_NONE);
  world_.Poll();
  EXPECT_TRUE(told.empty());
  Clear(6, 1, v1::CAUSE_TELEPORT);
  world_.Poll();
  Clear(7, 1, v1::CAUSE_TELEPORT);
  world_.Poll();
  EXPECT_EQ(told, std::vector<std::string>{"CAUSE_TELEPORT"});
  EXPECT_EQ(voids, 0);
  Clear(8, 3, v1::CAUSE_BREACH, 70);  // one in between was overwritten
  world_.Poll();
  EXPECT_EQ(told.size(), 2u);
  EXPECT_EQ(voids, 1);
}

TEST_F(PromisesTest, TheClockAcknowledgesWhatWasTakenIn) {
  world_.Publish(0);
  EXPECT_EQ(network_->Clocks().back().clearances_sequence(), 0u);
  Clear(6, 1, v1::CAUSE_TELEPORT);
  world_.Poll();
  network_->Grant(1);
  world_.Poll();
  world_.Publish(1);
  EXPECT_GE(network_->Clocks().back().clearances_sequence(), 6u);
  EXPECT_EQ(network_->Clocks().back().service_id(), 1u);
}

TEST_F(PromisesTest, WithoutAServiceNothingIsLost) {
  int lost = 0;
  world_.OnServiceLost([&] { ++lost; });
  world_.Poll();
  EXPECT_EQ(lost, 0) << "none was there";
  Clear(5, 0, v1::CAUSE_NONE);
  world_.Poll();
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(ball_.clearance().clear_until_ns, 1000);
}

}  // namespace
}  // namespace collision::client
