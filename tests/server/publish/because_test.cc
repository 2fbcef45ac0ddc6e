// Goal:   a final revision about an agent that is gone says why, unless the contact ended before
//         that; every other event stays the same, bit for bit.
// Method: every status, with each of the two agents removed.
#include "server/publish/because.h"

#include <gtest/gtest.h>

#include "server/config/config.h"
#include "server/publish/inherited_events.h"
#include "server/world/world.h"

namespace collision::server {
namespace {

const v1::Config kConfig = CompleteConfig({});

v1::CollisionEvent EventOf(v1::EventStatus status) {
  v1::CollisionEvent event;
  event.mutable_lower()->set_simulator_id(1);
  event.mutable_lower()->set_run(3);
  event.mutable_higher()->set_simulator_id(2);
  event.mutable_higher()->set_run(4);
  event.set_status(status);
  return event;
}

TEST(Because, FinalRevisionsOfTheRemovedSayWhyAndNoOthersDo) {
  for (int number = 0; number < v1::EventStatus_ARRAYSIZE; ++number) {
    const auto status = static_cast<v1::EventStatus>(number);
    const bool final =
        status == v1::EVENT_WITHDRAWN || status == v1::EVENT_ENDED || status == v1::EVENT_UNDECIDED;
    for (const std::uint64_t removed : {1, 2, 3}) {
      World world{kConfig};
      world.ended_runs().Add(removed, static_cast<std::uint32_t>(removed + 2), EndCause::kSilent);
      v1::CollisionEvent event = EventOf(status);
      AddBecause(world, &event);
      if (!final || removed == 3) {
        EXPECT_EQ(event.SerializeAsString(), EventOf(status).SerializeAsString());
        continue;
      }
      ASSERT_EQ(event.extensions_size(), 1) << v1::EventStatus_Name(status);
      EXPECT_EQ(event.extensions(0).key(), "because");
      EXPECT_EQ(event.extensions(0).value(), "silent");
    }
  }
}

TEST(Because, AnotherRunOfTheSameSimulatorIsAnotherMatter) {
  World world{kConfig};
  world.ended_runs().Add(1, 2, EndCause::kEvicted);
  v1::CollisionEvent event = EventOf(v1::EVENT_ENDED);
  AddBecause(world, &event);
  EXPECT_EQ(event.extensions_size(), 0);
}

// It left at 50 ns. A contact whose end was known by 49 ns has ended before.
TEST(Because, AnAgentThatLeftEndsWhatHadNotEndedBefore) {
  for (int number = 0; number < v1::EventStatus_ARRAYSIZE; ++number) {
    const auto status = static_cast<v1::EventStatus>(number);
    for (const std::int64_t end_ns : {49, 50}) {
      v1::CollisionEvent event = EventOf(status);
      event.mutable_end()->set_latest_ns(end_ns);
      World world{kConfig};
      world.departed().Add(IdOf(event.higher()), nullptr, Instant::FromNanoseconds(50));
      AddBecause(world, &event);
      const bool said = status == v1::EVENT_WITHDRAWN || status == v1::EVENT_UNDECIDED ||
                        (status == v1::EVENT_ENDED && end_ns == 50);
      ASSERT_EQ(event.extensions_size(), said ? 1 : 0) << v1::EventStatus_Name(status) << end_ns;
      if (said) {
        EXPECT_EQ(event.extensions(0).value(), "left");
      }
    }
  }
}

}  // namespace
}  // namespace collision::server
