// Allowances for rounding that several rooms share: each states how many operations it covers.
//
// Let u be the unit roundoff (2^-53; 2^-24 in single precision). An operation returns its exact
// result times 1 + δ with |δ| <= u, unless it underflows. After n successive operations on terms of
// one sign, the result is at least (1 − u)^n times the exact one; a square root halves the earlier
// loss. Multiplying by 1 + k u, itself rounded, restores a value no less than the exact one if (1 −
// u)^(n + 1) (1 + k u) >= 1. Because (1 − u)^(n + 1) >= 1 − (n + 1) u, this holds for n <= k − 2
// while k² u <= 1, as for all k below. The factor 1 − k u rounds down likewise.
//
// A difference of terms loses u of the terms, not of itself: it needs a share of their magnitudes,
// which is named and derived where it is used.
#pragma once

namespace collision::numeric {

/// u: the most that one rounding costs, relative.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// k = 8: up to 6 operations, such as the length of a vector (3.5 u) and two sums of such.
inline constexpr double kFewRoundingsUp = 1 + 0x1p-50;
inline constexpr double kFewRoundingsDown = 1 - 0x1p-50;

/// k = 32: up to 30 operations.
inline constexpr double kSomeRoundingsUp = 1 + 0x1p-48;

/// k = 8,192: more operations than any expression has. Where a factor a little above 1, such as the
/// length of a computed unit vector, is to be covered as well.
inline constexpr double kManyRoundingsUp = 1 + 0x1p-40;

/// In single precision, k = 4: a cast from double, and one more operation.
inline constexpr float kCastRoundingUp = 1 + 0x1p-22f;
/// k = 8: up to 6 operations.
inline constexpr float kFewFloatRoundingsUp = 1 + 0x1p-21f;
/// k = 16: up to 14 operations.
inline constexpr float kSomeFloatRoundingsUp = 1 + 0x1p-20f;

/// The share of a float to be added to it for what a cast from double may have taken: 4 u, for the
/// cast and the addition.
inline constexpr float kCastRounding = 0x1p-22f;

}  // namespace collision::numeric
