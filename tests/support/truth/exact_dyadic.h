// Exact numbers m 2^e, for oracles that must be quick: no fractions to reduce, as Exact has.
#pragma once

#include <gmp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

namespace collision {

/// Freed blocks by size, for the many small numbers of one thread: GMP says the size when it frees.
class DyadicPool {
 public:
  static void Install() { mp_set_memory_functions(Allocate, Reallocate, Free); }

 private:
  static constexpr std::size_t kStep = 16, kSizeMax = 2048;

  struct Block {
    Block* next;
  };

  static Block*& ListOf(std::size_t size) {
    static std::array<Block*, kSizeMax / kStep + 1> lists = {};
    return lists[(size + kStep - 1) / kStep];
  }
  static void* Allocate(std::size_t size) {
    if (size > kSizeMax) return std::malloc(size);
    Block*& list = ListOf(size);
    if (list == nullptr) return std::malloc((size + kStep - 1) / kStep * kStep);
    return std::exchange(list, list->next);
  }
  static void Free(void* memory, std::size_t size) {
    if (size > kSizeMax) return std::free(memory);
    Block*& list = ListOf(size);
    list = new (memory) Block{list};
  }
  static void* Reallocate(void* memory, std::size_t old_size, std::size_t size) {
    void* moved = Allocate(size);
    std::memcpy(moved, memory, std::min(old_size, size));
    Free(memory, old_size);
    return moved;
  }
};

/// An integer times a power of two; every finite double is one. Sums, differences and products are
/// exact. Link with gmp.
class Dyadic {
 public:
  Dyadic() { mpz_init(m_); }
  Dyadic(double x) {  // NOLINT: a double is a dyadic number
    mpz_init(m_);
    if (x == 0) return;
    int exponent;
    mpz_set_si(m_, static_cast<long>(std::ldexp(std::frexp(x, &exponent), 53)));
    e_ = exponent - 53;
  }
  static Dyadic Integer(std::int64_t n) {
    Dyadic x;
    mpz_set_si(x.m_, n);
    return x;
  }
  Dyadic(const Dyadic& other) : e_(other.e_) {
    mpz_init(m_);
    if (other.Sign() != 0) mpz_set(m_, other.m_);
  }
  Dyadic(Dyadic&& other) noexcept : e_(other.e_) {
    mpz_init(m_);
    mpz_swap(m_, other.m_);
  }
  Dyadic& operator=(const Dyadic& other) {
    mpz_set(m_, other.m_);
    e_ = other.e_;
    return *this;
  }
  Dyadic& operator=(Dyadic&& other) noexcept {
    mpz_swap(m_, other.m_);
    e_ = other.e_;
    return *this;
  }
  ~Dyadic() { mpz_clear(m_); }

  int Sign() const { return mpz_sgn(m_); }

  friend Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    Dyadic product;
    mpz_mul(product.m_, a.m_, b.m_);
    product.e_ = a.e_ + b.e_;
    return product;
  }
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) { return Sum(a, b, mpz_add); }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return Sum(a, b, mpz_sub); }
  friend Dyadic operator-(Dyadic a) {
    mpz_neg(a.m_, a.m_);
    return a;
  }
  friend bool operator<(const Dyadic& a, const Dyadic& b) { return (a - b).Sign() < 0; }
  friend bool operator<=(const Dyadic& a, const Dyadic& b) { return (a - b).Sign() <= 0; }

  Dyadic Magnitude() const { return Sign() < 0 ? -*this : *this; }

  /// 2^by times it.
  Dyadic Scaled(long by) const {
    Dyadic x = *this;
    x.e_ += by;
    return x;
  }

  /// The greatest integer not above it. Requires that it fits.
  std::int64_t Floor() const {
    Dyadic whole;
    if (e_ >= 0) {
      mpz_mul_2exp(whole.m_, m_, static_cast<mp_bitcnt_t>(e_));
    } else {
      mpz_fdiv_q_2exp(whole.m_, m_, static_cast<mp_bitcnt_t>(-e_));
    }
    return mpz_get_si(whole.m_);
  }

  /// The root of a number >= 0, off by less than 2^-300 of it; rounded up if asked, else down.
  static Dyadic Root(const Dyadic& x, bool up) {
    if (x.Sign() == 0) return {};
    Dyadic square = x;
    Widen(&square, 640);
    if (square.e_ % 2 != 0) {
      mpz_mul_2exp(square.m_, square.m_, 1);
      --square.e_;
    }
    Dyadic root, rest;
    mpz_sqrtrem(root.m_, rest.m_, square.m_);
    if (up && rest.Sign() != 0) mpz_add_ui(root.m_, root.m_, 1);
    root.e_ = square.e_ / 2;
    return root;
  }

  /// a / b for a >= 0, b > 0, likewise.
  static Dyadic Quotient(Dyadic a, const Dyadic& b, bool up) {
    if (a.Sign() == 0) return {};
    Widen(&a, mpz_sizeinbase(b.m_, 2) + 320);
    Dyadic quotient;
    (up ? mpz_cdiv_q : mpz_fdiv_q)(quotient.m_, a.m_, b.m_);
    quotient.e_ = a.e_ - b.e_;
    return quotient;
  }

 private:
  static Dyadic Sum(const Dyadic& a, const Dyadic& b, void (*op)(mpz_ptr, mpz_srcptr, mpz_srcptr)) {
    Dyadic sum;
    if (a.Sign() == 0 || b.Sign() == 0 || a.e_ == b.e_) {
      op(sum.m_, a.m_, b.m_);
      sum.e_ = a.Sign() == 0 ? b.e_ : a.e_;
    } else if (a.e_ > b.e_) {
      mpz_mul_2exp(sum.m_, a.m_, a.e_ - b.e_);
      op(sum.m_, sum.m_, b.m_);
      sum.e_ = b.e_;
    } else {
      mpz_mul_2exp(sum.m_, b.m_, b.e_ - a.e_);
      op(sum.m_, a.m_, sum.m_);
      sum.e_ = a.e_;
    }
    return sum;
  }

  /// The same number with at least this many bits.
  static void Widen(Dyadic* x, std::size_t bits) {
    const std::size_t has = mpz_sizeinbase(x->m_, 2);
    if (has >= bits) return;
    mpz_mul_2exp(x->m_, x->m_, bits - has);
    x->e_ -= static_cast<long>(bits - has);
  }

  mpz_t m_;
  long e_ = 0;
};

}  // namespace collision
