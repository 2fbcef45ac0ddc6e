// Signs of polynomials over stretches of the line, proved in exact arithmetic.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <vector>

#include "tests/support/truth/exact_dyadic.h"

namespace collision {

/// A polynomial of degree 6 at most; the constant first.
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
  std::array<Dyadic, 7> c_;  // Zero from size_ on.
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

/// The coefficients of p, times a positive number, in the Bernstein basis of [lo, lo + width], as
/// many as p's degree needs: 5, or 7 above degree 4. p = c[0] + c[1] (x − lo) + ….
inline std::vector<Dyadic> BernsteinOf(DyadicPolynomial c, const Dyadic& width) {
  // 12 b_k = 12 Σ_i C(k, i) / C(4, i) c_i width^i, and 60 b_k with C(6, i).
  static constexpr int kOf4[5][5] = {
      {12, 0, 0, 0, 0}, {12, 3, 0, 0, 0}, {12, 6, 2, 0, 0}, {12, 9, 6, 3, 0}, {12, 12, 12, 12, 12}};
  static constexpr int kOf6[7][7] = {{60, 0, 0, 0, 0, 0, 0},      {60, 10, 0, 0, 0, 0, 0},
                                     {60, 20, 4, 0, 0, 0, 0},     {60, 30, 12, 3, 0, 0, 0},
                                     {60, 40, 24, 12, 4, 0, 0},   {60, 50, 40, 30, 20, 10, 0},
                                     {60, 60, 60, 60, 60, 60, 60}};
  const std::size_t size = c.size() > 5 ? 7 : 5;
  c.resize(size);
  Dyadic power = width;
  for (std::size_t i = 1; i < size; ++i) {
    c[i] = power * c[i];
    power = power * width;
  }
  std::vector<Dyadic> bernstein(size);
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t i = 0; i <= k; ++i) {
      bernstein[k] = bernstein[k] + Dyadic::Integer(size == 7 ? kOf6[k][i] : kOf4[k][i]) * c[i];
    }
  }
  return bernstein;
}

/// A cheap sufficient proof that p > 0 on [lo, hi), or, without `hi`, on [lo, +infinity): in the
/// Bernstein basis of the stretch, of up to 2^depth parts of it, all coefficients are positive (the
/// last may be 0).
inline bool PositiveByBernstein(const DyadicPolynomial& p, const Dyadic& lo,
                                const std::optional<Dyadic>& hi, int depth) {
  const DyadicPolynomial c = Shifted(p, lo);
  if (c.empty() || c[0].Sign() <= 0) return false;
  if (!hi) return std::all_of(c.begin(), c.end(), [](const Dyadic& x) { return x.Sign() >= 0; });
  const std::vector<Dyadic> b = BernsteinOf(c, *hi - lo);
  const bool positive =
      std::all_of(b.begin(), b.end() - 1, [](const Dyadic& x) { return x.Sign() > 0; }) &&
      b.back().Sign() >= 0;
  if (positive || depth == 0) return positive;
  if (ValueAt(p, *hi).Sign() < 0) return false;
  const Dyadic middle = (lo + *hi).Scaled(-1);
  return PositiveByBernstein(p, lo, middle, depth - 1) &&
         PositiveByBernstein(p, middle, hi, depth - 1);
}

/// Is at every x in [lo, hi) one of these below 0? Proved on ever smaller stretches; false may also
/// mean that 2^-depth of the whole was not small enough.
inline bool OneIsNegative(const std::vector<DyadicPolynomial>& all, const Dyadic& lo,
                          const Dyadic& hi, int depth) {
  for (const DyadicPolynomial& p : all) {
    const std::vector<Dyadic> b = BernsteinOf(Shifted(p, lo), hi - lo);
    if (std::all_of(b.begin(), b.end() - 1, [](const Dyadic& x) { return x.Sign() < 0; }) &&
        b.back().Sign() <= 0) {
      return true;
    }
  }
  if (depth == 0) return false;
  const bool none_at_lo = std::all_of(all.begin(), all.end(), [&](const DyadicPolynomial& p) {
    return ValueAt(p, lo).Sign() >= 0;
  });
  if (none_at_lo) return false;
  const Dyadic middle = (lo + hi).Scaled(-1);
  return OneIsNegative(all, lo, middle, depth - 1) && OneIsNegative(all, middle, hi, depth - 1);
}

/// The same without an end: there one that stays below 0 is looked for beyond 2^50.
inline bool OneIsNegativeFrom(const std::vector<DyadicPolynomial>& all, const Dyadic& lo) {
  const Dyadic far = lo.Magnitude() + Dyadic(0x1p50);
  return OneIsNegative(all, lo, far, 100) &&
         std::any_of(all.begin(), all.end(), [&](const DyadicPolynomial& p) {
           return PositiveByBernstein(Dyadic(-1.0) * p, far, std::nullopt, 0);
         });
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
