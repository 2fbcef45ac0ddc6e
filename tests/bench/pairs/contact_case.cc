#include "tests/bench/pairs/contact_case.h"

#include <cmath>

namespace collision::bench {
namespace {

std::array<double, 4> Product(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

}  // namespace

MovingBody MovingBody::Box(const Triple& half, const Triple& p, const Triple& v) {
  MovingBody body;
  body.half = half, body.p = p, body.v = v;
  return body;
}

MovingBody MovingBody::Ball(double radius, const Triple& p, const Triple& v) {
  MovingBody body = Box({radius, radius, radius}, p, v);
  body.kind = Kind::kBall;
  return body;
}

MovingBody MovingBody::After(double seconds) const {
  MovingBody after = *this;
  for (int i = 0; i < 3; ++i) after.p[i] += seconds * v[i];
  const double rate = std::hypot(w[0], w[1], w[2]);
  if (rate == 0) return after;
  const double half_angle = rate * seconds / 2, share = std::sin(half_angle) / rate;
  after.q = Product({std::cos(half_angle), share * w[0], share * w[1], share * w[2]}, q);
  return after;
}

}  // namespace collision::bench
