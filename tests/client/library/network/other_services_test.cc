// Goal:   a service that comes into force late is known by all that it said before: to a simulator,
//         which would else wait for its grant for ever, and to a monitor.
#include <gtest/gtest.h>

#include "client/library/network/current_service.h"
#include "client/library/network/message_monitor.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

using namespace std::chrono_literals;

constexpr OtherServices::Time kNow{std::chrono::hours(1)};

v1::Output ClearanceOf(std::uint64_t service, std::uint32_t chunk, std::uint64_t sequence) {
  v1::Output output;
  output.mutable_clearance()->set_chunk(chunk);
  output.mutable_clearance()->mutable_stamp()->set_service_id(service);
  output.mutable_clearance()->mutable_stamp()->set_sequence(sequence);
  return output;
}

v1::Output ContactOf(std::uint64_t service, std::uint64_t sequence) {
  v1::Output output;
  *output.mutable_collision_event() = OwnEvent(1, 1, sequence);
  output.mutable_collision_event()->mutable_stamp()->set_service_id(service);
  output.mutable_collision_event()->set_contacts_sequence(sequence);
  output.mutable_collision_event()->set_status(v1::EVENT_CONFIRMED);
  return output;
}

TEST(OtherServices, TheNewestOfEachInstanceIsKeptInItsOrder) {
  OtherServices others;
  others.Keep(ClearanceOf(2, 1, 5), kNow);
  others.Keep(ClearanceOf(2, 0, 6), kNow);
  others.Keep(ContactOf(2, 7), kNow);
  others.Keep(ContactOf(2, 8), kNow);
  others.Keep(ClearanceOf(2, 1, 9), kNow);
  others.Keep(ClearanceOf(3, 1, 1), kNow);
  const std::vector<v1::Output> said = others.Take(2, kNow);
  ASSERT_EQ(said.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(StampOf(said[i]).sequence(), 6 + i);
  EXPECT_TRUE(others.Take(2, kNow).empty());
  EXPECT_EQ(others.Take(3, kNow).size(), 1u);
}

TEST(OtherServices, WhatASilentOneSaidIsForgotten) {
  OtherServices others;
  others.Keep(ClearanceOf(2, 0, 1), kNow);
  EXPECT_TRUE(others.IsHeard(kNow + kServiceSilence - 1ns));
  EXPECT_FALSE(others.IsHeard(kNow + kServiceSilence));
  EXPECT_TRUE(others.Take(2, kNow + OtherServices::kForgottenAfter).empty());
  others.Keep(ClearanceOf(2, 0, 1), kNow);
  others.Keep(ClearanceOf(2, 1, 2), kNow + OtherServices::kForgottenAfter);
  EXPECT_EQ(others.Take(2, kNow + OtherServices::kForgottenAfter).size(), 1u);
}

TEST(OtherServices, IsBounded) {
  OtherServices others;
  for (std::uint64_t i = 1; i <= OtherServices::kContactsMax + 1; ++i)
    others.Keep(ContactOf(1, i), kNow);
  for (std::uint64_t id = 1; id <= OtherServices::kServicesMax; ++id) {
    others.Keep(ClearanceOf(id, 0, 10'000), kNow);
  }
  EXPECT_EQ(others.Take(2, kNow).size(), 1u);
  EXPECT_EQ(others.Take(1, kNow).size(), OtherServices::kContactsMax + 1);
  for (std::uint64_t id = 11; id <= 11 + OtherServices::kServicesMax; ++id) {
    others.Keep(ClearanceOf(id, 0, 1), kNow + std::chrono::milliseconds(id));
  }
  EXPECT_TRUE(others.Take(11, kNow).empty()) << "heard longest ago";
  EXPECT_FALSE(others.Take(12, kNow).empty());
}

/// Virtual time, which the test sets.
class TimedTransport : public FakeTransport {
 public:
  TimedTransport(std::shared_ptr<FakeNetwork> network, const std::chrono::nanoseconds* now)
      : FakeTransport(std::move(network)), now_(*now) {}
  std::chrono::steady_clock::time_point Now() const override {
    return std::chrono::steady_clock::time_point(now_);
  }

 private:
  const std::chrono::nanoseconds& now_;
};

class OtherServicesTest : public testing::Test {
 protected:
  auto Transport() { return std::make_unique<TimedTransport>(network_, &now_); }

  World Connect() {
    return World::Connect({.simulator = kSimulator, .run = kRun, .incarnation = kIncarnation},
                          Transport());
  }

  void Say(std::uint64_t service, std::uint32_t term = 1, bool followed = true) {
    v1::ServiceStatus& status = *network_->arriving.emplace_back().mutable_service_status();
    status.set_phase(v1::PHASE_SERVING);
    status.mutable_stamp()->set_service_id(service);
    status.mutable_stamp()->set_term(term);
    status.mutable_stamp()->set_sequence(100);
    status.set_followers(followed ? 1 : 0);
  }

  void End(std::uint64_t service) {
    v1::ServiceHeard& heard = *network_->heard.emplace_back().mutable_service_heard();
    heard.set_service_id(service);
    heard.set_ended(true);
  }

  const std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  std::chrono::nanoseconds now_ = 100s;
};

// The service is started again at once, in the same term, with a higher id: the one before it is in
// force until it has been silent for 2 s.
TEST_F(OtherServicesTest, AGrantOfTheNextServiceCountsWhenThatComesIntoForce) {
  World world = Connect();
  Say(1);
  EXPECT_EQ(world.AdvanceTo(0, 0ns), Advance::kReached);
  now_ += 1s;
  network_->Grant(5);
  network_->arriving.back().mutable_clearance()->mutable_stamp()->set_service_id(2);
  world.Poll();
  EXPECT_NE(world.granted_until_ns(), 5);
  now_ += 2s;
  Say(2);
  world.Poll();
  EXPECT_EQ(world.granted_until_ns(), 5);
}

TEST_F(OtherServicesTest, AMonitorHearsTheContactsOfTheNextService) {
  std::size_t events = 0;
  MessageMonitor::Callbacks callbacks;
  callbacks.event = [&events](const v1::CollisionEvent&) { ++events; };
  MessageMonitor monitor(Transport(), callbacks);
  Say(1);
  monitor.Poll(0ns);
  now_ += 1s;
  network_->arriving.push_back(ContactOf(2, 1));
  network_->arriving.back().mutable_collision_event()->mutable_stamp()->set_term(1);
  monitor.Poll(0ns);
  EXPECT_EQ(events, 0u);
  now_ += 2s;
  Say(2);
  monitor.Poll(0ns);
  EXPECT_EQ(events, 1u);
}

// The standby has taken over, and says nothing but its status until a simulator follows it.
TEST_F(OtherServicesTest, AStandbyIsFollowedAsSoonAsTheServiceBeforeItHasEnded) {
  World world = Connect();
  Say(1);
  EXPECT_EQ(world.AdvanceTo(0, 0ns), Advance::kReached);
  world.AdvanceTo(1, 0ns);
  ASSERT_FALSE(network_->Clocks().empty());
  Say(2, 2, false);
  world.Poll();
  EXPECT_EQ(network_->Clocks().back().service_id(), 1u);
  End(1);
  world.Poll();
  EXPECT_EQ(network_->Clocks().back().service_id(), 2u) << "at once: its status has come before";
  EXPECT_EQ(network_->Clocks().back().service_term(), 2u);
}

}  // namespace
}  // namespace collision::client
