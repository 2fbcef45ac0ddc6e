// Goal:   what people call an event is found: the first contact, one by its number, one of two
//         agents; and while it changes, its newest revision.
// Method: revisions by hand, with a view that knows three agents by their names.
#include "client/programs/tools/recordings/event_search.h"

#include <algorithm>

#include "client/programs/shared/exit_code.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class EventSearchTest : public CollisionctlTest {
 protected:
  EventSearchTest() {
    Status();
    Describe("ada", 1, 0);
    Describe("bob", 1, 1);
    Describe("eve", 1, 2);
    Poll(4);
  }

  static v1::CollisionEvent Event(std::uint32_t lower, std::uint32_t higher, v1::EventStatus status,
                                  std::uint64_t number = 0) {
    v1::CollisionEvent event;
    for (const auto& [id, slot] :
         {std::pair(event.mutable_lower(), lower), std::pair(event.mutable_higher(), higher)}) {
      id->set_simulator_id(5);
      id->set_run(1);
      id->set_slot(slot);
      id->set_generation(1);
    }
    event.set_status(status);
    event.set_contacts_sequence(number);
    event.mutable_begin()->set_earliest_ns(4'500'000'000);
    return event;
  }

  /// The slots of what is found, or nothing.
  static std::string SlotsOf(const EventSearch& search) {
    if (!search.found()) return "";
    return std::to_string(search.found()->lower().slot()) +
           std::to_string(search.found()->higher().slot());
  }

  void Take(EventSearch* search, const std::vector<v1::CollisionEvent>& events) const {
    for (const v1::CollisionEvent& event : events) search->Take(event, view_);
  }
};

TEST_F(EventSearchTest, WithoutAWordTheFirstContactIsMeant) {
  EventSearch search("");
  v1::CollisionEvent near = Event(0, 2, v1::EVENT_CONFIRMED, 1);
  near.set_level("warning");
  Take(&search, {Event(0, 1, v1::EVENT_POSSIBLE), near});
  EXPECT_FALSE(search.found()) << "neither is a contact";
  Take(&search, {Event(1, 2, v1::EVENT_CONFIRMED, 2), Event(0, 1, v1::EVENT_CONFIRMED, 3)});
  EXPECT_EQ(SlotsOf(search), "12");
  EXPECT_FALSE(search.is_settled()) << "its end is not known";
  Take(&search, {Event(1, 2, v1::EVENT_ENDED, 4)});
  EXPECT_EQ(search.found()->contacts_sequence(), 4u);
  EXPECT_TRUE(search.is_settled());
}

TEST_F(EventSearchTest, AContactThatIsWithdrawnIsNone) {
  EventSearch search("");
  Take(&search, {Event(0, 1, v1::EVENT_CONFIRMED, 1), Event(0, 1, v1::EVENT_WITHDRAWN, 2)});
  EXPECT_FALSE(search.is_settled());
  Take(&search, {Event(1, 2, v1::EVENT_ENDED, 3)});
  EXPECT_EQ(SlotsOf(search), "12");
}

TEST_F(EventSearchTest, ANumberIsThatOfAnyRevision) {
  for (const char* number : {"2", "3"}) {
    EventSearch search(number);
    Take(&search, {Event(0, 1, v1::EVENT_CONFIRMED, 1), Event(0, 2, v1::EVENT_CONFIRMED, 2),
                   Event(0, 2, v1::EVENT_ENDED, 3), Event(0, 1, v1::EVENT_ENDED, 4)});
    EXPECT_EQ(SlotsOf(search), "02") << number;
    EXPECT_EQ(search.found()->contacts_sequence(), 3u);
  }
}

TEST_F(EventSearchTest, ComingNearIsNotMeantByNumberOrNames) {
  v1::CollisionEvent near = Event(0, 2, v1::EVENT_CONFIRMED, 7);
  near.set_level("warning");
  for (const char* wanted : {"7", "ada,eve"}) {
    EventSearch search(wanted);
    Take(&search, {near});
    EXPECT_EQ(SlotsOf(search), "") << wanted;
  }
}

TEST_F(EventSearchTest, TwoAgentsAreFoundInEitherOrderAndByFullNames) {
  for (const char* names : {"ada,eve", "eve,ada", "sim:ada,eve", "sim:eve,sim:ada"}) {
    EventSearch search(names);
    Take(&search, {Event(0, 1, v1::EVENT_CONFIRMED, 1), Event(0, 2, v1::EVENT_CONFIRMED, 2)});
    EXPECT_EQ(SlotsOf(search), "02") << names;
  }
  for (const char* names : {"ada,ada", "ada,zoe", "other:ada,eve", " ada,eve"}) {
    EventSearch search(names);
    Take(&search, {Event(0, 2, v1::EVENT_CONFIRMED, 2)});
    EXPECT_EQ(SlotsOf(search), "") << names;
  }
}

TEST_F(EventSearchTest, OfTwoAgentsAContactIsBetterThanAForecast) {
  EventSearch search("ada,bob");
  Take(&search, {Event(0, 1, v1::EVENT_POSSIBLE), Event(0, 1, v1::EVENT_DISMISSED)});
  EXPECT_EQ(search.found()->status(), v1::EVENT_DISMISSED) << "it is all that there is";
  EXPECT_FALSE(search.is_settled());
  v1::CollisionEvent contact = Event(0, 1, v1::EVENT_CONFIRMED, 1);
  contact.set_contact(2);
  Take(&search, {contact, Event(0, 1, v1::EVENT_POSSIBLE)});
  EXPECT_EQ(search.found()->contact(), 2u);
}

TEST_F(EventSearchTest, SomeOfTheContactsAreTold) {
  EventSearch search("99");
  for (std::uint64_t number = 1; number <= 20; ++number) {
    Take(&search, {Event(0, 1, v1::EVENT_CONFIRMED, number)});
  }
  const std::string lines = search.Contacts();
  EXPECT_EQ(std::ranges::count(lines, '\n'), 10);
  EXPECT_TRUE(lines.starts_with("  1  ada (sim) - bob (sim), begins at 4.500000 s\n")) << lines;
}

TEST_F(EventSearchTest, AnythingElseIsRefused) {
  for (const char* wanted :
       {"ada", ",bob", "ada,", ",", "0", "-1", "7x", "1.5", " 7", "18446744073709551616"}) {
    EXPECT_THROW(EventSearch{wanted}, BadInput) << wanted;
  }
}

}  // namespace
}  // namespace collision::client
