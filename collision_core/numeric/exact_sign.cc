#include "collision_core/numeric/exact_sign.h"

#include <array>
#include <cmath>
#include <vector>

#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::numeric {
namespace {

/// Shewchuk's bounds for ORIENT2D (three roundings in each product, one in the difference) and
/// ORIENT3D, relative to the magnitudes of the terms.
constexpr double kOrient2dError = (3 + 16 * kUnitRoundoff) * kUnitRoundoff;
constexpr double kOrient3dError = (7 + 56 * kUnitRoundoff) * kUnitRoundoff;

/// Below it the filters do not decide: their error bounds do not count underflow.
constexpr double kFilterSmallest = 0x1p-900;

/// A sum of doubles that do not overlap, smallest first (Shewchuk, "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates", 1997). No component is zero, so
/// the last one has the sign of the sum.
class Expansion {
 public:
  Expansion() = default;

  /// a − b.
  static Expansion Difference(double a, double b) {
    Expansion e;
    e.Add(a);
    e.Add(-b);
    return e;
  }

  /// Shewchuk's GROW-EXPANSION: the error of each sum stays behind, exactly.
  void Add(double x) {
    std::size_t kept = 0;
    for (const double term : terms_) {
      const double sum = x + term;
      const double part = sum - x;
      const double error = (x - (sum - part)) + (term - part);
      if (error != 0) terms_[kept++] = error;
      x = sum;
    }
    terms_.resize(kept);
    if (x != 0) terms_.push_back(x);
  }

  void Add(const Expansion& other, double sign) {
    for (const double term : other.terms_) Add(sign * term);
    is_exact_ = is_exact_ && other.is_exact_;
  }

  Expansion operator*(const Expansion& other) const {
    Expansion product;
    product.is_exact_ = is_exact_ && other.is_exact_;
    for (const double a : terms_) {
      for (const double b : other.terms_) {
        const double high = a * b;
        if (!ErrorIsExact(high)) {
          product.is_exact_ = false;
          continue;
        }
        product.Add(ProductError(a, b, high));
        product.Add(high);
      }
    }
    return product;
  }

  std::optional<int> sign() const {
    if (!is_exact_) return std::nullopt;
    return terms_.empty() ? 0 : terms_.back() > 0 ? 1 : -1;
  }

 private:
  std::vector<double> terms_;
  bool is_exact_ = true;
};

/// x_1 y_2 − x_2 y_1.
Expansion Cross(const Expansion& x1, const Expansion& y1, const Expansion& x2,
                const Expansion& y2) {
  Expansion cross = x1 * y2;
  cross.Add(x2 * y1, -1);
  return cross;
}

int SignOf(double x) { return x > 0 ? 1 : -1; }

}  // namespace

std::optional<int> OrientationSign(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                   const Eigen::Vector2d& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double det = left - right;
  const double error = kOrient2dError * (std::abs(left) + std::abs(right));
  if (std::abs(det) > error && std::abs(det) > kFilterSmallest) return SignOf(det);
  return Cross(Expansion::Difference(b.x(), a.x()), Expansion::Difference(b.y(), a.y()),
               Expansion::Difference(c.x(), a.x()), Expansion::Difference(c.y(), a.y()))
      .sign();
}

std::optional<int> OrientationSign(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  const Eigen::Vector3d u = b - a, v = c - a, w = p - a;
  double det = 0, permanent = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double left = u[j] * v[k], right = u[k] * v[j];
    det += w[i] * (left - right);
    permanent += std::abs(w[i]) * (std::abs(left) + std::abs(right));
  }
  const double error = kOrient3dError * permanent;
  if (std::abs(det) > error && std::abs(det) > kFilterSmallest) return SignOf(det);

  std::array<Expansion, 3> e, f, g;
  for (int i = 0; i < 3; ++i) {
    e[i] = Expansion::Difference(b[i], a[i]);
    f[i] = Expansion::Difference(c[i], a[i]);
    g[i] = Expansion::Difference(p[i], a[i]);
  }
  Expansion sum;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum.Add(g[i] * Cross(e[j], e[k], f[j], f[k]), 1);
  }
  return sum.sign();
}

bool IsCertainlyCollinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const auto sign = OrientationSign(Eigen::Vector2d(a[i], a[j]), Eigen::Vector2d(b[i], b[j]),
                                      Eigen::Vector2d(c[i], c[j]));
    if (sign != 0) return false;
  }
  return true;
}

}  // namespace collision::numeric
