// Goal:   only well-formed UTF-8 passes, and nothing well-formed is changed.
// Method: the borders of every row of table 3-7 of the Unicode standard, and what lies just beyond
// them.
#include "idl/dds/text.h"

#include <gtest/gtest.h>

namespace collision::dds {
namespace {

TEST(Utf8, WellFormedTextStays) {
  for (const std::string text :
       {"", "plain ~", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xec\xbf\xbf",
        "\xed\x80\x80", "\xed\x9f\xbf", "\xee\x80\x80", "\xef\xbf\xbf", "\xf0\x90\x80\x80",
        "\xf3\xbf\xbf\xbf", "\xf4\x80\x80\x80", "\xf4\x8f\xbf\xbf", "a\xc3\xa9z\xe2\x82\xac!"}) {
    EXPECT_EQ(Utf8(text), text);
  }
}

TEST(Utf8, EachStrayByteBecomesAQuestionMark) {
  EXPECT_EQ(Utf8("\x80"), "?");                 // continues nothing
  EXPECT_EQ(Utf8("\xc1\xbf"), "??");            // longer than it need be
  EXPECT_EQ(Utf8("\xe0\x9f\xbf"), "???");       // the same
  EXPECT_EQ(Utf8("\xf0\x8f\xbf\xbf"), "????");  // the same
  EXPECT_EQ(Utf8("\xed\xa0\x80"), "???");       // a surrogate
  EXPECT_EQ(Utf8("\xf4\x90\x80\x80"), "????");  // beyond U+10FFFF
  EXPECT_EQ(Utf8("\xf5\x80\x80\x80"), "????");  // beyond U+10FFFF
  EXPECT_EQ(Utf8("a\xe2\x82"), "a??");          // cut off at the end
  EXPECT_EQ(Utf8("\xe2\x82z\xc3\xa9"), "??z\xc3\xa9");
}

TEST(Printable, LeavesNothingThatBreaksALineOrATerminal) {
  EXPECT_EQ(Printable("pid 1 on host-a"), "pid 1 on host-a");
  EXPECT_EQ(Printable("a\nb\x1b[2Jc\x7f\xc3\xa4"), "a?b?[2Jc???");
}

}  // namespace
}  // namespace collision::dds
