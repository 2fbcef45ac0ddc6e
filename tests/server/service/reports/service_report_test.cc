// Goal:   the log names each other service when it comes, goes or is configured otherwise, once,
//         and says why this one takes over.
// Method: what is logged, from statuses by hand.
#include "server/service/reports/service_report.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/claim/service_claim.h"
#include "server/config/config.h"
#include "server/config/config_digest.h"
#include "tests/server/captured_log.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

v1::ServiceHeard Heard(std::uint64_t id, v1::ServicePhase phase, std::uint64_t configuration = 0) {
  v1::ServiceHeard heard;
  heard.set_service_id(id);
  heard.set_term(3);
  heard.set_phase(phase);
  heard.set_version("0.2.0");
  heard.set_process("pid 12 on host-a");
  heard.set_configuration(configuration);
  return heard;
}

v1::ServiceHeard Ended(std::uint64_t id) {
  v1::ServiceHeard heard;
  heard.set_service_id(id);
  heard.set_ended(true);
  return heard;
}

constexpr const char* kName = "service 00000000000000ab (pid 12 on host-a, version 0.2.0), term 3";

TEST(ServiceReport, OthersAreNamedWhenTheyComeAndWhenTheyGo) {
  CapturedLog log;
  ServiceReport report(CompleteConfig({}), 1, "");
  const auto logged = [&](const v1::ServiceHeard& heard, std::int64_t seconds) {
    report.Hear(heard, seconds * kSecond);
    report.Write({}, seconds * kSecond);
    return log.Take();
  };
  const std::string name = "info \"" + std::string(kName) + "\" ";
  EXPECT_EQ(logged(Heard(1, v1::PHASE_SERVING), 0), "") << "its own status";
  EXPECT_EQ(logged(Heard(0xab, v1::PHASE_CLAIMING), 1), "");
  EXPECT_EQ(logged(Heard(0xab, v1::PHASE_STANDBY), 2),
            name + "has become a standby in this world\n");
  EXPECT_EQ(logged(Heard(0xab, v1::PHASE_STANDBY), 3), "");
  EXPECT_EQ(logged(Heard(0xab, v1::PHASE_SERVING), 4), name + "serves this world\n");
  EXPECT_EQ(logged(Ended(0xcd), 5), "") << "it was never heard";
  EXPECT_EQ(logged(Ended(0xab), 6),
            name + "is gone: it has ended, or was not heard for its lease\n");
  EXPECT_EQ(logged(Ended(0xab), 7), "");
  EXPECT_EQ(logged(Heard(0xab, v1::PHASE_STANDBY), 8),
            name + "has become a standby in this world\n")
      << "back again";
}

TEST(ServiceReport, OfTooManyServicesTheFirstAreNamed) {
  CapturedLog log;
  ServiceReport report(CompleteConfig({}), 1, "");
  for (std::uint64_t id = 2; id < 100; ++id) report.Hear(Heard(id, v1::PHASE_STANDBY), 0);
  report.Write({}, 0);
  const std::string text = log.Take();
  std::size_t named = 0;
  for (std::size_t at = text.find("pid"); at != text.npos; at = text.find("pid", at + 1)) ++named;
  EXPECT_EQ(named, kOthersMax);
}

TEST(ServiceReport, ATakeOverSaysFromWhomAndHowLongThatWasSilent) {
  CapturedLog log;
  ServiceReport report(CompleteConfig({}), 1, "");
  report.LogTakeOver(0);
  EXPECT_EQ(log.Take(), "info takes over: no service serves this world\n");
  report.Hear(Heard(0xab, v1::PHASE_SERVING), 5 * kSecond);
  report.Hear(Ended(0xab), 6 * kSecond);
  log.Take();
  report.LogTakeOver(7 * kSecond);
  const std::string why = "info takes over from " + std::string(kName) +
                          ": it has ended, or was not heard for its lease; its last status came "
                          "2.00 s ago\n";
  EXPECT_EQ(log.Take(), why +
                            "warning was not ready to take over: what the other one had not told "
                            "may be lost\n");
  report.HearProgress(Heard(0xab, v1::PHASE_SERVING), 0, Instant());
  log.Take();
  report.LogTakeOver(7 * kSecond);
  EXPECT_EQ(log.Take(), why);
}

TEST(ServiceReport, OneThatIsConfiguredOtherwiseIsNamedOnce) {
  CapturedLog log;
  const v1::Config config = CompleteConfig({});
  ServiceReport report(config, 1, "");
  report.Hear(Heard(2, v1::PHASE_SERVING, ConfigurationDigest(config)), 0);
  report.Hear(Heard(3, v1::PHASE_STANDBY), 0);
  report.Write({}, 0);
  log.Take();
  for (int i = 1; i <= 3; ++i) {
    report.Hear(Heard(0xab, v1::PHASE_SERVING, 77), i * kSecond);
    report.Write({}, i * kSecond);
  }
  const std::string text = log.Take();
  EXPECT_NE(text.find("warning \"" + std::string(kName) + "\" is configured otherwise: "),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("otherwise"), text.rfind("otherwise")) << text;
}

TEST(ServiceReport, TheStatusSaysWhereItRunsAndHowLongItsLeaseIs) {
  v1::Config config;
  config.set_lease_s(0.25);
  ServiceReport report(CompleteConfig(config), 1, "pid 7 on here");
  std::vector<v1::KeyValue> extensions;
  report.AddExtensions(false, &extensions);
  ASSERT_EQ(extensions.size(), 2u);
  EXPECT_EQ(extensions[0].key() + " " + extensions[0].value(), "process pid 7 on here");
  EXPECT_EQ(extensions[1].key() + " " + extensions[1].value(), "lease_s 0.25");
}

// A standby that joins has the newest state of each agent, and nothing of what came before.
TEST(ServiceReport, AStandbyIsReadyOnceTheOtherOneHasToldAllThatIsOlderThanWhatItKnows) {
  ServiceReport report(CompleteConfig({}), 1, "");
  v1::ServiceHeard heard;
  heard.set_service_id(2);
  heard.set_agents(3);
  const auto hear = [&](std::int64_t now_ns, std::size_t agents, std::int64_t newest_ns) {
    heard.set_now_ns(now_ns);
    return report.HearProgress(heard, agents, Instant::FromNanoseconds(newest_ns));
  };
  const auto standby = [&] {
    std::vector<v1::KeyValue> extensions;
    report.AddExtensions(true, &extensions);
    return extensions.back().value();
  };
  EXPECT_FALSE(hear(9 * kSecond, 2, kSecond)) << "an agent is missing";
  EXPECT_FALSE(hear(kSecond - 1, 3, kSecond)) << "what is older than 1 s only that one may know";
  EXPECT_EQ(standby(), "not ready yet");
  EXPECT_TRUE(hear(kSecond, 3, 5 * kSecond)) << "what came since both have";
  EXPECT_EQ(standby(), "ready");
  EXPECT_FALSE(hear(2 * kSecond, 1, 5 * kSecond)) << "it is said once";
}

}  // namespace
}  // namespace collision::server
