// Goal:   a status has at most twelve lines, whatever the size of the world and whatever is wrong,
//         the verdict first; what does not fit is counted.
// Method: statuses by hand, through a monitor.
#include "client/programs/tools/collisionctl/status/status_page.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class StatusPageTest : public CollisionctlTest {};

std::int64_t Lines(const std::string& page) { return std::count(page.begin(), page.end(), '\n'); }

void Count(v1::ServiceStatus* status, const char* name, std::uint64_t value) {
  v1::Counter* counter = status->add_counters();
  counter->set_name(name);
  counter->set_value(value);
}

TEST_F(StatusPageTest, SaysWhatMattersOfASmallWorld) {
  v1::ServiceStatus* status = Status();
  status->set_pairs_tracked(3);
  status->set_frame("ENU");
  status->add_simulators()->set_name("alpha");
  status->add_simulators()->set_name("beta");
  status->mutable_simulators(1)->set_alive(true);
  Extend(status, "process", "pid 12 on host-a");
  Count(status, "events_possible", 5);
  Count(status, "events_confirmed", 2);
  Count(status, "events_undecided", 0);
  Count(status, "breaches", 1);
  Count(status, "rejected_not_finite", 2);
  v1::ServiceStatus* standby = Status();
  standby->set_service_id(2);
  standby->set_phase(v1::PHASE_STANDBY);
  standby->set_configuration(4);
  Extend(standby, "standby", "ready");
  Poll(2);
  EXPECT_EQ(StatusPage(view_),
            "WELL: time is not held up, nothing has failed, nothing is refused; but agents broke "
            "what they declare, 1 time: collisionctl agents\n"
            "service      version 0.1.0, pid 12 on host-a, term 2; standby: 0000000000000002 "
            "ready, of another configuration\n"
            "world        lab, lock-step, frame ENU, now 12.345 s\n"
            "simulators   2 (alpha, beta), not heard: alpha, 1 agents, 3 pairs tracked\n"
            "earliest     not published yet\n"
            "events       confirmed 2, possible 5, broken declarations 1\n"
            "refused      not_finite 2\n"
            "more         collisionctl status --all\n");
}

TEST_F(StatusPageTest, HasTwelveLinesWhateverTheSizeOfTheWorld) {
  v1::ServiceStatus* status = Status();
  std::string waited;
  for (int i = 0; i < 64; ++i) {
    status->add_simulators()->set_name("simulator-of-a-long-name-" + std::to_string(i));
    if (i < 20) waited += (i == 0 ? "" : ", ") + status->simulators(i).name();
  }
  Count(status, "simulators_unlisted", 36);
  for (int i = 0; i < 32; ++i) status->add_left_out("something");
  for (int i = 0; i < 60; ++i) Count(status, ("counter_" + std::to_string(i)).c_str(), 1);
  Extend(status, "waiting_for", waited);
  Extend(status, "recording_failure", "/r: no space");
  Poll(1);
  const std::string page = StatusPage(view_);
  EXPECT_EQ(Lines(page), kStatusLinesMax) << page;
  EXPECT_TRUE(page.starts_with("WAITS for simulator-of-a-long-name-0, ")) << page;
  EXPECT_NE(page.find(" and 18 more: the world's time stands\n"), std::string::npos) << page;
  EXPECT_NE(page.find("\n  and 18 lines more: --all\n"), std::string::npos) << page;
  EXPECT_NE(page.find("\nsimulators   100 (simulator-of-a-long-name-0, "), std::string::npos);
  EXPECT_NE(page.find(" and 98 more), not heard: "), std::string::npos) << page;
}

TEST_F(StatusPageTest, ShowsAVerdictThatFitsWithoutCuttingIt) {
  Extend(Status(), "waiting_for", "a, b, c, d");
  Poll(1);
  const std::string page = StatusPage(view_);
  EXPECT_EQ(Lines(page), kStatusLinesMax) << page;
  EXPECT_EQ(page.find("lines more"), std::string::npos) << page;
}

}  // namespace
}  // namespace collision::client
