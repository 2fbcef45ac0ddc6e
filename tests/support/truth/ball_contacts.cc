#include "tests/support/truth/ball_contacts.h"

#include <cmath>

namespace collision {
namespace {

using Polynomial = std::vector<Real>;  // the constant first

Real Evaluate(const Polynomial& p, Real x) {
  Real value = 0;
  for (auto c = p.rbegin(); c != p.rend(); ++c) value = value * x + *c;
  return value;
}

Polynomial Derivative(const Polynomial& p) {
  Polynomial derivative;
  for (std::size_t i = 1; i < p.size(); ++i) derivative.push_back(p[i] * static_cast<Real>(i));
  return derivative;
}

/// Where p changes sign in (lo, hi): between two neighbouring extremes it does so at most once.
std::vector<Real> SignChanges(const Polynomial& p, Real lo, Real hi) {
  if (p.size() < 2) return {};
  std::vector<Real> stops = {lo};
  for (const Real x : SignChanges(Derivative(p), lo, hi)) stops.push_back(x);
  stops.push_back(hi);
  std::vector<Real> roots;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    Real left = stops[i], right = stops[i + 1];
    const bool negative = Evaluate(p, left) < 0;
    if ((Evaluate(p, right) < 0) == negative) continue;
    for (int step = 0; step < 100; ++step) {
      const Real middle = (left + right) / 2;
      ((Evaluate(p, middle) < 0) == negative ? left : right) = middle;
    }
    roots.push_back((left + right) / 2);
  }
  return roots;
}

/// |d|² − reach² for d = p + v τ + ½ a τ², τ in seconds since t_ns.
Polynomial Gap(const MotionPiece& a, const MotionPiece& b, Real reach, std::int64_t t_ns) {
  const TruePose at_a = a.TrueAt(t_ns), at_b = b.TrueAt(t_ns);
  const Vector p = at_b.p - at_a.p, v = at_b.v - at_a.v;
  const Vector h = (b.a.cast<Real>() - a.a.cast<Real>()) / 2;
  return {p.dot(p) - reach * reach, 2 * p.dot(v), v.dot(v) + 2 * p.dot(h), 2 * v.dot(h), h.dot(h)};
}

bool Jumps(const PiecewiseMotion& motion, std::int64_t t_ns) {
  return std::binary_search(motion.jumps_ns.begin(), motion.jumps_ns.end(), t_ns);
}

}  // namespace

std::vector<BallContact> BallContacts(const PiecewiseMotion& a, const PiecewiseMotion& b,
                                      double reach, std::int64_t from_ns, std::int64_t to_ns) {
  std::vector<BallContact> contacts;
  bool touching = false;
  for (std::int64_t start = from_ns; start < to_ns;) {
    const std::int64_t end = std::min({a.At(start).end_ns, b.At(start).end_ns, to_ns});
    const Real duration = static_cast<Real>(end - start) * 1e-9L;
    const Polynomial gap = Gap(a.At(start), b.At(start), reach, start);
    const bool jumped = start == from_ns || Jumps(a, start) || Jumps(b, start);
    if (jumped && touching) contacts.back().ends_in_motion = false;
    const auto instant = [start](Real tau) {
      return start + static_cast<std::int64_t>(std::floor(tau * 1e9L));
    };
    std::vector<Real> stops = SignChanges(gap, 0, duration);
    stops.insert(stops.begin(), 0);
    stops.push_back(duration);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const bool inside = Evaluate(gap, (stops[i] + stops[i + 1]) / 2) < 0;
      if (inside && (!touching || (i == 0 && jumped))) {
        contacts.push_back({.begin_ns = instant(stops[i]), .begins_in_motion = i > 0 || !jumped});
      }
      touching = inside;
      if (!inside) continue;
      BallContact& contact = contacts.back();
      contact.end_ns = instant(stops[i + 1]);
      std::vector<Real> extremes = SignChanges(Derivative(gap), stops[i], stops[i + 1]);
      extremes.push_back(stops[i]);
      extremes.push_back(stops[i + 1]);
      for (const Real tau : extremes) {
        const Real square = std::max(Real(0), Evaluate(gap, tau) + Real(reach) * reach);
        contact.depth = std::max(contact.depth, static_cast<double>(reach - std::sqrt(square)));
      }
    }
    start = end;
  }
  if (touching) contacts.back().ends_in_motion = false;
  return contacts;
}

}  // namespace collision
