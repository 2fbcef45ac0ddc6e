// One long run whose every event is known: the same bits in every build, and after a replay.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "server/recording/replay/replay.h"
#include "tests/simulation/contact_checker.h"
#include "tests/simulation/scenario.h"
#include "tests/support/temporary_path.h"

namespace collision::server {
namespace {

/// Changes with the detector's answers, and only then: when it does, say why in the change that
/// does it.
constexpr std::uint64_t kGoldenHash = 0x43b463d0ea575865;

constexpr std::int64_t kEnd = 40 * kSecond;

void RunGolden(Scenario* scenario, BatchSink* recorder) {
  AddCrowds(kEnd, scenario);
  scenario->StartService(recorder);
  scenario->StartSimulators();
  scenario->Run();
}

// Goal:   the event log has at least twenty events of each kind, is true, and is the same, bit
//         for bit, in every build type, in a second run, and when its recording is replayed.
TEST(Golden, TheEventLogIsTheSameEverywhere) {
  const v1::Config config = ConfigFor(2);
  const std::string file = TemporaryPath("golden.recording");
  std::uint64_t hash = 0;
  {
    Scenario scenario(config, Lossy(5));
    RecordingWriter recorder(file, config);
    RunGolden(&scenario, &recorder);
    for (const SimulatedSimulator* simulator : scenario.simulators()) {
      EXPECT_TRUE(simulator->finished());
      EXPECT_FALSE(simulator->grant_withdrawn());
    }
    const std::vector<int> counts = CountStatuses(scenario.published());
    for (int status = 0; status < v1::EventStatus_ARRAYSIZE; ++status) {
      EXPECT_GE(counts[status], 20) << v1::EventStatus_Name(static_cast<v1::EventStatus>(status));
    }
    const CheckerResult result = CheckContacts(scenario.simulators(), scenario.published(), kEnd);
    EXPECT_TRUE(result.violations.empty())
        << result.violations.size() << " violations, the first: " << result.violations.front();
    hash = scenario.daemon().event_log().hash();
    EXPECT_EQ(hash, kGoldenHash);
  }
  Scenario again(config, Lossy(5));
  RunGolden(&again, nullptr);
  EXPECT_EQ(again.daemon().event_log().hash(), hash);

  RecordingReader reader(file);
  ReplaySource source(reader);
  Daemon replayed(reader.config(), source, source, {.claim = reader.claim()});
  while (replayed.Step()) {
  }
  EXPECT_TRUE(reader.error().empty()) << reader.error();
  EXPECT_EQ(replayed.event_log().hash(), hash);
}

}  // namespace
}  // namespace collision::server
