// Goal:   the table has the pairs that touch or may touch, the nearest in time first, with what is
//         known of each; what is over leaves it; JSON says the same.
// Method: revisions by hand in a world at 12.345 s; whole pages are compared.
#include "client/programs/tools/collisionctl/top/top_page.h"

#include <gtest/gtest.h>

#include "tests/client/fake_transport.h"
#include "tests/client/programs/tools/collisionctl/json/schema_check.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class TopTest : public CollisionctlTest {
 protected:
  void SetUp() override {
    Status()->mutable_stamp()->set_epoch(1);
    Poll(1);
  }

  v1::CollisionEvent Make(std::uint32_t contact, v1::EventStatus status, std::int64_t begin_ns) {
    v1::CollisionEvent event = OwnEvent(contact, 1, contact);
    event.set_status(status);
    event.mutable_higher()->set_slot(contact);
    event.set_pair_slot(contact);
    event.set_now_ns(12'000'000'000);
    event.mutable_begin()->set_earliest_ns(begin_ns);
    event.mutable_begin()->set_latest_ns(kNever);
    event.mutable_end()->set_earliest_ns(kNever);
    event.mutable_end()->set_latest_ns(kNever);
    event.mutable_lower_label()->set_simulator_name("people");
    event.mutable_lower_label()->set_agent_name("ada");
    event.mutable_higher_label()->set_simulator_name("robots");
    event.mutable_higher_label()->set_agent_name("bob" + std::to_string(contact));
    return event;
  }

  void Add(const v1::CollisionEvent& event) {
    view_.Callbacks().event(event);
    open_.Add(view_.TakeEvents());
  }

  std::string Page(std::size_t rows, bool alive = true) {
    std::string page;
    for (const std::string& line : TopLines(view_, open_, alive, rows)) page += line + "\n";
    return page;
  }

  OpenEvents open_;
};

TEST_F(TopTest, HasWhatIsExpectedFirstThenTheNearestAndNoMoreThanTheRows) {
  Add(Make(1, v1::EVENT_POSSIBLE, 20'345'678'901));
  v1::CollisionEvent touch = Make(2, v1::EVENT_POSSIBLE, 14'000'000'000);
  touch.mutable_expected()->set_outcome(v1::EXPECTED_TOUCH);
  touch.mutable_expected()->mutable_begin()->set_earliest_ns(14'500'000'000);
  Add(touch);
  v1::CollisionEvent pass = Make(3, v1::EVENT_POSSIBLE, 12'000'000'000);
  pass.mutable_expected()->set_outcome(v1::EXPECTED_PASS);
  pass.mutable_expected()->mutable_closest()->mutable_distance_m()->set_lower(1.9);
  Add(pass);
  Add(Make(5, v1::EVENT_POSSIBLE, 12'250'000'000));
  v1::CollisionEvent contact = Make(4, v1::EVENT_CONFIRMED, 11'000'000'000);
  contact.mutable_begin()->set_latest_ns(11'000'100'000);
  contact.mutable_proximity()->set_at_ns(11'000'100'000);
  contact.mutable_proximity()->mutable_separation_m()->set_upper(-0.1234);
  Add(contact);
  EXPECT_EQ(Page(4),
            "WELL: it serves, and no simulator is here\n"
            "world lab, now 12.345 s; agents: 1; pairs that touch: 1, that may: 4\n"
            "WHEN          BEGIN             STATUS     GAP [m]   EXPECTED      PAIR\n"
            "now           [11.000, 11.001]  confirmed  ≤ -0.123  -             "
            "ada (people) × bob4 (robots)\n"
            "in ≥ 1.654 s  [14.000, open]    possible   -         touch 14.500  "
            "ada (people) × bob2 (robots)\n"
            "now?          [12.000, open]    possible   -         pass ≥ 1.9 m  "
            "ada (people) × bob3 (robots)\n"
            "in ≈ 0.250 s  [12.250, open]    possible   -         -             "
            "ada (people) × bob5 (robots)\n");
}

TEST_F(TopTest, AnEventThatIsOverLeavesIt) {
  for (const v1::EventStatus over :
       {v1::EVENT_DISMISSED, v1::EVENT_WITHDRAWN, v1::EVENT_ENDED, v1::EVENT_UNDECIDED}) {
    Add(Make(1, v1::EVENT_CONFIRMED, 13'000'000'000));
    EXPECT_EQ(open_.confirmed(), 1u);
    EXPECT_EQ(open_.possible(), 0u);
    Add(Make(1, over, 13'000'000'000));
    EXPECT_EQ(open_.confirmed(), 0u);
    EXPECT_TRUE(open_.Nearest(view_, 9).empty());
  }
  EXPECT_TRUE(Page(9).ends_with("PAIR\nno pair touches or may touch\n")) << Page(9);
}

TEST_F(TopTest, ANewerRevisionReplacesTheOlderOne) {
  Add(Make(1, v1::EVENT_POSSIBLE, 13'000'000'000));
  Add(Make(1, v1::EVENT_POSSIBLE, 15'000'000'000));
  const auto nearest = open_.Nearest(view_, 9);
  ASSERT_EQ(nearest.size(), 1u);
  EXPECT_EQ(nearest[0]->begin().earliest_ns(), 15'000'000'000);
}

TEST_F(TopTest, SaysThatTheServiceIsGone) {
  EXPECT_TRUE(Page(1, false).starts_with("GONE: no service is heard; what follows is old\n"));
}

TEST_F(TopTest, JsonFitsTheSchema) {
  Add(Make(1, v1::EVENT_POSSIBLE, 13'000'000'000));
  Add(Make(2, v1::EVENT_CONFIRMED, 13'000'000'000));
  const std::string json = TopJson(view_, open_, true, 9);
  EXPECT_EQ(ComplaintsAbout({json}), "");
  const std::string none = "\"more\":1,\"status\":\"possible\"";
  std::string bad = json;
  bad.replace(bad.find("\"status\":\"possible\""), 19, none);
  EXPECT_NE(ComplaintsAbout({bad}), "") << "a pair with a key that the schema does not have";
}

// Goal:   a forecast ends, too, where all that is heard is another pair in its slot.
TEST_F(TopTest, AForecastThatAnotherPairReplacedIsGone) {
  for (std::uint32_t contact : {1u, 2u}) {
    v1::CollisionEvent event = Make(contact, v1::EVENT_POSSIBLE, 13'000'000'000);
    event.set_contacts_sequence(0);
    event.set_pair_slot(8);
    Add(event);
    EXPECT_EQ(open_.possible(), 1u);
  }
  EXPECT_NE(Page(9).find("bob2"), std::string::npos) << Page(9);
  EXPECT_EQ(Page(9).find("bob1"), std::string::npos) << Page(9);
  // What has become a contact meanwhile stays.
  v1::CollisionEvent contact = Make(2, v1::EVENT_CONFIRMED, 12'000'000'000);
  contact.set_contacts_sequence(1);
  Add(contact);
  v1::CollisionEvent next = Make(3, v1::EVENT_POSSIBLE, 13'000'000'000);
  next.set_contacts_sequence(0);
  next.set_pair_slot(8);
  Add(next);
  EXPECT_EQ(open_.confirmed(), 1u);
  EXPECT_EQ(open_.possible(), 1u);
}

}  // namespace
}  // namespace collision::client
