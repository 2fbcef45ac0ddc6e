// Goal:   a simulator whose clock is off by more than the bound is refused and named, and what was
//         promised about its agents is void; one within the bound is served; nobody is accused for
//         slow ways.
// Method: alpha, whose clock is the service's, and beta, whose clock is off by what the test says.
//         Both answer each sample of the service.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "server/process/logging.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"
#include "tests/support/temporary_path.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kStepNs = 20 * kMillisecond;
constexpr std::int64_t kSkewNs = 2 * kMillisecond;

v1::Config Wall() {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.mutable_clock()->set_skew_max_s(1e-9 * kSkewNs);
  return config;
}

class ClockSkewTest : public testing::Test {
 protected:
  ClockSkewTest() : daemon_(Wall()) { daemon_.Step({}); }

  /// Alpha stays at 0; beta comes from 60 m at 6 m/s: they touch after 9.67 s.
  v1::Input StateOf(const std::string& name, std::int64_t now_ns) {
    v1::AgentState state = State(0, now_ns + offset_ns_[name], ++sequence_);
    const double elapsed_s = 1e-9 * static_cast<double>(now_ns - start_ns_);
    state.mutable_position_m()->set_x(name == "alpha" ? 0 : 60 - 6 * elapsed_s);
    state.mutable_velocity_m_s()->set_x(name == "alpha" ? 0 : -6);
    return From(SimulatorId(name), state, name);
  }

  /// Its clock, which answers the newest sample of the service.
  v1::Input ClockAt(const std::string& name, std::int64_t now_ns) {
    v1::SimulatorClock clock = ClockAfter(name, now_ns + offset_ns_[name], sequence_, 1);
    clock.set_lock_step(false);
    const v1::ServiceStatus status = Asked();
    clock.set_service_id(status.stamp().service_id());
    clock.set_epoch(status.stamp().epoch());
    clock.set_echo_ns(echoes_ ? status.now_ns() : kNeverNs);
    clock.set_heard_ns(status.now_ns() + there_ns_ + offset_ns_[name]);
    clock.set_sent_ns(now_ns - back_ns_ + offset_ns_[name]);
    return From(SimulatorId(name), clock);
  }

  v1::ServiceStatus Asked() {
    for (auto output = daemon_.bus().outputs.rbegin(); output != daemon_.bus().outputs.rend();
         ++output) {
      if (output->has_service_status()) return output->service_status();
    }
    throw std::logic_error("no status");
  }

  void Tell(bool with_descriptions = false) {
    daemon_.bus().Pass(kStepNs);
    std::vector<v1::Input> inputs;
    for (const char* name : {"alpha", "beta"}) {
      if (with_descriptions) inputs.push_back(From(SimulatorId(name), Description(name, 0)));
      inputs.push_back(StateOf(name, daemon_.bus().wall_ns));
      inputs.push_back(ClockAt(name, daemon_.bus().wall_ns));
    }
    daemon_.Step(inputs);
  }
  void TellFor(std::int64_t ns) {
    for (std::int64_t passed = 0; passed < ns; passed += kStepNs) Tell();
  }

  v1::AgentClearance ClearanceOf(const std::string& name) const {
    return daemon_.clearance(SimulatorId(name)).agents(0);
  }
  /// The first clearance of this simulator that tells of a wrong clock.
  v1::AgentClearance VoidedOf(const std::string& name) {
    for (const v1::Output& output : daemon_.bus().outputs) {
      if (!output.has_clearance()) continue;
      if (output.clearance().simulator_id() != SimulatorId(name)) continue;
      for (const v1::AgentClearance& agent : output.clearance().agents()) {
        if (agent.cause() == v1::CAUSE_SKEW) return agent;
      }
    }
    throw std::logic_error("no clearance is void");
  }
  bool IsRefused(const std::string& name) {
    for (const v1::Rejection& rejection : daemon_.rejections()) {
      const bool is_it = rejection.simulator_id() == SimulatorId(name);
      if (is_it && rejection.reason() == v1::REJECTED_CLOCK_SKEW) return true;
    }
    return false;
  }
  std::uint64_t Confirmed() { return daemon_.counter("events_confirmed"); }
  v1::TimeBracket OffsetOf(const std::string& name) {
    const v1::ServiceStatus status = daemon_.status();
    for (const v1::SimulatorStatus& simulator : status.simulators()) {
      if (simulator.name() == name) return simulator.clock_offset();
    }
    throw std::logic_error("no simulator " + name);
  }

  ScriptedDaemon daemon_;
  std::int64_t start_ns_ = daemon_.bus().wall_ns;
  std::map<std::string, std::int64_t> offset_ns_;
  std::int64_t there_ns_ = kMillisecond / 5;
  std::int64_t back_ns_ = kMillisecond / 5;
  bool echoes_ = true;
  std::uint64_t sequence_ = 0;
};

TEST_F(ClockSkewTest, ASenderFarBehindIsRefusedAndNothingIsCertifiedFromItsStates) {
  offset_ns_["beta"] = -5 * kSecond;
  Tell(true);
  TellFor(11 * kSecond);
  EXPECT_EQ(Confirmed(), 0u) << "its states put the contact seconds beside the truth";
  ASSERT_FALSE(daemon_.rejections().empty());
  const v1::Rejection rejection = daemon_.rejections().back();
  EXPECT_EQ(rejection.reason(), v1::REJECTED_CLOCK_SKEW);
  EXPECT_EQ(rejection.simulator_id(), SimulatorId("beta"));
  EXPECT_NE(rejection.detail().find("ms behind; allowed: 2 ms. Synchronise it, or set "
                                    "clock.skew_max_s to 5.001 or more"),
            std::string::npos)
      << rejection.detail();
  EXPECT_GT(daemon_.counter("rejected_clock_skew"), 500u);
}

TEST_F(ClockSkewTest, PromisesAboutItsAgentsAreVoidForBothAndItsCulpritIsNamed) {
  offset_ns_["beta"] = -5 * kSecond;
  echoes_ = false;  // so that nothing is known yet
  Tell(true);
  ASSERT_FALSE(ClearanceOf("beta").not_clear());
  echoes_ = true;
  Tell();
  for (const char* name : {"alpha", "beta"}) {
    const v1::AgentClearance voided = VoidedOf(name);
    EXPECT_EQ(voided.cause_agent().simulator_id(), SimulatorId("beta"));
    EXPECT_EQ(voided.void_from_ns(), std::numeric_limits<std::int64_t>::min())
        << "it was never known to be right";
  }
  EXPECT_TRUE(ClearanceOf("beta").not_clear());
  EXPECT_FALSE(ClearanceOf("alpha").not_clear());
}

TEST_F(ClockSkewTest, TheLogNamesEachAndSaysWhatToDo) {
  const std::string path = TemporaryPath("clock_skew_test.log");
  StartLogging({.level = "info", .file = path});
  offset_ns_["alpha"] = offset_ns_["beta"] = -5 * kSecond;
  Tell(true);
  TellFor(3 * kSecond);
  EndLogging();
  StartLogging({.level = "info"});
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::remove(path.c_str());
  for (const char* part :
       {"refuses simulator \"alpha\", \"beta\": ", "set clock.skew_max_s higher"}) {
    EXPECT_NE(text.str().find(part), std::string::npos) << part << text.str();
  }
}

TEST_F(ClockSkewTest, OneWithinTheBoundIsServed) {
  for (const std::int64_t offset_ns : {kSkewNs * 9 / 10, -kSkewNs * 9 / 10}) {
    offset_ns_["beta"] = offset_ns;
    Tell(true);
    TellFor(kSecond);
  }
  TellFor(9 * kSecond);
  EXPECT_TRUE(daemon_.rejections().empty());
  EXPECT_EQ(Confirmed(), 1u);
  const v1::TimeBracket offset = OffsetOf("beta");
  EXPECT_LE(offset.earliest_ns(), offset_ns_["beta"]);
  EXPECT_GE(offset.latest_ns(), offset_ns_["beta"]);
}

TEST_F(ClockSkewTest, SlowWaysInEitherDirectionAccuseNobody) {
  Tell(true);
  there_ns_ = 19 * kMillisecond;
  TellFor(kSecond);
  std::swap(there_ns_, back_ns_);
  TellFor(kSecond);
  EXPECT_TRUE(daemon_.rejections().empty());
  EXPECT_EQ(daemon_.status().agents(), 2u);
}

TEST_F(ClockSkewTest, AClockThatIsSetWrongVoidsSinceItWasLastRightAndIsTakenAgain) {
  Tell(true);
  TellFor(2 * kSecond);
  ASSERT_TRUE(daemon_.rejections().empty());
  const std::int64_t right_ns = daemon_.bus().wall_ns;
  offset_ns_["beta"] = -5 * kSecond;
  TellFor(kSecond);
  EXPECT_TRUE(IsRefused("beta"));
  EXPECT_LE(VoidedOf("alpha").void_from_ns(), right_ns);
  EXPECT_GE(VoidedOf("alpha").void_from_ns(), right_ns - kSecond) << "a period of the status";
  offset_ns_["beta"] = 0;
  TellFor(kSecond);
  EXPECT_EQ(ClearanceOf("beta").not_clear(), false);
  const std::uint64_t refused = daemon_.counter("rejected_clock_skew");
  TellFor(8 * kSecond);
  EXPECT_EQ(Confirmed(), 1u);
  EXPECT_EQ(daemon_.counter("rejected_clock_skew"), refused);
  EXPECT_EQ(daemon_.counter("breaches"), 0u);
}

TEST_F(ClockSkewTest, WithoutAnEchoOnlyAClockAheadShows) {
  echoes_ = false;
  offset_ns_["beta"] = 5 * kSecond;
  Tell(true);
  TellFor(kSecond);
  EXPECT_TRUE(IsRefused("beta"));
  EXPECT_FALSE(IsRefused("alpha"));
  EXPECT_EQ(OffsetOf("beta").latest_ns(), kNeverNs);
  EXPECT_EQ(daemon_.status().agents(), 1u);
}

// Its own clock was set, to where beta's clock had been all the time.
TEST_F(ClockSkewTest, WhenTheServicesOwnClockWasWrongNobodyStaysRefused) {
  offset_ns_["alpha"] = offset_ns_["beta"] = 5 * kSecond;
  Tell(true);
  Tell();
  EXPECT_EQ(daemon_.status().agents(), 0u);
  daemon_.bus().wall_ns += 5 * kSecond;
  start_ns_ += 5 * kSecond;
  offset_ns_["alpha"] = offset_ns_["beta"] = 0;
  daemon_.status();
  TellFor(kSecond);
  EXPECT_EQ(daemon_.status().agents(), 2u);
  const std::uint64_t refused = daemon_.counter("rejected_clock_skew");
  TellFor(kSecond);
  EXPECT_EQ(daemon_.counter("rejected_clock_skew"), refused);
}

}  // namespace
}  // namespace collision::server
