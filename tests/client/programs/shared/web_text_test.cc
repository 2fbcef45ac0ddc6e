// Goal:   bytes are written as RFC 4648 has them, and texts stay texts in a page.
// Method: its own examples, and bytes above 127; each character that means something.
#include "client/programs/shared/web_text.h"

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

TEST(EscapeHtml, LeavesNothingThatEndsATextOrAnAttribute) {
  EXPECT_EQ(EscapeHtml("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;");
  EXPECT_EQ(EscapeHtml("plain ünï"), "plain ünï");
}

}  // namespace
}  // namespace collision::client
