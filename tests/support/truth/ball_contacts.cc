#include "tests/support/truth/ball_contacts.h"

#include <cmath>

namespace collision {
namespace {

using Polynomial = std::vector<double>;  // the constant first

double Evaluate(const Polynomial& p, double x) {
  double value = 0;
  for (auto c = p.rbegin(); c != p.rend(); ++c) value = value * x + *c;
  return value;
}

Polynomial Derivative(const Polynomial& p) {
  Polynomial derivative;
  for (std::size_t i = 1; i < p.size(); ++i) derivative.push_back(p[i] * static_cast<double>(i));
  return derivative;
}

/// Where p changes sign in (lo, hi): between two neighbouring extremes it does so at most once.
std::vector<double> SignChanges(const Polynomial& p, double lo, double hi) {
  if (p.size() < 2) return {};
  std::vector<double> stops = {lo};
  for (const double x : SignChanges(Derivative(p), lo, hi)) stops.push_back(x);
  stops.push_back(hi);
  std::vector<double> roots;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    double left = stops[i], right = stops[i + 1];
    const bool negative = Evaluate(p, left) < 0;
    if ((Evaluate(p, right) < 0) == negative) continue;
    for (int step = 0; step < 100; ++step) {
      const double middle = 0.5 * (left + right);
      ((Evaluate(p, middle) < 0) == negative ? left : right) = middle;
    }
    roots.push_back(0.5 * (left + right));
  }
  return roots;
}

/// |d|² − reach² for d = p + v τ + ½ a τ².
Polynomial Gap(const MotionPiece& a, const MotionPiece& b, double reach) {
  const Eigen::Vector3d p = b.p - a.p, v = b.v - a.v, h = 0.5 * (b.a - a.a);
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
    const double duration = static_cast<double>(end - start) * 1e-9;
    const Polynomial gap = Gap(a.At(start).From(start), b.At(start).From(start), reach);
    const bool jumped = start == from_ns || Jumps(a, start) || Jumps(b, start);
    if (jumped && touching) contacts.back().ends_in_motion = false;
    const auto instant = [start](double tau) {
      return start + static_cast<std::int64_t>(std::floor(tau * 1e9));
    };
    std::vector<double> stops = SignChanges(gap, 0, duration);
    stops.insert(stops.begin(), 0);
    stops.push_back(duration);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const bool inside = Evaluate(gap, 0.5 * (stops[i] + stops[i + 1])) < 0;
      if (inside && (!touching || (i == 0 && jumped))) {
        contacts.push_back({.begin_ns = instant(stops[i]), .begins_in_motion = i > 0 || !jumped});
      }
      touching = inside;
      if (!inside) continue;
      BallContact& contact = contacts.back();
      contact.end_ns = instant(stops[i + 1]);
      std::vector<double> extremes = SignChanges(Derivative(gap), stops[i], stops[i + 1]);
      extremes.push_back(stops[i]);
      extremes.push_back(stops[i + 1]);
      for (const double tau : extremes) {
        const double distance2 = std::max(0.0, Evaluate(gap, tau) + reach * reach);
        contact.depth = std::max(contact.depth, reach - std::sqrt(distance2));
      }
    }
    start = end;
  }
  if (touching) contacts.back().ends_in_motion = false;
  return contacts;
}

}  // namespace collision
