// Goal:   every program, in any language, computes the same simulator id.
// Method: the test vectors of the FNV reference (RFC 9923, 64-bit FNV-1a).
#include "idl/identity.h"

#include <gtest/gtest.h>

namespace collision {
namespace {

TEST(SimulatorId, IsFnv1a) {
  EXPECT_EQ(SimulatorId(""), 0xcbf29ce484222325u);
  EXPECT_EQ(SimulatorId("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(SimulatorId("foobar"), 0x85944171f73967e8u);
}

TEST(SimulatorId, CountsBytesAboveAsciiAsUnsigned) {
  EXPECT_EQ(SimulatorId("\xff"), (0xcbf29ce484222325u ^ 0xffu) * 0x100000001b3u);
}

TEST(Identity, AsTextHasSixteenDigits) {
  EXPECT_EQ(IdText(0), "0000000000000000");
  EXPECT_EQ(IdText(0xab), "00000000000000ab");
  EXPECT_EQ(IdText(0xfedcba9876543210), "fedcba9876543210");
}

}  // namespace
}  // namespace collision
