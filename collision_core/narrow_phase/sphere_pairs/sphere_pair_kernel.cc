// One pair after the other, in the order of the wide vectors.
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"

#include <cmath>

#define WIDE

namespace collision::narrow_phase {
namespace {

constexpr std::uint32_t kWidth = 8;

struct Lanes {
  float lane[kWidth];
};

template <typename Each>
Lanes Map(Each each) {
  Lanes result;
  for (std::uint32_t i = 0; i < kWidth; ++i) result.lane[i] = each(i);
  return result;
}

Lanes operator+(const Lanes& a, const Lanes& b) {
  return Map([&](std::uint32_t i) { return a.lane[i] + b.lane[i]; });
}
Lanes operator-(const Lanes& a, const Lanes& b) {
  return Map([&](std::uint32_t i) { return a.lane[i] - b.lane[i]; });
}
Lanes operator*(const Lanes& a, const Lanes& b) {
  return Map([&](std::uint32_t i) { return a.lane[i] * b.lane[i]; });
}
Lanes operator/(const Lanes& a, const Lanes& b) {
  return Map([&](std::uint32_t i) { return a.lane[i] / b.lane[i]; });
}
Lanes All(float value) {
  return Map([&](std::uint32_t) { return value; });
}
Lanes Load(const float* values) {
  return Map([&](std::uint32_t i) { return values[i]; });
}
Lanes OfEight(const float* values) { return Load(values); }
Lanes OfFour(const float* values) {
  return Map([&](std::uint32_t i) { return values[i % 4]; });
}
Lanes RowsOfEight(const float* values, std::uint32_t row, std::uint32_t) {
  return All(values[row]);
}
Lanes RowsOfFour(const float* values, std::uint32_t row) {
  return Map([&](std::uint32_t i) { return values[row + i / 4]; });
}
void Store(float* to, const Lanes& lanes) {
  for (std::uint32_t i = 0; i < kWidth; ++i) to[i] = lanes.lane[i];
}
Lanes Lesser(const Lanes& a, const Lanes& b) {
  return Map([&](std::uint32_t i) { return a.lane[i] < b.lane[i] ? a.lane[i] : b.lane[i]; });
}
Lanes Greater(const Lanes& a, const Lanes& b) {
  return Map([&](std::uint32_t i) { return a.lane[i] > b.lane[i] ? a.lane[i] : b.lane[i]; });
}
Lanes Root(const Lanes& a) {
  return Map([&](std::uint32_t i) { return std::sqrt(a.lane[i]); });
}
float Least(const Lanes& a) {
  float least = a.lane[0];
  for (std::uint32_t i = 1; i < kWidth; ++i) least = a.lane[i] < least ? a.lane[i] : least;
  return least;
}
unsigned NotGreater(const Lanes& a, const Lanes& b) {
  unsigned mask = 0;
  for (std::uint32_t i = 0; i < kWidth; ++i) mask |= unsigned{!(a.lane[i] > b.lane[i])} << i;
  return mask;
}
Lanes Beyond(const Lanes& a, const Lanes& b) {
  return Map(
      [&](std::uint32_t i) { return a.lane[i] > b.lane[i] ? a.lane[i] : sphere_tree::kNowhere; });
}

}  // namespace
}  // namespace collision::narrow_phase

#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel_wide.h"

namespace collision::narrow_phase {

const SpherePairKernel* PlainSpherePairKernel() { return &kPackScan; }

const SpherePairKernel& WidestSpherePairKernel() {
  static const SpherePairKernel& widest = Avx512SpherePairKernel() ? *Avx512SpherePairKernel()
                                          : Avx2SpherePairKernel() ? *Avx2SpherePairKernel()
                                                                   : kPackScan;
  return widest;
}

}  // namespace collision::narrow_phase
