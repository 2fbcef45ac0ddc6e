// Goal:   after the verdict stands everything that a status tells: services, simulators, counters.
// Method: statuses by hand, through a monitor.
#include "client/programs/tools/collisionctl/status/status_details.h"

#include <gtest/gtest.h>

#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class StatusDetailsTest : public CollisionctlTest {};

bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(StatusDetailsTest, ShowsSimulatorsAndCounters) {
  v1::ServiceStatus* status = Status();
  status->set_pairs_tracked(3);
  status->set_broad_phase("all pairs");
  status->set_broad_phase_why("1 agent");
  status->add_left_out("rotation: every agent is a ball");
  status->add_left_out("a second line");
  v1::Counter* counter = status->add_counters();
  counter->set_name("rejected_not_finite");
  counter->set_value(2);
  const auto count = [status](const char* name, std::uint64_t value) {
    v1::Counter* added = status->add_counters();
    added->set_name(name);
    added->set_value(value);
  };
  count("queries_per_second", 56);
  count("queries", 789);
  count("queued", 12);
  count("updates_kept", 199);
  count("discontinuities", 0);
  count("breaches", 1);
  v1::SimulatorStatus* simulator = status->add_simulators();
  simulator->set_simulator_id(5);
  simulator->set_name("sim");
  simulator->set_run(7);
  simulator->set_alive(true);
  simulator->set_clock_ns(12'000'000'000);
  simulator->set_granted_until_ns(std::numeric_limits<std::int64_t>::min());
  simulator->set_agents(1);
  v1::EarliestIntersection* earliest = next_.outputs.emplace_back().mutable_earliest_intersection();
  earliest->set_found(true);
  earliest->set_earliest_ns(13'000'000'999);
  earliest->mutable_lower()->set_simulator_id(5);
  earliest->mutable_lower()->set_run(7);
  earliest->mutable_lower()->set_generation(1);
  earliest->mutable_higher()->set_simulator_id(6);
  earliest->mutable_higher()->set_slot(4);
  Describe("ball", 7, 0);
  EXPECT_FALSE(view_.knows_all_agents());
  Poll(3);
  EXPECT_TRUE(view_.knows_all_agents());
  EXPECT_EQ(
      StatusDetails(view_),
      "WELL: time is not held up, nothing has failed, nothing is refused; but agents broke "
      "what they declare, 1 time: collisionctl agents\n"
      "\n"
      "ROLE    SERVICE           PROCESS  VERSION  TERM  LEASE  AGENTS  NOW       CONFIGURATION\n"
      "serves  0000000000000001  -        0.1.0    2     -      1       12.345 s  -\n"
      "\n"
      "world        lab\n"
      "clock        lock-step\n"
      "now          12.345 s\n"
      "agents       1, 3 pairs tracked\n"
      "earliest     not before 13.000000 s  ball × 0000000000000006:4\n"
      "broad phase  all pairs: 1 agent\n"
      "queries      56 a second, 789 so far; 12 events in the queue\n"
      "updates      199 of 200 cost nothing (99.5 %)\n"
      "left out     rotation: every agent is a ball\n"
      "             a second line\n"
      "rejections   not_finite 2\n"
      "counters     queries_per_second 56, queries 789, queued 12, updates_kept 199, breaches "
      "1\n"
      "\n"
      "SIMULATOR  RUN  ALIVE  CLOCK     GRANTED  AGENTS  STATES  REJECTED  REFUSED NOW\n"
      "sim        7    yes    12.000 s  -        1       0       0         -\n");
}

TEST_F(StatusDetailsTest, ListsWhoIsWaitedForAndNotThere) {
  v1::ServiceStatus* status = Status();
  status->add_simulators()->set_name("one");
  Extend(status, "waiting_for", "one, two, shape ab12");
  Poll(1);
  const std::string page = StatusDetails(view_);
  EXPECT_TRUE(page.starts_with("WAITS for one, two, shape ab12: ")) << page;
  const std::string row =
      "\ntwo        -    missing  -        -        -       -       -         -\n";
  EXPECT_EQ(page.substr(page.size() - row.size()), row) << "a shape is no simulator, one is listed";
}

TEST_F(StatusDetailsTest, ShowsTheWholeVerdictAndWhatHasHappened) {
  v1::ServiceStatus* status = Status();
  std::string names;
  for (int i = 0; i < 20; ++i) names += (i == 0 ? "" : ", ") + std::to_string(i);
  Extend(status, "waiting_for", names);
  Extend(status, "clock_step", "by +3.000000 s, to 9.000000 s");
  Extend(status, "evicted", "rogue");
  Extend(status, "removed_silent", "ghost");
  Poll(1);
  const std::string page = StatusDetails(view_);
  for (const char* line : {"\n  19: let it go on", "\nclock set    by +3.000000 s, to 9.000000 s\n",
                           "\nevicted      rogue\n", "\nremoved      ghost\n"}) {
    EXPECT_NE(page.find(line), std::string::npos) << line << page;
  }
}

// Goal:   the services stand side by side, and one that is configured otherwise is marked.
TEST_F(StatusDetailsTest, ShowsAllServicesInOneTable) {
  v1::ServiceStatus* serving = Status();
  serving->set_configuration(1);
  Extend(serving, "process", "pid 12 on host-a");
  Extend(serving, "lease_s", "0.5");
  for (const std::uint64_t id : {2, 3}) {
    v1::ServiceStatus* standby = Status();
    standby->set_service_id(id);
    standby->set_phase(v1::PHASE_STANDBY);
    standby->set_version("0.2.0");
    standby->set_configuration(id - 1);
    if (id == 2) Extend(standby, "standby", "ready");
    Extend(standby, "process", "pid 7 on host-b");
    Extend(standby, "lease_s", "2");
  }
  Poll(3);
  const std::string page = StatusDetails(view_);
  const std::string head = "VERSION  TERM  LEASE  AGENTS  NOW       CONFIGURATION\n";
  EXPECT_TRUE(Contains(page, "ROLE            SERVICE           PROCESS           " + head +
                                 "serves          0000000000000001  pid 12 on host-a  0.1.0    2   "
                                 "  0.5 s  1       12.345 s  "
                                 "-\n"
                                 "standby, ready  0000000000000002  pid 7 on host-b   0.2.0    2   "
                                 "  2 s    1       12.345 s  "
                                 "the same\n"
                                 "standby         0000000000000003  pid 7 on host-b   0.2.0    2   "
                                 "  2 s    1       12.345 s  "
                                 "OTHER\n"))
      << page;
}

TEST_F(StatusDetailsTest, ShowsTheOffsetsOfClocksInAWorldOfTheWallClock) {
  v1::ServiceStatus* status = next_.outputs.emplace_back().mutable_service_status();
  status->set_phase(v1::PHASE_SERVING);
  const auto add = [&](const char* name, std::int64_t lower_ns, std::int64_t upper_ns) {
    v1::SimulatorStatus* simulator = status->add_simulators();
    simulator->set_name(name);
    simulator->mutable_clock_offset()->set_earliest_ns(lower_ns);
    simulator->mutable_clock_offset()->set_latest_ns(upper_ns);
  };
  constexpr std::int64_t kNoLower = std::numeric_limits<std::int64_t>::min();
  add("near", -215'000, 402'000);
  add("ahead", 5'000'000'000, kNever);
  add("silent", kNoLower, kNever);
  Poll(1);
  const std::string page = StatusDetails(view_);
  for (const char* row :
       {"REJECTED  REFUSED NOW  OFFSET\n", "-0.215 … +0.402 ms\n", "+5000.000 … ? ms\n"}) {
    EXPECT_NE(page.find(row), std::string::npos) << row << page;
  }
  EXPECT_EQ(page.substr(page.size() - 2), "-\n");
}

// Goal:   an operator reads how long the service runs, what it takes, and how long its steps take.
TEST_F(StatusDetailsTest, ShowsWhatTheServiceMeasuresOfItself) {
  v1::ServiceStatus* status = Status();
  status->set_build("GCC 12.2.0, debug checks off");
  status->set_started_ns(1'700'000'000'000'000'000);
  status->set_uptime_ns(200'000'000'000'000);
  status->set_cpu_us(2'000'000'000);
  status->set_memory_bytes(45'600'000);
  v1::Histogram* steps = status->add_histograms();
  steps->set_name("step_us");
  for (const std::uint64_t count : {0, 60, 39, 1}) steps->add_counts(count);
  status->add_histograms()->set_name("update_to_contact_us");
  monitor_.Poll(std::chrono::nanoseconds(0));
  const std::string page = StatusDetails(view_);
  for (const char* line : {"build        GCC 12.2.0, debug checks off\n",
                           "up           2 d 7 h, since 2023-11-14T22:13:20Z\n",
                           "used         2000.0 s of CPU (1.0 % of one core), 45.6 MB\n",
                           "steps        100: half up to 2, 99 % up to 5, all up to 10 us\n",
                           "to contact   none so far\n"}) {
    EXPECT_TRUE(Contains(page, line)) << line << page;
  }
}

}  // namespace
}  // namespace collision::client
