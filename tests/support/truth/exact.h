// Exact rational arithmetic: the oracle for everything that rounds.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <cstdint>
#include <vector>

#include "collision_core/base/instant.h"
#include "collision_core/numeric/interval.h"

namespace collision {

/// Any finite double converts to it without error. Link with gmp.
using Exact = boost::multiprecision::mpq_rational;

/// Does the interval contain an exact value? Its ends may be infinite.
inline bool Contains(const numeric::Interval& interval, const Exact& value) {
  return (std::isinf(interval.lower) ? interval.lower < 0 : Exact(interval.lower) <= value) &&
         (std::isinf(interval.upper) ? interval.upper > 0 : value <= Exact(interval.upper));
}

/// The exact seconds between two instants.
inline Exact ExactSeconds(Instant from, Instant to) {
  return (Exact(to.nanoseconds()) - Exact(from.nanoseconds())) / Exact(1000000000);
}

/// A polynomial, the constant first.
using ExactPolynomial = std::vector<Exact>;

inline Exact Evaluate(const ExactPolynomial& p, const Exact& x) {
  Exact value = 0;
  for (auto c = p.rbegin(); c != p.rend(); ++c) value = value * x + *c;
  return value;
}

inline ExactPolynomial Multiply(const ExactPolynomial& a, const ExactPolynomial& b) {
  ExactPolynomial product(a.size() + b.size() - 1, Exact(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  }
  return product;
}

/// The number of different real roots in (lo, hi], by Sturm's theorem. The polynomial must not be
/// zero.
inline int CountRoots(ExactPolynomial p, const Exact& lo, const Exact& hi) {
  const auto trim = [](ExactPolynomial& q) {
    while (!q.empty() && q.back() == 0) q.pop_back();
  };
  trim(p);
  std::vector<ExactPolynomial> chain = {p, {}};
  for (std::size_t i = 1; i < p.size(); ++i) chain[1].push_back(p[i] * Exact(i));
  while (!chain.back().empty()) {
    ExactPolynomial remainder = chain[chain.size() - 2];
    const ExactPolynomial& divisor = chain.back();
    while (remainder.size() >= divisor.size()) {
      const Exact factor = remainder.back() / divisor.back();
      const std::size_t shift = remainder.size() - divisor.size();
      for (std::size_t i = 0; i < divisor.size(); ++i) remainder[i + shift] -= factor * divisor[i];
      remainder.pop_back();
    }
    trim(remainder);
    for (Exact& c : remainder) c = -c;
    chain.push_back(remainder);
  }
  const auto changes = [&chain](const Exact& x) {
    int count = 0, last = 0;
    for (const ExactPolynomial& q : chain) {
      const int sign = q.empty() ? 0 : Evaluate(q, x).sign();
      if (sign != 0 && last != 0 && sign != last) ++count;
      if (sign != 0) last = sign;
    }
    return count;
  };
  return changes(lo) - changes(hi);
}

}  // namespace collision
