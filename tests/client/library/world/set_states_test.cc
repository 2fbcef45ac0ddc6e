// Goal:   states of many agents in one call have the effect of single calls, also where one is
//         refused.
// Method: both on a network under the test's control, message for message.
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

class SetStatesTest : public testing::Test {
 protected:
  static State At(std::int64_t stamp_ns, double x = 0) {
    return {.stamp_ns = stamp_ns, .position_m = {x, 0, 0}};
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
};

TEST_F(SetStatesTest, AreThoseOfSingleCalls) {
  std::vector<v1::Input> written[2];
  for (const bool in_one_call : {false, true}) {
    network_->written.clear();
    World world = ConnectTo(network_);
    std::vector<Agent> agents;
    for (int i = 0; i < 3; ++i) agents.push_back(world.AddAgent(Point(), At(0)));
    world.Publish(0);
    const std::vector<State> states = {At(0, 1), At(0, 2), At(0, 3)};
    if (in_one_call) {
      world.SetStates(agents, states);
    } else {
      for (std::size_t i = 0; i < agents.size(); ++i) agents[i].SetState(states[i]);
    }
    world.Publish(0);
    written[in_one_call] = network_->written;
    EXPECT_EQ(world.traffic().states_set, 6u);
  }
  ASSERT_EQ(written[0].size(), written[1].size());
  for (std::size_t i = 0; i < written[0].size(); ++i) {
    EXPECT_EQ(written[0][i].SerializeAsString(), written[1][i].SerializeAsString()) << i;
  }
}

TEST_F(SetStatesTest, AreRefusedWithTheirNumber) {
  World world = ConnectTo(network_);
  std::vector<Agent> agents;
  for (int i = 0; i < 3; ++i) agents.push_back(world.AddAgent(Point(), At(0)));
  const auto complaint = [&](std::span<const Agent> whose, const std::vector<State>& states) {
    try {
      world.SetStates(whose, states);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  State bad = At(0, 2);
  bad.position_error_m = -1;
  EXPECT_EQ(
      complaint(agents, {At(0, 1), bad, At(0, 3)}).rfind("states[1]: position_error_m: -1", 0), 0u);
  EXPECT_EQ(complaint(agents, {At(0), At(0)}), "states: 2, allowed: one for each of the 3 agents");
  const auto network = std::make_shared<FakeNetwork>();
  World other = ConnectTo(network);
  const Agent foreign = other.AddAgent(Point(), At(0));
  const std::uint64_t set = world.traffic().states_set;
  EXPECT_EQ(complaint({&foreign, 1}, {At(0)}).rfind("agents[0]: of another World", 0), 0u);
  EXPECT_EQ(world.traffic().states_set, set);
}

}  // namespace
}  // namespace collision::client
