#include "client/checker/motion/contact_spans.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace collision::checker {
namespace {

constexpr long double kWidthMin = 1e-12L;  // [s]
constexpr int kDegree = 6;
using Sextic = std::array<long double, kDegree + 1>;

// |d(u · duration)|² - reach² in powers of u.
Sextic SquaredDistance(const Cubic3& d, long double duration, long double reach) {
  Sextic g{};
  for (const auto& axis : d) {
    std::array<long double, 4> c{};
    long double power = 1;
    for (int i = 0; i < 4; ++i, power *= duration) c[i] = axis[i] * power;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) g[i + j] += c[i] * c[j];
    }
  }
  g[0] -= reach * reach;
  return g;
}

// The Bernstein coefficients on [0, 1]: the polynomial lies between the least and the greatest of
// them.
Sextic Bernstein(const Sextic& powers) {
  static constexpr long double kBinomial[7][7] = {{1, 0, 0, 0, 0, 0, 0},   {1, 1, 0, 0, 0, 0, 0},
                                                  {1, 2, 1, 0, 0, 0, 0},   {1, 3, 3, 1, 0, 0, 0},
                                                  {1, 4, 6, 4, 1, 0, 0},   {1, 5, 10, 10, 5, 1, 0},
                                                  {1, 6, 15, 20, 15, 6, 1}};
  Sextic b{};
  for (int i = 0; i <= kDegree; ++i) {
    for (int k = 0; k <= i; ++k) b[i] += kBinomial[i][k] / kBinomial[kDegree][k] * powers[k];
  }
  return b;
}

class SpanFinder {
 public:
  SpanFinder(long double noise, long double width_min) : noise_(noise), width_min_(width_min) {}

  void Search(const Sextic& b, long double lo, long double hi) {
    const auto [least, greatest] = std::minmax_element(b.begin(), b.end());
    if (*least > noise_) return;
    if (*greatest <= noise_) {
      Add(lo, hi);
      return;
    }
    if (hi - lo <= width_min_) {
      if (b[0] <= noise_ || b[kDegree] <= noise_) Add(lo, hi);
      return;
    }
    // De Casteljau: the coefficients of both halves.
    Sextic left{}, right = b;
    for (int k = 0; k <= kDegree; ++k) {
      left[k] = right[0];
      for (int i = 0; i < kDegree - k; ++i) right[i] = (right[i] + right[i + 1]) / 2;
    }
    const long double middle = (lo + hi) / 2;
    Search(left, lo, middle);
    Search(right, middle, hi);
  }

  const std::vector<Span>& spans() const { return spans_; }

 private:
  void Add(long double lo, long double hi) {
    if (!spans_.empty() && spans_.back().end >= lo) {
      spans_.back().end = hi;
    } else {
      spans_.push_back({lo, hi});
    }
  }

  long double noise_;
  long double width_min_;
  std::vector<Span> spans_;
};

// The spans of [0, duration] in which a polynomial in powers of t / duration is not positive.
// `scale`: of what was subtracted in it.
std::vector<Span> SpansOf(const Sextic& powers, long double duration, long double scale) {
  for (const long double power : powers) scale = std::max(scale, std::fabs(power));
  const long double noise = 64 * std::numeric_limits<long double>::epsilon() * scale;
  SpanFinder finder(noise, kWidthMin / duration);
  finder.Search(Bernstein(powers), 0, 1);
  std::vector<Span> spans;
  for (const Span& span : finder.spans())
    spans.push_back({span.begin * duration, span.end * duration});
  return spans;
}

}  // namespace

std::vector<Span> SpansWithin(const Cubic3& d, long double duration, long double reach) {
  if (!(duration > 0)) return {};
  return SpansOf(SquaredDistance(d, duration, reach), duration, reach * reach);
}

std::vector<Span> SpansBelow(const std::array<long double, 4>& height, long double duration,
                             long double most) {
  if (!(duration > 0)) return {};
  Sextic powers{};
  long double power = 1;
  for (int i = 0; i < 4; ++i, power *= duration) powers[i] = height[i] * power;
  powers[0] -= most;
  return SpansOf(powers, duration, std::fabs(most));
}

}  // namespace collision::checker
