#include "client/checker/motion/motion.h"

#include <algorithm>
#include <cmath>

namespace collision::checker {
namespace {

using Triple = std::array<long double, 3>;

constexpr int kTermsMax = 64;  // a step of half a radian needs about 20
constexpr long double kTermMin = 1e-22L;

Quaternion Product(const Quaternion& p, const Quaternion& q) {
  return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
          p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
          p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
          p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

Quaternion Unit(const Quaternion& q) {
  const long double n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {q[0] / n, q[1] / n, q[2] / n, q[3] / n};
}

Triple RateAt(const Turn& turn, long double s) {
  return {turn.w[0] + turn.b[0] * s, turn.w[1] + turn.b[1] * s, turn.w[2] + turn.b[2] * s};
}

long double LengthOf(const Triple& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

Quaternion Series(const Quaternion& q0, const Triple& w, const std::array<double, 3>& b,
                  long double h) {
  const Quaternion rate = {0, w[0], w[1], w[2]};
  const Quaternion change = {0, b[0], b[1], b[2]};
  Quaternion before{}, term = q0, sum = q0;  // coefficients times h^n
  for (int n = 0; n < kTermsMax; ++n) {
    const Quaternion by_rate = Product(rate, term);
    const Quaternion by_change = Product(change, before);
    before = term;
    long double size = 0;
    for (int k = 0; k < 4; ++k) {
      term[k] = (by_rate[k] + by_change[k] * h) * h / (2 * (n + 1));
      sum[k] += term[k];
      size = std::max({size, std::fabs(term[k]), std::fabs(before[k])});
    }
    if (size < kTermMin) break;
  }
  return Unit(sum);
}

std::array<std::array<long double, 3>, 3> Matrix(const Quaternion& q) {
  const auto [w, x, y, z] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

Quaternion OrientationOf(const Piece& piece, long double seconds) {
  return piece.turn ? OrientationAt(*piece.turn, seconds) : Quaternion{1, 0, 0, 0};
}

// |ω| is greatest at one of the ends, as ω is linear.
long double RateMax(const Piece& piece, long double s0, long double s1) {
  if (!piece.turn) return 0;
  return std::max(LengthOf(RateAt(*piece.turn, s0)), LengthOf(RateAt(*piece.turn, s1)));
}

// The greatest |c1 + 2 c2 s + 3 c3 s²| on [s0, s1].
long double SlopeMax(const std::array<long double, 4>& c, long double s0, long double s1) {
  const auto slope = [&](long double s) { return std::fabs(c[1] + s * (2 * c[2] + s * 3 * c[3])); };
  long double most = std::max(slope(s0), slope(s1));
  const long double turning = c[3] != 0 ? -c[2] / (3 * c[3]) : s0;
  if (turning > s0 && turning < s1) most = std::max(most, slope(turning));
  return most;
}

}  // namespace

Quaternion OrientationAt(const Turn& turn, long double seconds) {
  Quaternion q = Unit({turn.q[0], turn.q[1], turn.q[2], turn.q[3]});
  const long double rate = std::max(LengthOf(RateAt(turn, 0)), LengthOf(RateAt(turn, seconds)));
  const int steps = std::max(1, static_cast<int>(std::ceil(rate * std::fabs(seconds))));
  const long double h = seconds / steps;
  for (int i = 0; i < steps; ++i) q = Series(q, RateAt(turn, i * h), turn.b, h);
  return q;
}

Cubic3 Shifted(const Piece& piece, std::int64_t start_ns) {
  const long double s = static_cast<long double>(start_ns - piece.t0_ns) * 1e-9L;
  Cubic3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& c = piece.p_WA[axis];
    result[axis] = {c[0] + s * (c[1] + s * (c[2] + s * c[3])), c[1] + s * (2 * c[2] + s * 3 * c[3]),
                    c[2] + s * 3 * c[3], c[3]};
  }
  return result;
}

PairMotion::PairMotion(const Piece& a, const Piece& b, std::int64_t from_ns)
    : a_(a),
      b_(b),
      since_a_(static_cast<long double>(from_ns - a.t0_ns) * 1e-9L),
      since_b_(static_cast<long double>(from_ns - b.t0_ns) * 1e-9L),
      difference_(Shifted(b, from_ns)) {
  const Cubic3 of_a = Shifted(a, from_ns);
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 4; ++k) difference_[axis][k] -= of_a[axis][k];
  }
}

Pose PairMotion::At(long double seconds) const {
  const Quaternion q_A = OrientationOf(a_, since_a_ + seconds);
  const Quaternion q_B = OrientationOf(b_, since_b_ + seconds);
  const auto R_A = Matrix(q_A);
  const auto R_AB = Matrix(Product({q_A[0], -q_A[1], -q_A[2], -q_A[3]}, q_B));
  Triple d, p{};
  for (int k = 0; k < 3; ++k) {
    const auto& c = difference_[k];
    d[k] = c[0] + seconds * (c[1] + seconds * (c[2] + seconds * c[3]));
  }
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) p[i] += R_A[k][i] * d[k];
    pose.R_AB[i] = {static_cast<double>(R_AB[i][0]), static_cast<double>(R_AB[i][1]),
                    static_cast<double>(R_AB[i][2])};
  }
  pose.p_AB = {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  return pose;
}

long double PairMotion::SpeedMax(long double s0, long double s1, double reach_a,
                                 double reach_b) const {
  constexpr long double kRounding = 1 + 1e-12L;
  Triple slope;
  for (int axis = 0; axis < 3; ++axis) slope[axis] = SlopeMax(difference_[axis], s0, s1);
  const long double turning = RateMax(a_, since_a_ + s0, since_a_ + s1) * reach_a +
                              RateMax(b_, since_b_ + s0, since_b_ + s1) * reach_b;
  return (LengthOf(slope) + turning) * kRounding;
}

}  // namespace collision::checker
