// Goal:   of more events than are kept those go first that came to nothing, then those that are
//         over, then the oldest.
// Method: a full book, and one event more.
#include "client/programs/scene/event_book.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace collision::client {
namespace {

v1::CollisionEvent EventOf(std::uint32_t pair, v1::EventStatus status) {
  v1::CollisionEvent event;
  event.set_pair_slot(pair);
  event.mutable_higher()->set_slot(pair);
  event.set_status(status);
  event.set_contacts_sequence(status == v1::EVENT_POSSIBLE ? 0 : 1);
  return event;
}

/// A full book, whose events 1, 2 … are open but for some; what one more drops.
std::vector<std::uint64_t> DroppedWith(const std::map<std::uint32_t, v1::EventStatus>& others) {
  EventBook book;
  for (std::uint32_t pair = 1; pair <= EventBook::kEventsMax; ++pair) {
    const auto other = others.find(pair);
    book.Take(EventOf(pair, other == others.end() ? v1::EVENT_CONFIRMED : other->second));
  }
  EXPECT_TRUE(book.TakeChanges().dropped.empty());
  book.Take(EventOf(EventBook::kEventsMax + 1, v1::EVENT_CONFIRMED));
  const EventBook::Changes changes = book.TakeChanges();
  EXPECT_EQ(changes.changed, std::vector<std::uint64_t>{EventBook::kEventsMax + 1});
  const std::vector<std::uint64_t> numbers = book.Numbers();
  const std::set<std::uint64_t> kept(numbers.begin(), numbers.end());
  for (const std::uint64_t number : changes.dropped) EXPECT_FALSE(kept.contains(number));
  return changes.dropped;
}

using Numbers = std::vector<std::uint64_t>;

TEST(EventBook, WhatCameToNothingGoesBeforeContacts) {
  EXPECT_EQ(DroppedWith({{5, v1::EVENT_ENDED}, {9, v1::EVENT_DISMISSED}}), Numbers{9});
  EXPECT_EQ(DroppedWith({{5, v1::EVENT_ENDED}, {9, v1::EVENT_WITHDRAWN}}), Numbers{9});
  EXPECT_EQ(DroppedWith({{7, v1::EVENT_DISMISSED}, {9, v1::EVENT_DISMISSED}}), Numbers{7});
}

TEST(EventBook, WhatIsOverGoesBeforeWhatIsOpen) {
  EXPECT_EQ(DroppedWith({{5, v1::EVENT_ENDED}, {8, v1::EVENT_ENDED}}), Numbers{5});
  EXPECT_EQ(DroppedWith({}), Numbers{1});
  EXPECT_EQ(DroppedWith({{1, v1::EVENT_POSSIBLE}}), Numbers{1});
}

}  // namespace
}  // namespace collision::client
