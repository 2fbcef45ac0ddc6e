#include "collision_core/numeric/rotation.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tests/support/random.h"

namespace collision::numeric {
namespace {

using Real = boost::multiprecision::cpp_bin_float_100;
using RealQuaternion = std::array<Real, 4>;

bool Holds(const Interval& interval, const Real& x) {
  return Real(interval.lower) <= x && x <= Real(interval.upper);
}

std::array<Interval, 4> Components(const IntervalQuaternion& q) { return {q.w, q.x, q.y, q.z}; }

bool Holds(const IntervalQuaternion& q, const RealQuaternion& exact) {
  const auto c = Components(q);
  for (int i = 0; i < 4; ++i) {
    if (!Holds(c[i], exact[i])) return false;
  }
  return true;
}

double Width(const IntervalQuaternion& q) {
  double width = 0;
  for (const Interval& c : Components(q)) width = std::max(width, c.width());
  return width;
}

RealQuaternion Normalised(RealQuaternion q) {
  const Real length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (Real& c : q) c /= length;
  return q;
}

RealQuaternion Exactly(const Eigen::Quaterniond& q) {
  return Normalised({Real(q.w()), Real(q.x()), Real(q.y()), Real(q.z())});
}

RealQuaternion Times(const RealQuaternion& a, const RealQuaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

/// exp(w τ) q.
RealQuaternion ExactlyTurned(const Eigen::Quaterniond& q, const Eigen::Vector3d& w, double tau) {
  const Real x = w.x(), y = w.y(), z = w.z(), speed = sqrt(x * x + y * y + z * z);
  if (speed == 0) return Exactly(q);
  const Real half = speed * Real(tau) / 2, s = sin(half) / speed;
  return Times({cos(half), s * x, s * y, s * z}, Exactly(q));
}

/// The matrix of a unit quaternion, by turning the axes: q e q*.
std::array<std::array<Real, 3>, 3> MatrixOf(const RealQuaternion& q) {
  std::array<std::array<Real, 3>, 3> matrix;
  for (int column = 0; column < 3; ++column) {
    RealQuaternion axis = {0, 0, 0, 0};
    axis[1 + column] = 1;
    const RealQuaternion turned = Times(Times(q, axis), {q[0], -q[1], -q[2], -q[3]});
    for (int row = 0; row < 3; ++row) matrix[row][column] = turned[1 + row];
  }
  return matrix;
}

Eigen::Quaterniond RandomQuaternion(Random& random) {
  const Eigen::Vector3d v = random.UnitVector();
  const double w = random.Uniform(-2, 2);
  return {w, v.x(), v.y(), v.z()};
}

/// |M x − R x| / |x|, the exact product of M.
Real Off(const Rotation& rotation, const RealQuaternion& q, const Eigen::Vector3d& x) {
  const auto matrix = MatrixOf(q);
  Real off = 0, length = 0;
  for (int i = 0; i < 3; ++i) {
    Real e = 0;
    for (int j = 0; j < 3; ++j) e += (Real(rotation.matrix(i, j)) - matrix[i][j]) * Real(x[j]);
    off += e * e;
    length += Real(x[i]) * Real(x[i]);
  }
  return sqrt(off / length);
}

// Goal:   sine and cosine of every double up to a million are contained, and narrowly so.
// Method: a hundred-digit oracle; all magnitudes, and the doubles next to multiples of π/4, where
//         one of the two is tiny or the quadrant changes.
TEST(Rotation, SineAndCosineOfPoints) {
  const Real quarter = atan(Real(1));
  Random random(101);
  for (int i = 0; i < 8000; ++i) {
    double x = random.LogUniform(1e-3, kRotationAngleMax);
    if (i % 4 == 0) x = random.LogUniform(1e-300, 1e-3);
    if (i % 4 == 1) {
      x = static_cast<double>(quarter * random.Below(1'200'000));
      x = random.Chance(0.5) ? NextUp(x) : NextDown(x);
    }
    if (random.Chance(0.5)) x = -x;
    const SinCos both = SinCosOf(x);
    ASSERT_TRUE(Holds(both.sin, sin(Real(x)))) << x;
    ASSERT_TRUE(Holds(both.cos, cos(Real(x)))) << x;
    ASSERT_LE(both.sin.width(), std::min(1.0, std::abs(x)) * 1.5e-15 + 1e-308) << x;
    ASSERT_LE(both.cos.width(), 1.2e-15) << x;
  }
}

// Goal:   an interval of angles gives all their sines and cosines, within [-1, 1] and at most as
//         wide as itself (and rounding); beyond the limit, everything.
TEST(Rotation, SineAndCosineOfIntervals) {
  Random random(102);
  for (int i = 0; i < 1000; ++i) {
    const double lower = random.Uniform(-20, 20), width = random.LogUniform(1e-12, 4);
    const Interval x(lower, lower + width);
    const SinCos both = SinCosOf(x);
    EXPECT_LE(both.sin.width(), x.width() + 1e-14);
    EXPECT_LE(both.cos.width(), x.width() + 1e-14);
    EXPECT_TRUE(both.sin.lower >= -1 && both.sin.upper <= 1 && both.cos.upper <= 1);
    for (int k = 0; k <= 8; ++k) {
      const Real at = Real(x.lower) + (Real(x.upper) - Real(x.lower)) * k / 8;
      ASSERT_TRUE(Holds(both.sin, sin(at)) && Holds(both.cos, cos(at)));
    }
  }
  for (const Interval far :
       {Interval(2e6), Interval(-kInfinity, 0), Interval(0, NextUp(kRotationAngleMax))}) {
    EXPECT_EQ(SinCosOf(far).sin.lower, -1);
    EXPECT_EQ(SinCosOf(far).cos.upper, 1);
  }
}

// Goal:   a quaternion of any length names the exact rotation q / |q|.
// Method: lengths from the denormals to the largest doubles; components of different magnitude.
TEST(Rotation, UnitQuaternions) {
  Random random(103);
  for (int i = 0; i < 2000; ++i) {
    Eigen::Quaterniond q = RandomQuaternion(random);
    if (i % 3 == 0) q.coeffs() *= random.LogUniform(1e-305, 1e307);
    if (i % 3 == 1) q.coeffs()[i % 4] *= random.LogUniform(1e-300, 1);
    const IntervalQuaternion unit = UnitQuaternion(q);
    ASSERT_TRUE(Holds(unit, Exactly(q)));
    ASSERT_LE(Width(unit), 1e-15);
  }
  const Eigen::Quaterniond denormal(0, 0, 5e-324, 0);
  EXPECT_TRUE(Holds(UnitQuaternion(denormal), Exactly(denormal)));
  EXPECT_LE(Width(UnitQuaternion(denormal)), 1e-15);
  EXPECT_EQ(Width(UnitQuaternion(Eigen::Quaterniond(-1, 0, 0, 0))), 0);
}

// Goal:   turning forward and backward contains the exact orientation; the width grows about
//         linearly with the angle; too far a turn is everything.
TEST(Rotation, Turning) {
  Random random(104);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Quaterniond q = RandomQuaternion(random);
    const Eigen::Vector3d w = random.LogUniform(1e-12, 1e3) * random.UnitVector();
    const double tau = random.LogUniform(1e-9, 1e2) * (random.Chance(0.5) ? 1 : -1);
    const IntervalQuaternion end = Turned(q, w, tau);
    ASSERT_TRUE(Holds(end, ExactlyTurned(q, w, tau))) << w.norm() * tau;
    ASSERT_LE(Width(end), 8e-15 + 1e-15 * w.norm() * std::abs(tau));

    const Interval window(tau, tau + 1e-6);
    const IntervalQuaternion wide = Turned(q, w, window);
    ASSERT_TRUE(Holds(wide, ExactlyTurned(q, w, window.lower)));
    ASSERT_TRUE(Holds(wide, ExactlyTurned(q, w, window.upper)));
  }
  const Eigen::Quaterniond q(1, 2, 3, 4);
  EXPECT_TRUE(Holds(Turned(q, {0, 0, 5e-324}, 1e9), Exactly(q)));
  EXPECT_TRUE(Holds(Turned(q, {0, 0, 0}, 1e300), Exactly(q)));
  EXPECT_EQ(Turned(q, {0, 0, 1}, 2 * kRotationAngleMax).w.lower, -1);
  EXPECT_EQ(Turned(q, {0, 1e300, 0}, 1e300).z.upper, 1);
}

// Goal:   half a turn about x maps y to −y and z to −z; a quarter about z maps x to y.
TEST(Rotation, TurnsAreRightHandedInTheWorldFrame) {
  const double quarter = 0x1.921fb54442d18p+0;
  const Eigen::Quaterniond about_x(0, 1, 0, 0);
  const Rotation rotation = RotationOf(Turned(about_x, {0, 0, 2}, quarter / 2));
  // First the half turn about x, then the quarter about z.
  EXPECT_LE((rotation.matrix * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, 1, 0)).norm(), 3e-15);
  EXPECT_LE((rotation.matrix * Eigen::Vector3d(0, 1, 0) - Eigen::Vector3d(1, 0, 0)).norm(), 3e-15);
  EXPECT_LE((rotation.matrix * Eigen::Vector3d(0, 0, 1) + Eigen::Vector3d(0, 0, 1)).norm(), 3e-15);
}

// Goal:   the angle between two orientations is contained, and narrowly so, from none to half a
//         turn; q and −q are the same orientation.
// Method: turn by a known angle about a random axis; the oracle takes it from the exact
//         quaternions.
TEST(Rotation, AnglesBetweenOrientations) {
  Random random(105);
  const double half_turn = 0x1.921fb54442d18p+1;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Quaterniond a = RandomQuaternion(random);
    double turn = random.Uniform(0, half_turn);
    if (i % 3 == 0) turn = random.LogUniform(1e-18, 1);
    if (i % 3 == 1) turn = half_turn - random.LogUniform(1e-18, 1);
    const Eigen::Vector3d axis = random.UnitVector();
    const double s = std::sin(turn / 2);
    Eigen::Quaterniond b =
        Eigen::Quaterniond(std::cos(turn / 2), s * axis.x(), s * axis.y(), s * axis.z()) * a;
    if (random.Chance(0.5)) b.coeffs() = -b.coeffs();
    const RealQuaternion p = Exactly(a), q = Exactly(b);
    const RealQuaternion between = Times({p[0], -p[1], -p[2], -p[3]}, q);
    const Real exact =
        2 * atan2(sqrt(between[1] * between[1] + between[2] * between[2] + between[3] * between[3]),
                  abs(between[0]));
    const Interval angle = AngleBetween(UnitQuaternion(a), UnitQuaternion(b));
    ASSERT_TRUE(Holds(angle, exact)) << turn;
    ASSERT_LE(angle.width(), 2e-14) << turn;
    ASSERT_GE(angle.lower, 0);
  }
  const Interval all(-1, 1);
  const Interval angle = AngleBetween({all, all, all, all}, {all, all, all, all});
  EXPECT_EQ(angle.lower, 0);
  EXPECT_GE(angle.upper, half_turn);
  const IntervalQuaternion none = UnitQuaternion({1, 2, 3, 4});
  EXPECT_LE(AngleBetween(none, none).upper, 1e-14);
}

// Goal:   the arc tangent inside the angle holds to the last bits.
// Method: rotations about one axis by exact components: (c, s, 0, 0) against the identity is
//         2 atan2(s, c), up to the rounding of s / |q| and c / |q| alone.
TEST(Rotation, AnglesAboutOneAxisAreTight) {
  Random random(106);
  const IntervalQuaternion identity = UnitQuaternion({1, 0, 0, 0});
  for (int i = 0; i < 2000; ++i) {
    const double s = random.LogUniform(1e-200, 1e3), c = i % 2 ? 1 : random.LogUniform(1e-3, 1);
    const Interval angle = AngleBetween(identity, UnitQuaternion({c, 0, s, 0}));
    const Real exact = 2 * atan2(Real(s), Real(c));
    ASSERT_TRUE(Holds(angle, exact)) << s << " " << c;
    ASSERT_LE(angle.width(), 5e-15 * static_cast<double>(exact));
    // Of (1, s) nothing is rounded before the arc tangent.
    const double t = std::min(s, 1.0);
    const Interval tight = AngleBetween({1, 0, 0, 0}, {1, 0, t, 0});
    ASSERT_TRUE(Holds(tight, 2 * atan(Real(t)))) << t;
  }
}

// Goal:   the matrix is off by at most its error, for every orientation of the intervals; the error
//         is near rounding for points, near the spread for intervals, never above what any rotation
//         needs.
TEST(Rotation, MatricesWithTheirError) {
  Random random(107);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Quaterniond q = RandomQuaternion(random);
    const Rotation point = RotationOf(UnitQuaternion(q));
    ASSERT_LE(Off(point, Exactly(q), random.UnitVector()), Real(point.error));
    ASSERT_LE(point.error, 4e-15);

    const Eigen::Vector3d w = random.UnitVector();
    const double spread = random.LogUniform(1e-9, 1);
    const Rotation wide = RotationOf(Turned(q, w, Interval(0, spread)));
    for (const double tau : {0.0, random.Uniform(0, spread), spread}) {
      ASSERT_LE(Off(wide, ExactlyTurned(q, w, tau), random.UnitVector()), Real(wide.error));
    }
    ASSERT_LE(wide.error, 8 * spread);
  }
  const Interval all(-1, 1);
  EXPECT_LE(RotationOf({all, all, all, all}).error, 2.8);
  EXPECT_GE(RotationOf({all, all, all, all}).error, 1);
  EXPECT_EQ(RotationOf(UnitQuaternion(Eigen::Quaterniond::Identity())).error, 0);
}

}  // namespace
}  // namespace collision::numeric
