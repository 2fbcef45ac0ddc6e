// Goal:   an operator reads in the log who touches whom, and when: each contact once.
#include "server/service/reports/contact_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace collision::server {
namespace {

v1::CollisionEvent Contact(std::uint32_t contact, std::int64_t latest_ns = 1'260'000'000) {
  v1::CollisionEvent event;
  event.set_status(v1::EVENT_CONFIRMED);
  event.set_contact(contact);
  event.mutable_lower()->set_slot(3);
  event.mutable_lower_label()->set_simulator_name("fleet");
  event.mutable_lower_label()->set_agent_name("a");
  event.mutable_higher()->set_slot(4);
  event.mutable_higher_label()->set_simulator_name("ships");
  event.mutable_begin()->set_earliest_ns(1'250'000'000);
  event.mutable_begin()->set_latest_ns(latest_ns);
  return event;
}

TEST(ContactText, NamesBothAndTheBracketOfTheBegin) {
  EXPECT_EQ(ContactText(Contact(1), true),
            "fleet/a and ships/4 touch, from between 1.250000 s and 1.260000 s");
  EXPECT_EQ(ContactText(Contact(1, std::numeric_limits<std::int64_t>::max()), false),
            "fleet/a and ships/4 touch, from between 1970-01-01T00:00:01.250000Z and not known");
  v1::CollisionEvent crossing = Contact(1);
  crossing.set_level("near");
  EXPECT_NE(ContactText(crossing, true).find("cross level \"near\""), std::string::npos);
}

TEST(ContactReport, WritesEachContactOnce) {
  Measurements measurements(nullptr);
  std::vector<std::string> lines;
  ContactReport report(&measurements, nullptr, v1::Config(),
                       [&lines](const std::string& text) { lines.push_back(text); });
  report.TakeContact(Contact(1));
  report.TakeContact(Contact(1, 1'255'000'000));  // its bracket is narrower now
  v1::CollisionEvent ended = Contact(1);
  ended.set_status(v1::EVENT_ENDED);
  report.TakeContact(ended);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].starts_with("fleet/a and ships/4 touch")) << lines[0];
  report.TakeContact(Contact(2));
  EXPECT_EQ(lines.size(), 2u) << "they touch again";
}

}  // namespace
}  // namespace collision::server
