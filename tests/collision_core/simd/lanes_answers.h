// The answers of every operation of a kind of lanes, for sixteen inputs: one function per kind.
#pragma once

#include <cstdint>

namespace collision::simd {

inline constexpr std::uint32_t kCount = 16;

/// Three numbers per lane.
struct LaneInputs {
  float a[kCount], b[kCount], c[kCount];
};

/// Lane by lane; masks have a bit for each.
struct LaneAnswers {
  float sum[kCount], difference[kCount], product[kCount], quotient[kCount], root[kCount];
  float lesser[kCount], greater[kCount], where_greater[kCount];
  float eight[kCount], four[kCount], fours[kCount], eights[kCount];
  float dot[kCount], cross_x[kCount], cross_y[kCount], cross_z[kCount];
  float least;  ///< Of `root`.
  std::uint32_t not_greater, not_less, not_at_least;
  std::uint32_t selected_count, selected[2 * kCount], copies[2 * kCount];
};

using AnswerLanes = void (*)(const LaneInputs& inputs, LaneAnswers* answers);

/// Null where the processor or the compiler has no such lanes.
AnswerLanes PlainAnswers();
AnswerLanes Avx2Answers();
AnswerLanes Avx512Answers();

}  // namespace collision::simd
