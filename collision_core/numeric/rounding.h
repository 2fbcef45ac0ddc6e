// The four operations and the square root with a stated direction of rounding.
//
// The processor's rounding mode is never changed: compilers move arithmetic across such a change.
// The nearest double is computed instead, then the sign of its error, exactly; where the error
// points the wrong way, the answer moves by one unit in the last place.
//
//   a + b   TwoSum (Knuth): the error of a sum is a double, also among denormals.
//   a b     TwoProduct (Veltkamp, Dekker): the error of a product is a double unless it underflows.
//   a / b   With q the rounded quotient and p + e = q b exactly, (a − p) − e has the sign of
//           a − q b; a − p is exact, because p ≈ a.
//   √a      The same with the rounded root s and p + e = s².
//
// The error of a product around 2^e is a multiple of 2^(e−106): a double for e > −968. Below
// kExactErrorMin the answer therefore moves in any case, unless an operand is zero: there it is off
// by up to 1.5 units. Infinite and undefined results move likewise: an infinity that rounds inward
// becomes the largest double, inf − inf becomes the unbounded side.
//
// TwoProduct and not fma(a, b, −ab), which says the same: without the instruction, which not every
// target has, fma is a call that costs several times as much.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "collision_core/numeric/allowances.h"

namespace collision::numeric {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Below this magnitude the error of a product, quotient or root may itself be rounded.
inline constexpr double kExactErrorMin = 0x1p-960;

/// The next double below; NaN gives −infinity, the bound that claims nothing.
inline double NextDown(double x) {
  if (!(x > -kInfinity)) return -kInfinity;
  if (x == 0) return -std::numeric_limits<double>::denorm_min();
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(x > 0 ? bits - 1 : bits + 1);
}

/// The next double above; NaN gives +infinity.
inline double NextUp(double x) { return -NextDown(-x); }

inline double AddDown(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double error = (a - (sum - b_part)) + (b - b_part);
  return error >= 0 ? sum : NextDown(sum);
}

inline double AddUp(double a, double b) { return -AddDown(-a, -b); }

/// a b − product exactly, where |product| >= kExactErrorMin and is finite.
inline double ProductError(double a, double b, double product) {
  constexpr double kSplit = 0x1p+27 + 1;
  const double a_scaled = kSplit * a, b_scaled = kSplit * b;
  const double a_high = a_scaled - (a_scaled - a), a_low = a - a_high;
  const double b_high = b_scaled - (b_scaled - b), b_low = b - b_high;
  const double error =
      a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
  // The split of an operand beyond 2^996 overflows to NaN.
  return error == error ? error : std::fma(a, b, -product);
}

inline bool ErrorIsExact(double x) {
  return std::abs(x) >= kExactErrorMin && std::abs(x) <= std::numeric_limits<double>::max();
}

/// NextDown of a finite number other than zero, if asked for. A parameter and not a condition at
/// the call: whether a rounding went up is as good as random, so a branch on it is often predicted
/// wrongly, and this arithmetic has none.
inline double NextDownIf(bool asked, double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits - ((1 | (bits >> 63)) & -static_cast<std::int64_t>(asked)));
}

/// Zero times infinity is zero: the infinity stands for finite values without a bound.
inline double MultiplyDown(double a, double b) {
  const double product = a * b;
  if (ErrorIsExact(product)) return NextDownIf(ProductError(a, b, product) < 0, product);
  return a == 0 || b == 0 ? 0 : NextDown(product);
}

inline double MultiplyUp(double a, double b) { return -MultiplyDown(-a, b); }

/// Unchecked: b != 0.
inline double DivideDown(double a, double b) {
  if (a == 0) return 0;
  const double quotient = a / b;
  const double product = quotient * b;
  if (!ErrorIsExact(a) || !ErrorIsExact(quotient) || !ErrorIsExact(product))
    return NextDown(quotient);
  const double residue = (a - product) - ProductError(quotient, b, product);
  return NextDownIf(b > 0 ? residue < 0 : residue > 0, quotient);
}

inline double DivideUp(double a, double b) { return -DivideDown(-a, b); }

/// Returns a number with the sign of a − root². Unchecked: `root` is √a rounded, and
/// ErrorIsExact(a).
inline double RootResidue(double a, double root) {
  const double square = root * root;
  return (a - square) - ProductError(root, root, square);
}

/// The root rounded down; zero for a number below zero.
inline double SqrtDown(double a) {
  if (!(a > 0)) return 0;
  const double root = std::sqrt(a);
  return ErrorIsExact(a) ? NextDownIf(RootResidue(a, root) < 0, root) : NextDown(root);
}

inline double SqrtUp(double a) {
  if (a <= 0) return 0;
  const double root = std::sqrt(a);
  return ErrorIsExact(a) && RootResidue(a, root) <= 0 ? root : NextUp(root);
}

/// A float, not the least one, that is no less than x and never zero. A cast is off by 2^-24 of
/// itself, or by less than the least normal number.
inline float FloatUp(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded + (std::abs(rounded) * kCastRounding + std::numeric_limits<float>::min());
}

}  // namespace collision::numeric
