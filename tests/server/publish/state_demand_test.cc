// Goal:   a state is requested when it can still make an answer better, and never after the moment
//         at which the answer would be given without it.
// Method: one clearance, moved along the time axis; a century; the published sample.
#include "server/publish/state_demand.h"

#include <gtest/gtest.h>

#include "collision_core/numeric/seconds.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Instant At(double seconds) { return numeric::AddRoundedDown(Instant(), seconds); }

StateDemand Demand() {
  v1::Config config;
  config.set_announce_within_s(2);
  config.set_temporal_resolution_s(0.1);
  return StateDemand(config, config.announce_within_s());
}

double Wanted(double clear_until, double stamp, double now) {
  return static_cast<double>(Demand()
                                 .WantedAt({.clear_until = At(clear_until)}, At(stamp), At(now))
                                 .nanoseconds()) *
         1e-9;
}

TEST(StateDemand, AFarAgentIsWantedJustBeforeTheDetectorAsksAgain) {
  EXPECT_DOUBLE_EQ(Wanted(12.5, 9, 10), 10.5);
  EXPECT_DOUBLE_EQ(Wanted(100, 9, 10), 98);
  EXPECT_TRUE(Demand().WantedAt({}, At(9), At(10)).is_never());
}

// The state that was sent just before the detector asks again is the one it needs.
TEST(StateDemand, AFarAgentWithAFreshStateIsNotAskedForAnother) {
  EXPECT_DOUBLE_EQ(Wanted(12.5, 10.25, 10.25), 10.5) << "stale before the detector asks";
  EXPECT_DOUBLE_EQ(Wanted(12.5, 10.375, 10.375), 10.625) << "fresh when it asks";
}

TEST(StateDemand, ANearAgentIsWantedHalfWayToItsClearance) {
  EXPECT_DOUBLE_EQ(Wanted(12, 10, 10), 11);
  EXPECT_DOUBLE_EQ(Wanted(12, 11, 11), 11.5);
  EXPECT_DOUBLE_EQ(Wanted(12, 6, 10.5), 9);  // long due
}

TEST(StateDemand, AnAgentAtHandIsWantedAtEveryStep) {
  const Instant now = At(10);
  EXPECT_DOUBLE_EQ(Wanted(10.2, 10, 10), 10);
  EXPECT_DOUBLE_EQ(Wanted(10.21, 10, 10), 10.105);
  EXPECT_DOUBLE_EQ(Wanted(3, 10, 10), 10);
  EXPECT_EQ(Demand().WantedAt({.in_contact = true}, At(9), now), now);
  EXPECT_EQ(Demand().WantedAt({.clear_until = now, .saturated = true}, At(9), now), now);
}

// The first meeting is announced already; the next one may be soon.
TEST(StateDemand, AStaleAgentIsWantedBeforeOthersAreAnnounced) {
  const auto wanted = [](double stamp, double clear, double unannounced) {
    const detection::AgentClearance clearance{.clear_until = At(clear),
                                              .unannounced_until = At(unannounced)};
    return Demand().WantedAt(clearance, At(stamp), At(10));
  };
  EXPECT_EQ(wanted(9.75, 11, 12.5), At(10.375)) << "half-way to the first comes before";
  EXPECT_EQ(wanted(9.5, 11.75, 12.5), At(10.5)) << "as the detector asks";
  EXPECT_EQ(wanted(9.75, 11.75, 12), At(10)) << "as it asks, at once";
  EXPECT_EQ(wanted(10, 11.75, 12.125), At(10.25)) << "still fresh when it asks";
}

// One state newer than the end of a contact narrows its event; more states do not.
TEST(StateDemand, OneStateIsWantedAfterAContact) {
  const detection::AgentClearance clearance{.clear_until = At(100), .unsettled_until = At(9.5)};
  EXPECT_EQ(Demand().WantedAt(clearance, At(9.25), At(10)), At(10));
  EXPECT_EQ(Demand().WantedAt(clearance, At(9.5), At(10)), At(98));
}

// A century lies between the two stamps; their sum fits in no 64 bits.
TEST(StateDemand, ExtremesAreDecided) {
  const Instant first = Instant::FromNanoseconds(-(std::int64_t{1} << 62));
  const Instant last = Instant::FromNanoseconds(std::int64_t{1} << 62);
  EXPECT_EQ(Demand()
                .WantedAt({.clear_until = last}, first, numeric::AddRoundedDown(last, -1))
                .nanoseconds(),
            0);
  EXPECT_EQ(Demand().WantedAt({.clear_until = last}, first, first),
            numeric::AddRoundedDown(last, -2));
}

// In the sample as published: two agents 100 m apart with M = 2 m/s² meet after 7.07 s less their
// radii; the service queries again at clear_until less announce_within.
TEST(StateDemand, IsPublishedWithTheClearance) {
  v1::Config config;
  config.set_announce_within_s(1.5);
  ScriptedDaemon daemon(config);
  daemon.Step(AlphaJoins(1));
  const v1::Clearance clearance = daemon.clearance(SimulatorId("alpha"));
  ASSERT_EQ(clearance.agents_size(), 2);
  for (const v1::AgentClearance& agent : clearance.agents()) {
    EXPECT_GT(agent.clear_until_ns(), 6 * kSecond);
    EXPECT_EQ(agent.state_wanted_ns(), agent.clear_until_ns() - 3 * kSecond / 2);
  }
}

}  // namespace
}  // namespace collision::server
