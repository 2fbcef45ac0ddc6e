// Signs of polynomials over stretches of the line, proved in exact arithmetic.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <vector>

#include "tests/support/truth/exact_dyadic.h"

namespace collision {

/// A polynomial of degree 4 at most; the constant first.
class DyadicPolynomial {
 public:
  DyadicPolynomial() = default;
  explicit DyadicPolynomial(std::size_t size) : size_(size) {}
  DyadicPolynomial(std::initializer_list<Dyadic> c) : size_(c.size()) {
    std::copy(c.begin(), c.end(), c_.begin());
  }
  DyadicPolynomial(const DyadicPolynomial& other) : size_(other.size_) {
    std::copy(other.begin(), other.end(), begin());
  }
  DyadicPolynomial(DyadicPolynomial&&) = default;
  DyadicPolynomial& operator=(DyadicPolynomial other) {
    c_.swap(other.c_);
    size_ = other.size_;
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  Dyadic& operator[](std::size_t i) { return c_[i]; }
  const Dyadic& operator[](std::size_t i) const { return c_[i]; }
  Dyadic* begin() { return c_.data(); }
  Dyadic* end() { return c_.data() + size_; }
  const Dyadic* begin() const { return c_.data(); }
  const Dyadic* end() const { return c_.data() + size_; }
  const Dyadic& back() const { return c_[size_ - 1]; }
  void push_back(Dyadic c) { c_[size_++] = std::move(c); }
  void pop_back() { c_[--size_] = {}; }
  void resize(std::size_t size) { size_ = size; }

 private:
  std::array<Dyadic, 5> c_;  // Zero from size_ on.
  std::size_t size_ = 0;
};

inline DyadicPolynomial operator+(const DyadicPolynomial& a, const DyadicPolynomial& b) {
  DyadicPolynomial sum(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] = a[i];
  for (std::size_t i = 0; i < b.size(); ++i) sum[i] = sum[i] + b[i];
  return sum;
}

inline DyadicPolynomial operator*(const Dyadic& s, DyadicPolynomial a) {
  for (Dyadic& c : a) c = s * c;
  return a;
}

inline DyadicPolynomial operator*(const DyadicPolynomial& a, const DyadicPolynomial& b) {
  if (a.empty() || b.empty()) return {};
  DyadicPolynomial product(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] = product[i + j] + a[i] * b[j];
  }
  return product;
}

inline Dyadic ValueAt(const DyadicPolynomial& p, const Dyadic& x) {
  Dyadic value;
  for (std::size_t i = p.size(); i-- > 0;) value = value * x + p[i];
  return value;
}

/// p(x + start).
inline DyadicPolynomial Shifted(DyadicPolynomial p, const Dyadic& start) {
  if (start.Sign() == 0) return p;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    for (std::size_t j = p.size() - 1; j-- > i;) p[j] = p[j] + start * p[j + 1];
  }
  return p;
}

/// Sturm's chain, free of fractions: each remainder is multiplied by a positive number.
class SturmChain {
 public:
  explicit SturmChain(DyadicPolynomial p) {
    Trim(&p);
    DyadicPolynomial derivative;
    for (std::size_t i = 1; i < p.size(); ++i) {
      derivative.push_back(Dyadic::Integer(static_cast<std::int64_t>(i)) * p[i]);
    }
    chain_ = {std::move(p), std::move(derivative)};
    while (!chain_.back().empty()) {
      chain_.push_back(NegativeRemainder(chain_[chain_.size() - 2], chain_.back()));
    }
    chain_.pop_back();
  }

  /// The number of different roots in (lo, hi]; without `hi`, in (lo, +infinity). A polynomial that
  /// is not zero.
  int RootsIn(const Dyadic& lo, const std::optional<Dyadic>& hi) const {
    return ChangesAt(lo) - ChangesAt(hi);
  }

 private:
  static void Trim(DyadicPolynomial* p) {
    while (!p->empty() && p->back().Sign() == 0) p->pop_back();
  }

  static DyadicPolynomial NegativeRemainder(DyadicPolynomial a, const DyadicPolynomial& b) {
    const Dyadic lead = b.back().Magnitude();
    const int sign = b.back().Sign();
    while (a.size() >= b.size()) {
      const Dyadic factor = sign > 0 ? a.back() : -a.back();
      const std::size_t shift = a.size() - b.size();
      a.pop_back();
      for (Dyadic& c : a) c = lead * c;
      for (std::size_t i = 0; i + 1 < b.size(); ++i) {
        a[i + shift] = a[i + shift] - factor * b[i];
      }
    }
    Trim(&a);
    for (Dyadic& c : a) c = -c;
    return a;
  }

  int ChangesAt(const std::optional<Dyadic>& x) const {
    int count = 0, last = 0;
    for (const DyadicPolynomial& p : chain_) {
      const int sign = x ? ValueAt(p, *x).Sign() : p.back().Sign();
      if (sign != 0 && last != 0 && sign != last) ++count;
      if (sign != 0) last = sign;
    }
    return count;
  }

  std::vector<DyadicPolynomial> chain_;
};

/// Proofs that were enough, to be reported.
struct ProofCounts {
  std::uint64_t bernstein = 0, sturm = 0;
};

/// A cheap sufficient proof that p > 0 on [lo, hi), or, without `hi`, on [lo, +infinity): in the
/// Bernstein basis of the stretch, of up to 2^depth parts of it, all coefficients are positive (the
/// last may be 0). p has degree 4 at most.
inline bool PositiveByBernstein(const DyadicPolynomial& p, const Dyadic& lo,
                                const std::optional<Dyadic>& hi, int depth) {
  DyadicPolynomial c = Shifted(p, lo);
  if (c.empty() || c[0].Sign() <= 0) return false;
  if (!hi) return std::all_of(c.begin(), c.end(), [](const Dyadic& x) { return x.Sign() >= 0; });
  c.resize(5);
  const Dyadic width = *hi - lo;
  Dyadic power = width;
  for (int i = 1; i < 5; ++i) {
    c[i] = power * c[i];
    power = power * width;
  }
  // 12 b_k = 12 Σ_i C(k, i) / C(4, i) c_i.
  static constexpr int kWeights[5][5] = {
      {12, 0, 0, 0, 0}, {12, 3, 0, 0, 0}, {12, 6, 2, 0, 0}, {12, 9, 6, 3, 0}, {12, 12, 12, 12, 12}};
  bool positive = true;
  for (int k = 1; k < 5 && positive; ++k) {
    Dyadic b;
    for (int i = 0; i <= k; ++i) b = b + Dyadic::Integer(kWeights[k][i]) * c[i];
    positive = k < 4 ? b.Sign() > 0 : b.Sign() >= 0;
  }
  if (positive || depth == 0) return positive;
  if (ValueAt(p, *hi).Sign() < 0) return false;
  const Dyadic middle = (lo + *hi).Scaled(-1);
  return PositiveByBernstein(p, lo, middle, depth - 1) &&
         PositiveByBernstein(p, middle, hi, depth - 1);
}

/// Is p > 0 on all of [lo, hi), or [lo, +infinity)? Always decided: by Sturm's theorem at the
/// latest.
inline bool IsPositive(const DyadicPolynomial& p, const Dyadic& lo, const std::optional<Dyadic>& hi,
                       ProofCounts* counts) {
  if (hi && *hi <= lo) return true;
  if (PositiveByBernstein(p, lo, hi, 4)) {
    ++counts->bernstein;
    return true;
  }
  ++counts->sturm;
  if (ValueAt(p, lo).Sign() <= 0) return false;
  const int at_end = hi && ValueAt(p, *hi).Sign() == 0;
  return SturmChain(p).RootsIn(lo, hi) == at_end;
}

/// The sign of a + b √d, d >= 0.
inline int SignWithRoot(const Dyadic& a, const Dyadic& b, const Dyadic& d) {
  const int sign_a = a.Sign(), sign_b = d.Sign() == 0 ? 0 : b.Sign();
  if (sign_a * sign_b >= 0) return sign_a != 0 ? sign_a : sign_b;
  return (a * a - b * b * d).Sign() > 0 ? sign_a : (a * a - b * b * d).Sign() < 0 ? sign_b : 0;
}

/// A real root of a quadratic, exactly: (a + b √d) / c, c > 0, b = −1, 0 or 1.
struct QuadraticRoot {
  Dyadic a, b, d, c;

  /// The sign of q there, of degree 2 at most:
  /// c² q = c² q0 + c q1 (a + b√d) + q2 (a² + b²d + 2ab√d).
  int SignOf(const DyadicPolynomial& q) const {
    const Dyadic rational = c * c * q[0] + c * q[1] * a + q[2] * (a * a + b * b * d);
    return SignWithRoot(rational, c * q[1] * b + Dyadic::Integer(2) * q[2] * a * b, d);
  }
};

/// The real roots of a quadratic with three coefficients that is not constant.
inline std::vector<QuadraticRoot> RootsOf(const DyadicPolynomial& q) {
  if (q[2].Sign() == 0) {
    if (q[1].Sign() == 0) return {};
    const bool falls = q[1].Sign() < 0;
    return {{falls ? q[0] : -q[0], {}, {}, q[1].Magnitude()}};
  }
  const Dyadic d = q[1] * q[1] - Dyadic::Integer(4) * q[0] * q[2];
  if (d.Sign() < 0) return {};
  const Dyadic middle = q[2].Sign() < 0 ? q[1] : -q[1];
  const Dyadic c = Dyadic::Integer(2) * q[2].Magnitude();
  return {{middle, -1.0, d, c}, {middle, 1.0, d, c}};
}

}  // namespace collision
