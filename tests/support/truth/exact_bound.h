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

/// One horn with time counted from `base`: p(δ) = p + v δ, u(δ) as a polynomial.
struct ExactHorn {
  std::array<Exact, 3> p, v;
  ExactPolynomial u;

  /// `direction` +1: forward of the stamp, −1: backward. With skew, |v| must be rational.
  ExactHorn(const motion::SpaceTimeBound& bound, Instant base, int direction = 1) {
    const Exact tau = ExactSeconds(bound.state.stamp, base);
    Exact square = 0;
    for (int i = 0; i < 3; ++i) {
      v[i] = Exact(bound.state.v_WA[i]);
      p[i] = Exact(bound.state.p_WA[i]) + v[i] * tau;
      square += v[i] * v[i];
    }
    const Exact kappa(bound.skew), half_max = Exact(bound.limits.acceleration_max) / 2;
    const ExactPolynomial sigma = {direction * tau + kappa, Exact(direction)};
    ExactPolynomial longer = sigma;
    longer[0] += Exact(bound.limits.time_step);
    u = Multiply({half_max}, Multiply(sigma, longer));
    const Exact velocity_error(bound.state.velocity_error);
    u[0] += Exact(bound.state.position_error) + velocity_error * sigma[0];
    u[1] += velocity_error * sigma[1];
    if (bound.skew > 0) u[0] += ExactRoot(square) * kappa;
  }
};

}  // namespace collision
