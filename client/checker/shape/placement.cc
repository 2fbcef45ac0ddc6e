#include "client/checker/shape/placement.h"

#include <stdexcept>

namespace collision::checker {

std::vector<Vector> Placed(std::vector<Vector> points, const std::array<double, 4>& given,
                           const Vector& p) {
  long double length = 0;
  for (const double c : given) length = std::hypot(length, static_cast<long double>(c));
  if (!(length > 0) || !std::isfinite(length))
    throw std::runtime_error("an orientation has no length");
  const auto q = [&](int i) { return static_cast<double>(given[i] / length); };
  const Vector axis{q(1), q(2), q(3)};
  for (Vector& v : points) {
    const Vector t = 2.0 * Cross(axis, v);  // v + w t + axis × t
    v = v + q(0) * t + Cross(axis, t) + p;
  }
  return points;
}

}  // namespace collision::checker
