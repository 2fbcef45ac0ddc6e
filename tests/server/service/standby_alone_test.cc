// Goal:   what a service does in place of another one, or beside it, does not depend on simulators.
// Method: the statuses of another service by hand, and hardly any simulator.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "tests/server/service/voyage.h"
#include "tests/support/temporary_path.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

v1::Config Wall() {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.mutable_clock()->set_remove_silent_after_s(30);
  return config;
}

DaemonParts Standby() {
  DaemonParts parts;
  parts.claim = {.instance = 2, .stands_by = true, .waking_ns = 10 * kSecond};
  return parts;
}

/// The status of another service, which serves.
v1::Input Serving() {
  v1::Input heard;
  heard.mutable_service_heard()->set_service_id(1);
  heard.mutable_service_heard()->set_term(1);
  heard.mutable_service_heard()->set_phase(v1::PHASE_SERVING);
  return heard;
}

// Goal:   the journal is opened, and has the term, though nobody is there to follow.
TEST(StandbyOfAQuietWorld, OpensTheJournalOnceTheOtherServiceHasLetGo) {
  const std::string folder = TemporaryPath("standby_of_a_quiet_world");
  std::filesystem::remove_all(folder);
  auto of_the_other = std::make_unique<Journal>(folder, "default", 0, 16);
  std::unique_ptr<Journal> own;
  DaemonParts parts{.claim = {.instance = 2, .stands_by = true}};
  parts.journal.open = [&] {
    return (own = std::make_unique<Journal>(folder, "default", 0, 16)).get();
  };
  ScriptedDaemon daemon(VoyageConfig(), std::move(parts));
  v1::Input heard = Serving();
  daemon.Step({heard});
  heard.mutable_service_heard()->set_ended(true);
  daemon.Step({heard}, 0.01);
  EXPECT_NE(Extension(daemon.status(), "state_failure"), "") << "it is awaited";
  of_the_other.reset();
  daemon.Step({}, 2);
  EXPECT_EQ(Extension(daemon.status(), "state_failure"), "");
  ASSERT_NE(own, nullptr);
  EXPECT_EQ(own->term(), 2u);
  std::filesystem::remove_all(folder);
}

// Goal:   simulators of the one kind of clock cannot go on with a service of the other one.
TEST(StandbyOnTheWallClock, NeverTakesOverFromASimulatedClock) {
  ScriptedDaemon daemon(Wall(), Standby());
  v1::Input heard = Serving();
  heard.mutable_service_heard()->set_simulated_clock(true);
  daemon.Step({heard});
  EXPECT_EQ(Extension(daemon.status(), "standby"), "never: the clocks are of two kinds");
  heard.mutable_service_heard()->set_ended(true);
  daemon.Step({heard}, 0.01);
  daemon.Pass(5);
  EXPECT_EQ(daemon.status().phase(), v1::PHASE_STANDBY);
}

// Goal:   a standby ends nobody's run because only its own network does not hear it.
TEST(StandbyOnTheWallClock, RemovesNobodyByItsOwnView) {
  ScriptedDaemon daemon(Wall(), Standby());
  v1::Input heard = Serving();
  daemon.Step({heard});
  daemon.Step(
      {From(1, Description("alpha", 0)), From(1, State(0, daemon.bus().wall_ns, 1), "alpha")},
      0.01);
  daemon.Step({Liveliness(1, "alpha", false)}, 0.01);
  daemon.Pass(40);
  EXPECT_EQ(daemon.status().agents(), 1u);
  daemon.Step({}, 0.001);
  EXPECT_GT(daemon.bus().timeout_ns, 0) << "nothing is due";
  heard.mutable_service_heard()->set_ended(true);
  daemon.Step({heard}, 0.01);
  EXPECT_EQ(daemon.status().agents(), 0u) << "it serves, and nobody else hears it";
}

// Goal:   a service that may have been replaced publishes nothing before it knows.
TEST(ServiceThatStoodStill, ListensBeforeItPublishes) {
  DaemonParts parts;
  parts.claim = {
      .instance = 2, .heard_for_ns = 2 * kSecond, .stands_by = true, .waking_ns = kSecond / 2};
  ScriptedDaemon daemon(VoyageConfig(), std::move(parts));
  const Voyage run;
  daemon.Step(run.Told(0), 0.01);
  ASSERT_EQ(daemon.daemon().claim().phase(), ClaimPhase::kServing);
  const std::size_t before = daemon.bus().outputs.size();
  daemon.Step(run.Told(1), 3);
  EXPECT_EQ(daemon.daemon().claim().phase(), ClaimPhase::kWaking);
  EXPECT_EQ(daemon.bus().outputs.size(), before);
  daemon.Step({}, 0.2);
  daemon.Step({}, 0.2);
  EXPECT_EQ(daemon.bus().outputs.size(), before);
  daemon.Step({}, 0.2);
  EXPECT_EQ(daemon.daemon().claim().phase(), ClaimPhase::kServing);
  EXPECT_GT(daemon.bus().outputs.size(), before);
}

}  // namespace
}  // namespace collision::server
