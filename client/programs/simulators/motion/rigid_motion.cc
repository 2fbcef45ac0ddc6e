#include "client/programs/simulators/motion/rigid_motion.h"

#include <cmath>

namespace collision::client {
namespace {

// Terms of the series. They are at most those of exp(½ |ω| h + ¼ α h²), with the limits of the
// header the coefficients of exp(x/2 + x²/4), which do not fall faster than those of exp(x²/4): the
// ones after the 26th sum to 7e-18.
constexpr int kTerms = 26;

// Changes stay inside α by this factor. Then rounding ω (below 10 rad/s, half an ulp is 9e-16)
// never makes a step of 1 ms or longer break the bound: α h 1e-6 >= 1e-10 for α = 0.1.
constexpr double kTurnInside = 1 - 1e-6;

// A little less than π/2, with room for the declared rotation error and the heading's rounding.
constexpr double kQuarter = 1.5707963 - 1e-6;

Quaternion Pure(const Vector3& v, double factor) {
  return {0, v[0] * factor, v[1] * factor, v[2] * factor};
}

Quaternion Normalised(Quaternion q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& component : q) component /= length;
  return q;
}

}  // namespace

Vector3 AtMost(const Vector3& v, double length) {
  const double norm = Norm(v);
  return norm > length ? Scaled(v, length / norm) : v;
}

Vector3 Rotated(const Quaternion& q, const Vector3& x_B) {
  const Vector3 axis = {q[1], q[2], q[3]};
  const Vector3 twice = Scaled(Cross(axis, x_B), 2);
  return Sum(Sum(x_B, Scaled(twice, q[0])), Cross(axis, twice));
}

Quaternion RandomOrientation(SeededRandom* random) {
  for (;;) {
    Quaternion q;
    double square = 0;
    for (double& component : q) {
      component = random->Uniform(-1, 1);
      square += component * component;
    }
    if (square <= 1 && square > 0.01) return Normalised(q);
  }
}

Quaternion OrientationAt(const TurnPiece& turn, std::int64_t stamp_ns) {
  const double t = static_cast<double>(stamp_ns - turn.t0_ns) * 1e-9;
  const Quaternion first = Pure(turn.angular_velocity_rad_s, t / 2);
  const Quaternion second = Pure(turn.angular_acceleration_rad_s2, t * t / 2);
  // With c_n = q_n tⁿ: (n + 1) c_{n+1} = ½ ω t c_n + ½ β t² c_{n-1}.
  Quaternion before{};
  Quaternion term = turn.orientation;
  Quaternion sum = term;
  for (int n = 0; n < kTerms; ++n) {
    const Quaternion a = Product(first, term), b = Product(second, before);
    before = term;
    for (int i = 0; i < 4; ++i) {
      term[i] = (a[i] + b[i]) / (n + 1);
      sum[i] += term[i];
    }
  }
  return Normalised(sum);
}

Vector3 AngularVelocityAt(const TurnPiece& turn, std::int64_t stamp_ns) {
  const double t = static_cast<double>(stamp_ns - turn.t0_ns) * 1e-9;
  return Sum(turn.angular_velocity_rad_s, Scaled(turn.angular_acceleration_rad_s2, t));
}

TurnPiece TurnTowards(const RigidState& state, const Vector3& angular_velocity_wanted_rad_s,
                      const TurnLimits& limits, std::int64_t t0_ns, std::int64_t t1_ns) {
  const double step = static_cast<double>(t1_ns - t0_ns) * 1e-9;
  const Vector3& w = state.angular_velocity_rad_s;
  // Both ends of the change lie in the ball of allowed ω, so the whole change does.
  const Vector3 wanted = AtMost(angular_velocity_wanted_rad_s, limits.angular_speed_max_rad_s);
  const double change_max = limits.angular_acceleration_max_rad_s2 * kTurnInside * step;
  const Vector3 change = AtMost(Difference(wanted, w), change_max);
  return {t0_ns, t1_ns, state.orientation, w, Scaled(change, step > 0 ? 1 / step : 0)};
}

double QuarterTurnSeconds(double angular_speed_rad_s, double angular_acceleration_max_rad_s2) {
  // The root of ½ α τ² + |ω| τ − q = 0 in the form without cancellation.
  const double speed = angular_speed_rad_s, twice = 2 * angular_acceleration_max_rad_s2;
  const double root = 2 * kQuarter / (speed + std::sqrt(speed * speed + twice * kQuarter));
  return root * (1 - 1e-12);
}

}  // namespace collision::client
