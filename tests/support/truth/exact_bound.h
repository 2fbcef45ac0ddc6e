// Space-time bounds in exact arithmetic, written from the definition and not from the code.
#pragma once

#include <array>

#include "collision_core/motion/space_time_bound.h"
#include "tests/support/truth/exact.h"

namespace collision {

/// The exact square root of a rational that has one: tests choose speeds like |(2, 3, 6)| = 7.
inline Exact ExactRoot(const Exact& square) {
  const auto root = [](const boost::multiprecision::mpz_int& z) {
    return boost::multiprecision::mpz_int(boost::multiprecision::sqrt(z));
  };
  return Exact(root(boost::multiprecision::numerator(square)),
               root(boost::multiprecision::denominator(square)));
}

/// One horn with time counted from `base`: p(δ) = p + v δ + h δ², u(δ) as a polynomial, of degree 3
/// if a jerk is declared, else of degree 2.
struct ExactHorn {
  std::array<Exact, 3> p, v, h;
  ExactPolynomial u;

  /// `direction` +1: forward of the stamp, −1: backward. With skew, |v| must be rational; with skew
  /// or a step, |a|.
  ExactHorn(const motion::SpaceTimeBound& bound, Instant base, int direction = 1) {
    const Exact tau = ExactSeconds(bound.state.stamp, base);
    Exact square = 0, known_square = 0;
    for (int i = 0; i < 3; ++i) {
      const Exact a(bound.state.a_WA[i]);
      v[i] = Exact(bound.state.v_WA[i]);
      square += v[i] * v[i];
      known_square += a * a;
      p[i] = Exact(bound.state.p_WA[i]) + v[i] * tau + a * tau * tau / 2;
      v[i] += a * tau;
      h[i] = a / 2;
    }
    const Exact kappa(bound.skew), step(bound.limits.time_step);
    const Exact half_max = Exact(bound.limits.acceleration_max) / 2;
    const ExactPolynomial sigma = {direction * tau + kappa, Exact(direction)};
    ExactPolynomial longer = sigma;
    longer[0] += step;
    u = Multiply({half_max}, Multiply(sigma, longer));
    Exact rate(bound.state.velocity_error);
    if (kappa + step > 0) rate += ExactRoot(known_square) * (kappa + step / 2);
    u[0] += Exact(bound.state.position_error) + rate * sigma[0];
    u[1] += rate * sigma[1];
    if (bound.skew > 0) u[0] += ExactRoot(square) * kappa;
    if (bound.limits.jerk_max > 0) {
      // ⅙ J ((σ + h)³ − h³)
      ExactPolynomial cube = Multiply(longer, Multiply(longer, longer));
      cube[0] -= step * step * step;
      u.push_back(0);
      for (int i = 0; i < 4; ++i) u[i] += Exact(bound.limits.jerk_max) / 6 * cube[i];
    }
  }
};

}  // namespace collision
