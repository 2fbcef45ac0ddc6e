// Placed horns in the arrays that LaneScan reads.
#pragma once

#include <vector>

#include "collision_core/broad_phase/lane_scan.h"
#include "collision_core/broad_phase/placing.h"

namespace collision {

class Lanes {
 public:
  static constexpr std::uint32_t kNobody = ~0u;

  /// Keeps what there is, up to the new size.
  void Resize(std::uint32_t size);
  std::uint32_t size() const { return static_cast<std::uint32_t>(agents_.size()); }
  /// kNobody where it was vacated.
  std::uint32_t agent(std::uint32_t k) const { return agents_[k]; }
  LaneView view() const;

  /// At k, as seen from `corner`; `lost` is what that costs positions, its own and askers'.
  void Set(std::uint32_t k, const PlacedHorn& horn, const double* corner, float lost) {
    x_[k] = static_cast<float>(horn.c[0] - corner[0]);
    y_[k] = static_cast<float>(horn.c[1] - corner[1]);
    z_[k] = static_cast<float>(horn.c[2] - corner[2]);
    vx_[k] = horn.v[0], vy_[k] = horn.v[1], vz_[k] = horn.v[2];
    speed_[k] = horn.speed;
    s0_[k] = horn.s0 + lost, s1_[k] = horn.s1, s2_[k] = horn.s2;
    agents_[k] = horn.agent;
  }
  void Vacate(std::uint32_t k);

  /// The position of the k-th as it is stored.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }

  /// What the k-th asks of the others.
  LaneQuery QueryOf(std::uint32_t k, const Placing& placing, Stretch stretch) const;
  /// So far it comes from its place.
  float Reach(std::uint32_t k, const Placing& placing, Stretch stretch) const;

 private:
  std::vector<float> x_, y_, z_, vx_, vy_, vz_, speed_, s0_, s1_, s2_;
  std::vector<std::uint32_t> agents_;
};

/// What a placed horn asks of others.
LaneQuery QueryOf(const PlacedHorn& horn, const Placing& placing, Stretch stretch);

/// Appends the agents that a scan of the ranges finds; `hits` is scratch.
void ScanInto(const Lanes& lanes, const LaneQuery& query, const std::vector<LaneRange>& ranges,
              std::vector<std::uint32_t>* hits, std::vector<std::uint32_t>* agents);

}  // namespace collision
