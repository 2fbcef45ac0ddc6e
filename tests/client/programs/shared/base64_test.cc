// Goal:   bytes are written as RFC 4648 has them.
// Method: its own examples, and bytes above 127.
#include "client/programs/shared/base64.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

TEST(Base64, IsTheStandardOne) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foob"), "Zm9vYg==");
  EXPECT_EQ(Base64("\xfb\xff"), "+/8=");
}

}  // namespace
}  // namespace collision::client
