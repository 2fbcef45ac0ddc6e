#include "collision_core/numeric/rotation.h"

#include <array>

#include "collision_core/base/check.h"
#include "collision_core/numeric/allowances.h"

namespace collision::numeric {
namespace {

const Interval kEverything(-1, 1);

Interval Clamp(Interval x, double lower, double upper) {
  return {std::clamp(x.lower, lower, upper), std::clamp(x.upper, lower, upper)};
}

Interval PlusMinus(double x) { return {-x, x}; }

/// Half the width, rounded up, seen from `middle`.
double RadiusAbout(double middle, Interval x) {
  return std::max(AddUp(x.upper, -middle), AddUp(middle, -x.lower));
}

// π/2 = kFirst + kSecond + a number in kThird. The first two have 33 bits, so that n times them is
// exact for |n| < 2^20: the reduced angle loses nothing but the last subtraction's rounding.
constexpr double kFirst = 0x1.921fb544p+0;
constexpr double kSecond = 0x1.0b4611a6p-34;
constexpr Interval kThird(0x1.3198a2e037073p-69, 0x1.3198a2e037074p-69);
constexpr double kQuartersPerRadian = 0x1.45f306dc9c883p-1;

/// Adding it rounds a double of modest size to a whole number.
constexpr double kRound = 0x1.8p+52;

// Below, ε is kUnitRoundoff.

/// The series below are evaluated in doubles, from the last factor in, sum = 1 − z sum' / d. Three
/// roundings (of z = x², product, quotient) and the error of sum' weigh z / d, the last rounding
/// ε. For z <= 0.64 the z / d are at most 0.32, 0.054, … (cosine): the second sum is off by less
/// than 1.3ε, the first by ε + 0.32 (3 + 1.3) ε < 2.4ε. Nine terms leave out 0.8^18 / 18! < 0.03ε.
/// The sine has smaller z / d. All sums are in [0.6, 1].
constexpr double kSeriesError = 2.5 * kUnitRoundoff;

/// `first` is 2 for sin x / x = 1 − z/(2·3) (1 − z/(4·5) (…)), 1 for cos x = 1 − z/(1·2) (…).
/// Requires |x| <= 0.8; contains the exact value.
Interval Series(double x, int first) {
  constexpr int kTerms = 9;
  const double z = x * x;
  double sum = 1;
  for (int k = kTerms - 1; k >= 1; --k) {
    const int n = first + 2 * (k - 1);
    sum = 1 - z * sum / (n * (n + 1));
  }
  return Interval(sum) + PlusMinus(kSeriesError);
}

/// Sine and cosine of one number, |x| <= 0.8.
SinCos ReducedSinCos(double x) { return {Interval(x) * Series(x, 2), Series(x, 1)}; }

/// Sine and cosine of one number: x = n π/2 + r with |r| <= π/4, or barely more.
SinCos PointSinCos(double x) {
  const double n = (x * kQuartersPerRadian + kRound) - kRound;
  const Interval r = Interval(x) - n * kFirst - n * kSecond - Interval(n) * kThird;
  const double middle = r.middle();
  SinCos reduced = ReducedSinCos(middle);
  const Interval slack = PlusMinus(RadiusAbout(middle, r));
  reduced.sin = reduced.sin + slack;
  reduced.cos = reduced.cos + slack;
  switch (static_cast<std::int64_t>(n) & 3) {
    case 0:
      return reduced;
    case 1:
      return {reduced.cos, -reduced.sin};
    case 2:
      return {-reduced.sin, -reduced.cos};
    default:
      return {-reduced.cos, reduced.sin};
  }
}

/// The arc tangent of one number t in [0, 1]. Halved twice by atan t = 2 atan(t / (1 + √(1 + t²)))
/// it is at most tan(π/16) < 0.2; then the series 1 − t²/3 + t⁴/5 − …, whose 13 terms leave out
/// less than 0.2^26 / 27 < 2^-64. A halving is off by 3.1ε, relative (√ and the sums, of positive
/// numbers), and hands on at most what it was given; the series by less than 1.3ε, the last product
/// by ε: together below 9ε.
Interval ArcTangent(double t) {
  constexpr int kTerms = 13;
  constexpr double kError = 10 * kUnitRoundoff;
  // Far more than the few units of 2^-1074 that angles lose which underflow.
  constexpr double kAngleUnderflow = 0x1p-1060;
  for (int halving = 0; halving < 2; ++halving) t = t / (1 + std::sqrt(1 + t * t));
  const double z = t * t;
  double sum = 1.0 / (2 * kTerms - 1);
  for (int k = kTerms - 2; k >= 0; --k) sum = 1.0 / (2 * k + 1) - z * sum;
  const Interval angle = Interval(4 * (t * sum)) * Interval(1 - kError, 1 + kError);
  return Max(0, angle + PlusMinus(kAngleUnderflow));
}

const Interval kHalfPi(0x1.921fb54442d18p+0, 0x1.921fb54442d19p+0);

/// The angle in [0, π/2] of the point (x, y), both >= 0.
Interval Angle(double y, double x) {
  if (y == 0) return 0;
  if (x == 0) return kHalfPi;
  const Interval ratio = Clamp(Interval(std::min(x, y)) / Interval(std::max(x, y)), 0, 1);
  const Interval angle = {ArcTangent(ratio.lower).lower, ArcTangent(ratio.upper).upper};
  return y <= x ? angle : kHalfPi - angle;
}

using Four = std::array<Interval, 4>;

/// x / |x|; scaled first by powers of two, so that no square overflows or underflows.
Four Unit(Four x) {
  constexpr double kLargest = 0x1p+400, kSmallest = 0x1p-400;
  double greatest = 0;
  for (const Interval& c : x) greatest = std::max(greatest, Abs(c).upper);
  const auto scale = [&x, &greatest](double by) {
    for (Interval& c : x) c = Interval(by) * c;
    greatest *= by;
  };
  while (greatest > kLargest) scale(kSmallest);
  while (greatest > 0 && greatest < kSmallest) scale(kLargest);
  Interval square = 0;
  for (const Interval& c : x) square = square + Square(c);
  const Interval length = Sqrt(square);
  for (Interval& c : x) c = Clamp(c / length, -1, 1);
  return x;
}

/// The quaternion product: first b, then a.
IntervalQuaternion Product(const IntervalQuaternion& a, const IntervalQuaternion& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

}  // namespace

SinCos SinCosOf(Interval x) {
  if (!(x.lower >= -kRotationAngleMax && x.upper <= kRotationAngleMax))
    return {kEverything, kEverything};
  const double middle = x.middle();
  const SinCos point = PointSinCos(middle);
  // Neither changes faster than its argument.
  const Interval slack = PlusMinus(RadiusAbout(middle, x));
  return {Clamp(point.sin + slack, -1, 1), Clamp(point.cos + slack, -1, 1)};
}

IntervalQuaternion UnitQuaternion(const Eigen::Quaterniond& q) {
  CORE_CHECK(q.coeffs().allFinite() && !q.coeffs().isZero(0), "a quaternion names a rotation",
             q.w(), q.x(), q.y(), q.z());
  const Four unit = Unit({q.w(), q.x(), q.y(), q.z()});
  return {unit[0], unit[1], unit[2], unit[3]};
}

IntervalQuaternion Turned(const Eigen::Quaterniond& q, const Eigen::Vector3d& w_WB,
                          Interval seconds) {
  const IntervalQuaternion start = UnitQuaternion(q);
  if (w_WB.isZero(0) || (seconds.lower == 0 && seconds.upper == 0)) return start;
  const Interval angle = Norm(IntervalVector(w_WB)) * seconds;
  if (!(Abs(angle).upper <= kRotationAngleMax)) {
    return {kEverything, kEverything, kEverything, kEverything};
  }
  const Four axis = Unit({w_WB.x(), w_WB.y(), w_WB.z(), 0});
  const SinCos half = SinCosOf(Interval(0.5) * angle);
  IntervalQuaternion end =
      Product({half.cos, half.sin * axis[0], half.sin * axis[1], half.sin * axis[2]}, start);
  for (Interval* c : {&end.w, &end.x, &end.y, &end.z}) *c = Clamp(*c, -1, 1);
  return end;
}

Interval AngleBetween(const IntervalQuaternion& a, const IntervalQuaternion& b) {
  const IntervalQuaternion between = Product({a.w, -a.x, -a.y, -a.z}, b);
  // The rotation by φ is ±(cos φ/2, n sin φ/2): φ/2 grows with |sin| and falls with |cos|.
  const Interval cos = Clamp(Abs(between.w), 0, 1);
  const Interval sin = Clamp(Norm({between.x, between.y, between.z}), 0, 1);
  return {2 * Angle(sin.lower, cos.upper).lower, 2 * Angle(sin.upper, cos.lower).upper};
}

Rotation RotationOf(const IntervalQuaternion& q) {
  const Interval two = 2;
  const Interval xx = Square(q.x), yy = Square(q.y), zz = Square(q.z);
  const Interval xy = q.x * q.y, yz = q.y * q.z, zx = q.z * q.x;
  const Interval wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  const Interval entries[3][3] = {
      {Interval(1) - two * (yy + zz), two * (xy - wz), two * (zx + wy)},
      {two * (xy + wz), Interval(1) - two * (zz + xx), two * (yz - wx)},
      {two * (zx - wy), two * (yz + wx), Interval(1) - two * (xx + yy)}};
  // |E x| <= √(Σ e²) |x| for a matrix whose entries are off by e at most; and whatever the matrix M
  // is, |M x − R x| <= (√(Σ m²) + 1) |x|.
  Rotation rotation;
  Interval off = 0, size = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Interval entry = Clamp(entries[i][j], -1, 1);
      const double middle = entry.middle();
      rotation.matrix(i, j) = middle;
      off = off + Square(RadiusAbout(middle, entry));
      size = size + Square(middle);
    }
  }
  rotation.error = std::min(Sqrt(off).upper, (Sqrt(size) + 1).upper);
  return rotation;
}

}  // namespace collision::numeric
