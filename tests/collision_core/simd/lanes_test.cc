// Goal:   every kind of lanes does what simd/lanes_plain.h says, with the same bits.
// Method: numbers, zeros of both signs, infinities and NaN, each beside each other; the oracle is
//         one operation of C++ per lane.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "tests/collision_core/simd/lanes_answers.h"

namespace collision::simd {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::vector<AnswerLanes> AllKinds() {
  std::vector<AnswerLanes> kinds;
  for (const AnswerLanes kind : {PlainAnswers(), Avx2Answers(), Avx512Answers()}) {
    if (kind != nullptr) kinds.push_back(kind);
  }
  return kinds;
}

/// Sixteen of the pairs (values[i], values[j]), from `first` on.
LaneInputs InputsFrom(const std::vector<float>& values, std::size_t first) {
  LaneInputs inputs;
  const std::size_t n = values.size();
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const std::size_t pair = (first + k) % (n * n);
    inputs.a[k] = values[pair / n];
    inputs.b[k] = values[pair % n];
    inputs.c[k] = values[(pair / n + pair % n) % n];
  }
  return inputs;
}

/// The bits; any NaN is like any other.
bool Same(float x, float y) {
  return (std::isnan(x) && std::isnan(y)) || std::memcmp(&x, &y, sizeof(x)) == 0;
}

void ExpectArithmetic(const LaneInputs& in, const LaneAnswers& out) {
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const float a = in.a[k], b = in.b[k], c = in.c[k];
    EXPECT_TRUE(Same(out.sum[k], a + b));
    EXPECT_TRUE(Same(out.difference[k], a - b));
    EXPECT_TRUE(Same(out.product[k], a * b));
    EXPECT_TRUE(Same(out.quotient[k], a / b));
    EXPECT_TRUE(Same(out.root[k], std::sqrt(a)));
    const float ab = a * b, ac = a * c, bc = b * c;
    EXPECT_TRUE(Same(out.dot[k], (ac + ab) + bc));
    EXPECT_TRUE(Same(out.cross_x[k], b * b - ac));
    EXPECT_TRUE(Same(out.cross_y[k], c * c - ab));
    EXPECT_TRUE(Same(out.cross_z[k], a * a - bc));
  }
}

void ExpectChoices(const LaneInputs& in, const LaneAnswers& out) {
  std::uint32_t selected = 0;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const float a = in.a[k], b = in.b[k];
    EXPECT_TRUE(Same(out.lesser[k], a < b ? a : b)) << a << " " << b;
    EXPECT_TRUE(Same(out.greater[k], a > b ? a : b)) << a << " " << b;
    EXPECT_TRUE(Same(out.where_greater[k], a > b ? a : in.c[k])) << a << " " << b;
    EXPECT_EQ(out.not_greater >> k & 1, !(a > b)) << a << " " << b;
    EXPECT_EQ(out.not_less >> k & 1, !(a < b)) << a << " " << b;
    EXPECT_EQ(out.not_at_least >> k & 1, !(a >= b)) << a << " " << b;
    if (a > b) continue;
    EXPECT_EQ(out.selected[selected], k);
    EXPECT_EQ(out.copies[selected], 7u);
    ++selected;
  }
  EXPECT_EQ(out.selected_count, selected);
}

void ExpectSpread(const LaneInputs& in, const LaneAnswers& out) {
  for (std::uint32_t k = 0; k < kCount; ++k) {
    EXPECT_TRUE(Same(out.eight[k], in.a[k % 8]));
    EXPECT_TRUE(Same(out.four[k], in.a[k % 4]));
    EXPECT_TRUE(Same(out.fours[k], in.a[k / 4]));
    EXPECT_TRUE(Same(out.eights[k], in.a[k / 8]));
  }
}

TEST(Lanes, OfEveryKindDoWhatOneOperationPerLaneDoes) {
  const std::vector<float> values = {0,      -0.f,   1,         -2.5f,      0.1f, 3e38f,
                                     1e-45f, -7e20f, kInfinity, -kInfinity, kNaN, 1.0000001f};
  for (const AnswerLanes kind : AllKinds()) {
    for (std::size_t first = 0; first < values.size() * values.size(); first += kCount) {
      const LaneInputs in = InputsFrom(values, first);
      LaneAnswers out;
      kind(in, &out);
      ExpectArithmetic(in, out);
      ExpectChoices(in, out);
      ExpectSpread(in, out);
    }
  }
}

TEST(Lanes, OfEveryKindFindTheLeastLane) {
  for (const AnswerLanes kind : AllKinds()) {
    for (std::uint32_t least = 0; least < kCount; ++least) {
      LaneInputs in;
      for (std::uint32_t k = 0; k < kCount; ++k) {
        in.a[k] = static_cast<float>(9 + k), in.b[k] = in.c[k] = 1;
      }
      in.a[least] = 4;
      LaneAnswers out;
      kind(in, &out);
      EXPECT_EQ(out.least, 2);
    }
  }
}

}  // namespace
}  // namespace collision::simd
