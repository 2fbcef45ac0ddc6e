// Goal:   a shape is the same bytes on every machine and comes back from them bit for bit; whatever
//         is not such bytes is refused with a reason, and never read beyond its end.
// Method: a triangle written out byte by byte; random contents there and back; every truncation,
//         every changed byte of the header.
#include "idl/shape_bytes.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "tests/support/random.h"

namespace collision {
namespace {

using std::literals::string_literals::operator""s;

ShapeContent OneTriangle() {
  return {.vertices = {{1, -2, 0.5}, {0, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 0x01020304}}};
}

TEST(ShapeBytes, AreWhatTheFormatSays) {
  const std::string zero(8, '\0');
  const std::string one = "\0\0\0\0\0\0\xf0\x3f"s, minus_two = "\0\0\0\0\0\0\0\xc0"s,
                    half = "\0\0\0\0\0\0\xe0\x3f"s;
  EXPECT_EQ(EncodeShape(OneTriangle()), "CSHAPE\0\1"s + "\3\0\0\0"s + "\1\0\0\0"s + one +
                                            minus_two + half + zero + zero + zero + zero + one +
                                            zero + "\0\0\0\0"s + "\1\0\0\0"s + "\4\3\2\1"s);
}

ShapeContent CapsuleAndHull() {
  ShapeContent content = OneTriangle();
  content.solids.push_back({.kind = SolidKind::kCapsule, .half_extents = {0, 0, 2}, .rounding = 1});
  content.solids.push_back(
      {.kind = SolidKind::kHull, .position = {1, 2, 3}, .points = {{4, 5, 6}, {7, 8, 9}}});
  return content;
}

// Goal:   solids come back bit for bit; their header, each of them and the points stand where the
//         format says.
TEST(ShapeBytes, HoldSolids) {
  const ShapeContent content = CapsuleAndHull();
  const std::string bytes = EncodeShape(content);
  const std::size_t solids =
      kShapeHeaderBytes + kSolidHeaderBytes + 3 * kShapeVertexBytes + kShapeTriangleBytes;
  ASSERT_EQ(bytes.size(), solids + 2 * kSolidBytes + 2 * kShapeVertexBytes);
  EXPECT_EQ(bytes.substr(0, 24),
            "CSHAPE\0\2"s + "\3\0\0\0"s + "\1\0\0\0"s + "\2\0\0\0"s + "\2\0\0\0"s);
  EXPECT_EQ(bytes.substr(solids, 8), "\2\0\0\0"s + "\0\0\0\0"s);
  EXPECT_EQ(bytes.substr(solids + kSolidBytes, 8), "\5\0\0\0"s + "\2\0\0\0"s);
  EXPECT_EQ(bytes.substr(bytes.size() - 8), "\0\0\0\0\0\0\x22\x40"s);  // 9
  std::string error;
  const auto back = DecodeShape(bytes, &error);
  ASSERT_TRUE(back) << error;
  EXPECT_EQ(back->solids[0].kind, SolidKind::kCapsule);
  EXPECT_EQ(back->solids[0].half_extents[2], 2);
  EXPECT_EQ(back->solids[0].rounding, 1);
  EXPECT_EQ(back->solids[1].position, content.solids[1].position);
  EXPECT_EQ(back->solids[1].orientation, content.solids[1].orientation);
  EXPECT_EQ(back->solids[1].points, content.solids[1].points);
  EXPECT_EQ(EncodeShape(*back), bytes);
}

// Goal:   whatever one byte of the counts becomes: back as it stands, or refused; never read
// beyond.
TEST(ShapeBytes, SolidsThatDoNotAddUpAreRefused) {
  const std::string bytes = EncodeShape(CapsuleAndHull());
  std::string error;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(DecodeShape(bytes.substr(0, length), &error)) << length;
  }
  const std::size_t points_of_capsule = bytes.size() - 2 * kShapeVertexBytes - 2 * kSolidBytes + 4;
  for (const char points : {'\1', '\2', '\3'}) {
    std::string other = bytes;
    other[points_of_capsule] = points;
    EXPECT_FALSE(DecodeShape(other, &error)) << int{points};
  }
  EXPECT_NE(error.find("do not add up to 2"), std::string::npos) << error;
}

double RandomBits(Random* random) { return std::bit_cast<double>(random->Next()); }

TEST(ShapeBytes, ComeBackBitForBit) {
  Random random(1);
  for (int round = 0; round < 100; ++round) {
    ShapeContent content;
    content.vertices.resize(random.Below(50));
    content.triangles.resize(random.Below(50));
    for (auto& vertex : content.vertices) {
      for (double& x : vertex) x = RandomBits(&random);
    }
    for (auto& triangle : content.triangles) {
      for (auto& index : triangle) index = static_cast<std::uint32_t>(random.Next());
    }
    const std::string bytes = EncodeShape(content);
    std::string error;
    const auto back = DecodeShape(bytes, &error);
    ASSERT_TRUE(back) << error;
    EXPECT_EQ(EncodeShape(*back), bytes);
    EXPECT_EQ(back->triangles, content.triangles);
    ASSERT_EQ(back->vertices.size(), content.vertices.size());
    for (std::size_t i = 0; i < content.vertices.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(back->vertices[i][k]),
                  std::bit_cast<std::uint64_t>(content.vertices[i][k]));
      }
    }
  }
}

TEST(ShapeBytes, OtherLengthsAreRefused) {
  const std::string bytes = EncodeShape(OneTriangle());
  for (std::size_t length = 0; length <= bytes.size() + 40; ++length) {
    std::string other = bytes, error;
    other.resize(length);
    EXPECT_EQ(DecodeShape(other, &error).has_value(), length == bytes.size()) << length;
    EXPECT_EQ(error.empty(), length == bytes.size());
  }
}

TEST(ShapeBytes, AnotherHeaderIsRefused) {
  for (std::size_t i = 0; i < kShapeHeaderBytes; ++i) {
    std::string bytes = EncodeShape(OneTriangle()), error;
    bytes[i] ^= 1;
    EXPECT_FALSE(DecodeShape(bytes, &error)) << i;
    EXPECT_FALSE(error.empty());
  }
}

// Goal:   counts beyond everything are a length that does not match, not a reservation of memory.
TEST(ShapeBytes, HugeCountsAreRefused) {
  std::string bytes = EncodeShape({}), error;
  for (std::size_t i = 8; i < 16; ++i) bytes[i] = '\xff';
  EXPECT_FALSE(DecodeShape(bytes, &error));
  EXPECT_NE(error.find("154618822636"), std::string::npos) << error;
}

TEST(ShapeBytes, CountTheirParts) {
  EXPECT_EQ(ShapeParts(0), 0u);
  EXPECT_EQ(ShapeParts(1), 1u);
  EXPECT_EQ(ShapeParts(wire::kShapePartBytes), 1u);
  EXPECT_EQ(ShapeParts(wire::kShapePartBytes + 1), 2u);
  EXPECT_EQ(ShapeParts(std::numeric_limits<std::uint64_t>::max()), 375299968947542u);
}

}  // namespace
}  // namespace collision
