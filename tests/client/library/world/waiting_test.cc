// Goal:   a simulator hears whom the world's time waits for, each change once, inside its own
//         calls.
// Method: statuses on a network under the test's control.
#include <gtest/gtest.h>

#include <stdexcept>

#include "client/library/world/waiting_list.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

using Names = std::vector<std::string>;

v1::ServiceStatus StatusOf(const std::string& waiting_for) {
  v1::ServiceStatus status;
  status.mutable_stamp()->set_service_id(1);
  status.mutable_stamp()->set_term(1);
  status.set_phase(v1::PHASE_SERVING);
  status.add_extensions()->set_key("event_log_hash");
  if (waiting_for.empty()) return status;
  v1::KeyValue* extension = status.add_extensions();
  extension->set_key("waiting_for");
  extension->set_value(waiting_for);
  return status;
}

TEST(WaitingList, ReadsNamesAndNothingElse) {
  WaitingList list(SimulatorId(kSimulator));
  EXPECT_FALSE(list.TakeChange());
  list.Take(StatusOf("alpha, beta-2, shape 1a2b3c4d, +7 more"));
  EXPECT_EQ(list.names(), (Names{"alpha", "beta-2", "shape 1a2b3c4d"}));
  EXPECT_TRUE(list.TakeChange());
  EXPECT_FALSE(list.TakeChange());
  for (const char* odd : {",", ", ", "+1 more", "a b", ", , "}) {
    list.Take(StatusOf(odd));
    EXPECT_TRUE(list.names().empty()) << odd;
  }
}

class WaitingTest : public testing::Test {
 protected:
  void Arrive(const std::string& waiting_for, v1::ServicePhase phase = v1::PHASE_SERVING) {
    v1::ServiceStatus status = StatusOf(waiting_for);
    status.set_phase(phase);
    *network_->arriving.emplace_back().mutable_service_status() = status;
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  World world_ = ConnectTo(network_);
};

TEST_F(WaitingTest, EachChangeIsToldOnceAndTheEndOfWaitingToo) {
  std::vector<Names> told;
  world_.OnWaiting([&](const Names& names) { told.push_back(names); });
  Arrive("");
  world_.Poll();
  EXPECT_TRUE(told.empty());
  for (const char* waiting_for : {"beta", "beta", "beta, gamma", "", ""}) {
    Arrive(waiting_for);
    world_.Poll();
  }
  EXPECT_EQ(told, (std::vector<Names>{{"beta"}, {"beta", "gamma"}, {}}));
}

TEST_F(WaitingTest, ACallbackThatIsSetLateHearsWhatIsTheCaseNow) {
  Arrive("beta");
  world_.Poll();
  std::vector<Names> told;
  world_.OnWaiting([&](const Names& names) { told.push_back(names); });
  world_.Poll();
  EXPECT_EQ(told, (std::vector<Names>{{"beta"}}));
}

TEST_F(WaitingTest, AServiceThatClaimsTellsNothing) {
  std::vector<Names> told;
  world_.OnWaiting([&](const Names& names) { told.push_back(names); });
  Arrive("beta", v1::PHASE_CLAIMING);
  world_.Poll();
  EXPECT_TRUE(told.empty());
}

TEST_F(WaitingTest, ACallbackMayNotWaitItself) {
  world_.OnWaiting([&](const Names&) { EXPECT_THROW(world_.Poll(), std::logic_error); });
  Arrive("beta");
  world_.Poll();
}

}  // namespace
}  // namespace collision::client
