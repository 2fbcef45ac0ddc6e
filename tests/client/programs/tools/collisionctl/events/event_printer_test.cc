// Goal:   events are printed as lines, as sentences or as JSON, those that fit, each once; lost
//         contacts are told among them.
// Method: events by hand; what is printed is read.
#include "client/programs/tools/collisionctl/events/event_printer.h"

#include <gtest/gtest.h>

#include <sstream>

#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "tests/client/fake_transport.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class EventPrinterTest : public CollisionctlTest {
 protected:
  void Arrive(std::uint32_t contact, std::uint32_t revision) {
    v1::CollisionEvent& event = *next_.outputs.emplace_back().mutable_collision_event();
    event = OwnEvent(contact, revision, 10 * contact + revision);
    event.mutable_begin()->set_earliest_ns(20'000'000'000 + contact);
    event.mutable_begin()->set_latest_ns(kNever);
    event.mutable_end()->set_latest_ns(kNever);
    event.mutable_lower_label()->set_simulator_name("people");
    event.mutable_lower_label()->set_agent_name("ada");
    event.mutable_higher_label()->set_simulator_name("people");
    event.mutable_higher_label()->set_agent_name("bob");
    Poll(1);
  }

  std::string Take() {
    const std::string text = out_.str();
    out_.str("");
    return text;
  }

  std::ostringstream out_;
};

TEST_F(EventPrinterTest, PrintsEachRevisionOnceAndOfAllTheNewest) {
  EventPrinter printer({}, {}, &out_);
  Arrive(1, 1);
  Arrive(1, 2);
  printer.PrintNew(&view_);
  const std::string text = Take();
  EXPECT_NE(text.find("#1 r1"), std::string::npos) << text;
  EXPECT_NE(text.find("#1 r2"), std::string::npos) << text;
  printer.PrintNew(&view_);
  EXPECT_EQ(Take(), "");
  Arrive(2, 1);
  Arrive(2, 2);
  printer.PrintCurrent(&view_);
  const std::string current = Take();
  EXPECT_EQ(current.find("#2 r1"), std::string::npos) << current;
  EXPECT_NE(current.find("ada × bob"), std::string::npos) << current;
}

TEST_F(EventPrinterTest, ExplainsInSentencesWithTheNamesOfSimulators) {
  EventPrinter printer({.explain = true}, {}, &out_);
  Status();
  Poll(1);
  Arrive(1, 1);
  printer.PrintNew(&view_);
  EXPECT_EQ(Take(), "ada (people) and bob (people) could touch, but not before 20.00 s.\n");
}

TEST_F(EventPrinterTest, FiltersAlsoWhatIsFollowed) {
  EventPrinter printer({}, {.agents = {"carl"}}, &out_);
  Arrive(1, 1);
  printer.PrintNew(&view_);
  Arrive(1, 2);
  printer.PrintCurrent(&view_);
  EXPECT_EQ(Take(), "");
}

TEST_F(EventPrinterTest, TellsOnceHowManyContactsWereLost) {
  EventPrinter printer({}, {}, &out_);
  printer.PrintGap(0);
  EXPECT_EQ(Take(), "");
  printer.PrintGap(2);
  printer.PrintGap(2);
  EXPECT_EQ(Take(), MissedLine(2, 2) + "\n");
  printer.PrintGap(5);
  EXPECT_EQ(Take(), MissedLine(3, 5) + "\n");
}

}  // namespace
}  // namespace collision::client
