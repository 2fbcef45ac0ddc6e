// Goal:   a service with another wire revision, clock kind or frame is refused once, by the field
//         that differs; one that fits is not.
// Method: hellos, changed in one place at a time.
#include "client/library/identity/service_fit.h"

#include <gtest/gtest.h>

#include "idl/limits.h"

namespace collision::client {
namespace {

v1::ServiceHello Hello(std::uint64_t id = 1) {
  v1::ServiceHello hello;
  hello.set_service_id(id);
  hello.set_wire_revision(wire::kWireRevision);
  hello.set_clock_kind(v1::CLOCK_LOCK_STEP);
  hello.set_frame("ENU 1");
  hello.add_regions(0);
  return hello;
}

TEST(ServiceFit, TellsOfEachServiceOnce) {
  ServiceFit fit({.simulator = "a", .lock_step = true, .frame = "ENU 1"});
  EXPECT_FALSE(fit.Hear(Hello(1)));
  EXPECT_FALSE(fit.IsUnfit(1));
  EXPECT_EQ(fit.Text(), "");
  v1::ServiceHello other = Hello(2);
  other.set_wire_revision(wire::kWireRevision + 1);
  const auto rejection = fit.Hear(other);
  ASSERT_TRUE(rejection);
  EXPECT_EQ(rejection->reason, "REJECTED_MISMATCH");
  EXPECT_EQ(rejection->field, "wire_revision");
  EXPECT_FALSE(fit.Hear(other)) << "it was told";
  EXPECT_TRUE(fit.IsUnfit(2));
  EXPECT_EQ(fit.Unfit().size(), 1u);
  EXPECT_NE(fit.Text(), "");
  EXPECT_FALSE(fit.Hear(Hello(2)));
  EXPECT_FALSE(fit.IsUnfit(2)) << "it fits now";
}

TEST(ServiceFit, ComparesClockKindAndStatedFrames) {
  const auto field = [](const OwnFacts& own) {
    const auto rejection = ServiceFit(own).Hear(Hello());
    return rejection ? rejection->field : "";
  };
  EXPECT_EQ(field({.simulator = "a", .lock_step = true, .frame = ""}), "");
  EXPECT_EQ(field({.simulator = "a", .lock_step = false, .frame = ""}), "clock_kind");
  EXPECT_EQ(field({.simulator = "a", .lock_step = true, .frame = "ENU 2"}), "frame");
}

TEST(ServiceFit, RemembersABoundedNumberOfServices) {
  ServiceFit fit({.simulator = "a", .lock_step = false, .frame = ""});
  for (std::uint64_t id = 1; id <= 3 * ServiceFit::kServicesMax; ++id) fit.Hear(Hello(id));
  EXPECT_EQ(fit.Unfit().size(), ServiceFit::kServicesMax);
}

}  // namespace
}  // namespace collision::client
