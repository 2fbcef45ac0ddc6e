// Goal:   numbers have the bytes that ROS 2 wants.
// Method: bytes by hand.
#include "client/programs/foxglove/messages/cdr.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

TEST(CdrWriter, AlignsEachNumberToItsSize) {
  CdrWriter writer;
  writer.Time(1'000'000'002).Uint32(3).Float64(1).String("ab").Uint64(4).Int32(-1);
  const std::string expected(
      "\0\1\0\0"              // little-endian CDR
      "\1\0\0\0\2\0\0\0"      // sec, nanosec
      "\3\0\0\0\0\0\0\0"      // and 4 bytes to 16
      "\0\0\0\0\0\0\xf0\x3f"  // 1.0
      "\3\0\0\0ab\0\0"        // with its 0, and 1 byte to 32
      "\4\0\0\0\0\0\0\0"      //
      "\xff\xff\xff\xff",
      4 + 8 + 8 + 8 + 8 + 8 + 4);
  EXPECT_EQ(writer.bytes(), expected);
}

TEST(CdrWriter, ATextEndsAtItsFirstZero) {
  CdrWriter writer;
  writer.String(std::string("a\0b", 3)).String("");
  EXPECT_EQ(writer.bytes(), std::string("\0\1\0\0\2\0\0\0a\0\0\0\1\0\0\0\0", 17));
}

}  // namespace
}  // namespace collision::client
