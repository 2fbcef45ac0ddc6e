#include "server/publish/event_log.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

v1::CollisionEvent Event(std::uint32_t contact) {
  v1::CollisionEvent event;
  event.set_contact(contact);
  event.mutable_begin()->set_earliest_ns(5);
  return event;
}

std::uint64_t HashOf(const std::vector<v1::CollisionEvent>& events) {
  EventLog log;
  for (const auto& event : events) log.Add(event);
  EXPECT_EQ(log.count(), events.size());
  return log.hash();
}

// Goal:   the hash is the FNV-1a that others compute.
// Method: the published values for no bytes and for one zero byte, the length of an empty event;
//         and the three bytes 02 08 01 by the definition.
TEST(EventLog, IsFnv1a) {
  EXPECT_EQ(HashOf({}), 0xcbf29ce484222325);
  EXPECT_EQ(HashOf({v1::CollisionEvent()}), 0xaf63bd4c8601b7df);
  v1::CollisionEvent event;
  event.set_pair_slot(1);
  EXPECT_EQ(HashOf({event}), 0xeabb371875f644a2);
}

// Goal:   equal logs have equal hashes; another value, order, or number of events gives another
// hash.
TEST(EventLog, TellsLogsApart) {
  const std::uint64_t hash = HashOf({Event(1), Event(2)});
  EXPECT_EQ(hash, HashOf({Event(1), Event(2)}));
  EXPECT_NE(hash, HashOf({Event(2), Event(1)}));
  EXPECT_NE(hash, HashOf({Event(1), Event(3)}));
  EXPECT_NE(hash, HashOf({Event(1)}));
  EXPECT_NE(hash, HashOf({Event(1), Event(2), v1::CollisionEvent()}));
}

}  // namespace
}  // namespace collision::server
