// Goal:   a final revision about an agent that the service removed says why; every other event
//         stays the same, bit for bit.
// Method: every status, with each of the two agents removed.
#include "server/publish/because.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

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
      EndedRuns ended;
      ended.Add(removed, static_cast<std::uint32_t>(removed + 2), EndCause::kSilent);
      v1::CollisionEvent event = EventOf(status);
      AddBecause(ended, &event);
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
  EndedRuns ended;
  ended.Add(1, 2, EndCause::kEvicted);
  v1::CollisionEvent event = EventOf(v1::EVENT_ENDED);
  AddBecause(ended, &event);
  EXPECT_EQ(event.extensions_size(), 0);
}

}  // namespace
}  // namespace collision::server
