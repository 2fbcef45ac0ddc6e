#include "client/checker/shape/round_core.h"

#include <stdexcept>

#include "client/checker/shape/placement.h"

namespace collision::checker {
namespace {

Vector EllipsoidSupport(const Vector& half, const Vector& d) {
  const Vector scaled{half.x * d.x, half.y * d.y, half.z * d.z};
  const double length = Length(scaled);
  if (!(length > 0)) return {};
  return {half.x * scaled.x / length, half.y * scaled.y / length, half.z * scaled.z / length};
}

// Of the disc of this radius at height z.
Vector DiscSupport(double radius, double z, const Vector& d) {
  const double across = std::hypot(d.x, d.y);
  if (!(across > 0)) return {0, 0, z};
  return {radius * d.x / across, radius * d.y / across, z};
}

// The greatest distance of a point of the ellipsoid from q. For every ν >= all a_i², and x in it,
//   |x − q|² <= |x − q|² + ν (1 − Σ x_i²/a_i²) <= ν + Σ q_i² ν / (ν − a_i²),
// the maximum over all x. It is convex in ν, and its least value is the square wanted.
double FurthestOfEllipsoid(const Vector& half, const Vector& q) {
  const double longest = std::max({half.x, half.y, half.z}), away = Length(q);
  if (away == 0) return longest;
  const auto bound = [&](double nu) {
    double sum = nu;
    for (int i = 0; i < 3; ++i) sum += q[i] * q[i] * nu / (nu - half[i] * half[i]);
    return sum;
  };
  double low = longest * longest * (1 + 1e-15), high = longest * (longest + away) * (1 + 1e-12);
  for (int i = 0; i < 200; ++i) {
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    (bound(left) < bound(right) ? high : low) = bound(left) < bound(right) ? right : left;
  }
  return std::min(std::sqrt(bound(high)), longest + away);
}

}  // namespace

std::optional<RoundCore::Kind> RoundCore::KindOf(const std::string& word) {
  if (word == "ellipsoid") return Kind::kEllipsoid;
  if (word == "cylinder") return Kind::kCylinder;
  if (word == "cone") return Kind::kCone;
  return std::nullopt;
}

RoundCore::RoundCore(Kind kind, const Vector& half, const std::array<double, 4>& q, const Vector& p)
    : kind_(kind), half_(half), p_(p) {
  if (!(half.x >= 0 && half.y >= 0 && half.z >= 0)) throw std::runtime_error("a negative length");
  const auto axes = Placed({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, q, {});
  axes_ = {axes[0], axes[1], axes[2]};
}

Vector RoundCore::Support(const Vector& direction) const {
  const Vector d{Dot(axes_[0], direction), Dot(axes_[1], direction), Dot(axes_[2], direction)};
  Vector x;
  if (kind_ == Kind::kEllipsoid) x = EllipsoidSupport(half_, d);
  if (kind_ == Kind::kCylinder) x = DiscSupport(half_.x, d.z < 0 ? -half_.z : half_.z, d);
  if (kind_ == Kind::kCone) {
    const Vector apex{0, 0, half_.z}, rim = DiscSupport(half_.x, -half_.z, d);
    x = Dot(d, apex) > Dot(d, rim) ? apex : rim;
  }
  return x.x * axes_[0] + x.y * axes_[1] + x.z * axes_[2] + p_;
}

double RoundCore::reach() const {
  return kind_ == Kind::kEllipsoid ? std::max({half_.x, half_.y, half_.z})
                                   : std::hypot(half_.x, half_.z);
}

double RoundCore::radius_m() const {
  const Vector q{-Dot(axes_[0], p_), -Dot(axes_[1], p_), -Dot(axes_[2], p_)};
  if (kind_ == Kind::kEllipsoid) return FurthestOfEllipsoid(half_, q);
  const double across = std::hypot(q.x, q.y) + half_.x;
  if (kind_ == Kind::kCylinder) return std::hypot(across, std::fabs(q.z) + half_.z);
  return std::max(std::hypot(across, q.z + half_.z), Length(Vector{0, 0, half_.z} - q));
}

}  // namespace collision::checker
