// Goal:   each reason is printed once and counted; only one that repeating cannot mend is fatal.
// Method: refusals made by hand; the output is captured.
#include "client/programs/shared/refusals.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

using std::chrono::milliseconds;

Rejection Of(const std::string& reason, std::uint64_t count) {
  return {
      .reason = reason, .topic = "TOPIC", .slot = 3, .field = "f", .detail = "d", .count = count};
}

TEST(Refusals, EachReasonIsPrintedOnceAndCounted) {
  Refusals refusals("sim");
  EXPECT_EQ(refusals.Summary(), "");
  testing::internal::CaptureStderr();
  refusals.Add({Of("REJECTED_STALE", 1), Of("REJECTED_STALE", 5)}, {});
  refusals.Add({Of("REJECTED_NOT_UNIT", 6), Of("REJECTED_STALE", 7)}, {});
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "sim: the service refused TOPIC of slot 3: REJECTED_STALE, f: d\n"
            "sim: the service refused TOPIC of slot 3: REJECTED_NOT_UNIT, f: d\n");
  EXPECT_EQ(refusals.Summary(),
            "the service refused 7 samples; reported: REJECTED_NOT_UNIT 1, REJECTED_STALE 3");
}

TEST(Refusals, ReasonsThatRepeatingCannotMendAreFatal) {
  Refusals refusals("sim");
  testing::internal::CaptureStderr();
  refusals.Add({Of("REJECTED_STALE", 1)}, {});
  EXPECT_FALSE(refusals.fatal({}));
  refusals.Add({Of("REJECTED_TOO_MANY_AGENTS", 2)}, {});
  EXPECT_EQ(refusals.fatal(Refusals::Wall::max()), "REJECTED_TOO_MANY_AGENTS");
  testing::internal::GetCapturedStderr();
}

// A restarted simulator is refused until its predecessor counts as gone.
TEST(Refusals, AnOwnerIsFatalWhileItLasts) {
  Refusals refusals("sim");
  const Refusals::Wall start;
  testing::internal::CaptureStderr();
  refusals.Add({Of("REJECTED_ID_OWNED", 1)}, start);
  refusals.Add({Of("REJECTED_ID_OWNED", 2)}, start + milliseconds(500));
  testing::internal::GetCapturedStderr();
  EXPECT_EQ(refusals.fatal(start + milliseconds(2499)), "REJECTED_ID_OWNED");
  EXPECT_FALSE(refusals.fatal(start + milliseconds(2500)));
  refusals.Granted();
  EXPECT_FALSE(refusals.fatal(start + milliseconds(500)));
}

}  // namespace
}  // namespace collision::client
