// Goal:   each change of the service is said once: gone, back, or another one in its place; one
//         that only claims the world is not back.
// Method: presence and statuses by hand.
#include "client/programs/tools/collisionctl/service_notes.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

constexpr const char* kGone = "the service is gone; waiting for it";
constexpr const char* kBack = "the service is back";

std::optional<v1::ServiceStatus> Status(std::uint64_t id, std::uint32_t term,
                                        std::uint64_t sequence) {
  v1::ServiceStatus status;
  status.set_service_id(id);
  status.mutable_stamp()->set_term(term);
  status.mutable_stamp()->set_sequence(sequence);
  return status;
}

TEST(ServiceNotes, ASteadyServiceSaysNothing) {
  ServiceNotes notes;
  EXPECT_EQ(notes.Take(true, std::nullopt), std::nullopt);
  for (const std::uint64_t sequence : {1, 2, 2}) {
    EXPECT_EQ(notes.Take(true, Status(7, 1, sequence)), std::nullopt);
  }
}

TEST(ServiceNotes, GoneAndBackAreSaidOnceAndBackNeedsAStatus) {
  ServiceNotes notes;
  EXPECT_EQ(notes.Take(true, Status(7, 1, 1)), std::nullopt);
  EXPECT_EQ(notes.Take(false, Status(7, 1, 1)), kGone);
  EXPECT_EQ(notes.Take(false, Status(7, 1, 1)), std::nullopt);
  // Another one claims the world, and is not heard again.
  EXPECT_EQ(notes.Take(true, Status(7, 1, 1)), std::nullopt);
  EXPECT_EQ(notes.Take(false, Status(7, 1, 1)), std::nullopt);
  EXPECT_EQ(notes.Take(true, Status(7, 1, 2)), kBack);
  EXPECT_EQ(notes.Take(true, Status(7, 1, 3)), std::nullopt);
  EXPECT_EQ(notes.Take(false, Status(7, 1, 3)), kGone);
}

TEST(ServiceNotes, AnotherServiceIsNamedOnceInPlaceOfBack) {
  ServiceNotes notes;
  EXPECT_EQ(notes.Take(true, Status(7, 1, 5)), std::nullopt);
  EXPECT_EQ(notes.Take(false, Status(7, 1, 5)), kGone);
  EXPECT_EQ(notes.Take(true, Status(8, 2, 1)),
            "another service speaks: service 0000000000000008, term 2; before, "
            "service 0000000000000007, term 1");
  EXPECT_EQ(notes.Take(true, Status(8, 2, 2)), std::nullopt);
  EXPECT_EQ(notes.Take(false, Status(8, 2, 2)), kGone);
  EXPECT_EQ(notes.Take(true, Status(8, 2, 3)), kBack);
}

}  // namespace
}  // namespace collision::client
