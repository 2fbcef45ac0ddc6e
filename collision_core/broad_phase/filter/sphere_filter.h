// Which of many moving balls may touch a given one: the filter of all methods, in wide vectors.
#pragma once

#include <cstdint>

namespace collision::broad_phase {

/// Balls in arrays, in single precision. u seconds after the middle of the placement's window each
/// has its centre at p + v u; up to `time` seconds after the placement's begin all of it lies
/// within s0 + time (s1 + time (s2 + time s3)) of there; `speed` is |v| or more. Positions are
/// relative to a corner near them.
struct FilterView {
  const float *x, *y, *z;
  const float *vx, *vy, *vz;
  const float *s0, *s1, *s2;
  const float* s3;  ///< Null: all are zero.
  const float* speed;
};

/// Balls [begin, end), and where the query's ball is as seen from their corner.
struct FilterRange {
  std::uint32_t begin, end;
  float x, y, z;
};

/// The ball that is compared with all of the ranges, and when.
struct FilterQuery {
  float vx, vy, vz;   ///< Its velocity.
  float reach;        ///< At `time`.
  float speed;        ///< |v| or more.
  float first, last;  ///< u in [first, last] [s].
  float u_max;        ///< The greatest |u| in it [s].
  float time;         ///< Seconds after the placement's begin at which all reaches are taken.
};

/// Writes the indices k, range by range and in order, whose centre comes within the sum of the two
/// reaches of the query's centre (or where that is not a number), and returns how many. `hits` has
/// room for all of the ranges and kLanesMax more. Compares sixteen, eight or one ball at a time.
///
/// Most balls are farther apart at u = 0 than reaches and ways together: they are not examined
/// further. For the others, with d and w the differences, the least |d + w u| is at u* = −d·w /
/// w·w, held within [first, last]. What rounding takes, with D = |d|, W = |w| max |u|, R the sum of
/// the reaches: d, w, w u* and their sum are off by less than 2^-22 (D + W) together; u* by 2^-21
/// (|u*| + D/|w|), which moves the point by less than 2^-21 (W + D); squares and R lose 2^-21 of
/// themselves. Where D > 4 (R + W) the two are far apart, whatever rounding does. Else all of this
/// is less than 2^-17 (R + W): the caller makes each reach larger by kFilterSlack of itself and of
/// the way of its own centre. Below kReachLeast squares lose digits to underflow: the caller adds
/// it to each reach and speed. A square that overflows is infinite, and less than no other.
/// sphere_filter_test compares the hits with exact fractions.
using SphereFilter = std::uint32_t (*)(const FilterView& balls, const FilterQuery& query,
                                       const FilterRange* ranges, std::uint32_t range_count,
                                       std::uint32_t* hits);

/// The slack of a reach, as a part of itself and of the way; derived above.
inline constexpr float kFilterSlack = 0x1p-16f;
/// The least reach [m] and speed [m/s] that count.
inline constexpr float kReachLeast = 0x1p-60f;
/// The most balls that are compared at a time.
inline constexpr std::uint32_t kLanesMax = 16;

/// The widest version that this processor has. All give the same hits.
SphereFilter WidestSphereFilter();

/// One version each, for tests; null where the processor or the compiler has none.
SphereFilter PlainSphereFilter();
SphereFilter Avx2SphereFilter();
SphereFilter Avx512SphereFilter();

}  // namespace collision::broad_phase
