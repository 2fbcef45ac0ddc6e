// Placed balls in the arrays that SphereFilter reads.
#pragma once

#include <vector>

#include "collision_core/broad_phase/filter/placement_frame.h"
#include "collision_core/broad_phase/filter/sphere_filter.h"
#include "collision_core/numeric/allowances.h"

namespace collision::broad_phase {

/// A reach at a time, rounded up by more than the operations take.
inline float ReachAt(float time, float s0, float s1, float s2, float s3) {
  return (s0 + time * (s1 + time * (s2 + time * s3))) * numeric::kFewFloatRoundingsUp;
}

/// Placed balls as arrays of floats, seen from a corner near them.
class PlacedBalls {
 public:
  static constexpr std::uint32_t kNoAgent = ~0u;
  /// The x of a vacant place. Its square is infinite in single precision, so that no filter finds
  /// the place; a reach that is as large finds all places anyway.
  static constexpr float kFarAway = 1e30f;

  /// Empties it and makes room for `size` balls.
  void Reset(std::uint32_t size);
  /// Changes the size and keeps the balls up to it; new places hold no agent.
  void Resize(std::uint32_t size);
  std::uint32_t size() const { return static_cast<std::uint32_t>(agents_.size()); }
  /// The agent at place k; kNoAgent where it is vacant.
  std::uint32_t agent(std::uint32_t k) const { return agents_[k]; }
  FilterView view() const;

  /// Stores a ball at place k, as seen from `corner`; `lost` is what single precision takes from
  /// its position and from that of a query's ball there, and is added to the reach.
  void Set(std::uint32_t k, const PlacedBall& horn, const double* corner, float lost) {
    float* const at = floats_.data() + k;
    for (int axis = 0; axis < 3; ++axis) {
      at[(kX + axis) * stride_] = static_cast<float>(horn.c[axis] - corner[axis]);
      at[(kVx + axis) * stride_] = horn.v[axis];
    }
    at[kS0 * stride_] = horn.s0 + lost, at[kS1 * stride_] = horn.s1, at[kS2 * stride_] = horn.s2;
    at[kS3 * stride_] = horn.s3, at[kSpeed * stride_] = horn.speed;
    has_cubes_ = has_cubes_ || horn.s3 > 0;
    agents_[k] = horn.agent;
  }
  /// Walks the first `count` places: each agent has at most one; its reaches, speed and position
  /// are numbers, and reaches are not negative; a vacant place is too far for any filter. Throws
  /// CheckFailure.
  void Validate(std::uint32_t count) const;
  void Vacate(std::uint32_t k) {
    floats_[k] = kFarAway;
    agents_[k] = kNoAgent;
  }

  /// The positions as they are stored.
  const float* x() const { return array(kX); }
  const float* y() const { return array(kX + 1); }
  const float* z() const { return array(kX + 2); }

  /// The query of the ball at place k: the times of `times`, and its own motion and reach.
  FilterQuery QueryOf(std::uint32_t k, const FilterQuery& times) const {
    FilterQuery query = times;
    const float* const at = floats_.data() + k;
    query.vx = at[kVx * stride_], query.vy = at[(kVx + 1) * stride_];
    query.vz = at[(kVx + 2) * stride_], query.speed = at[kSpeed * stride_];
    query.reach = ReachAt(times.time, at[kS0 * stride_], at[kS1 * stride_], at[kS2 * stride_],
                          at[kS3 * stride_]);
    return query;
  }

 private:
  enum { kX = 0, kVx = 3, kS0 = 6, kS1, kS2, kS3, kSpeed, kArrays };
  const float* array(std::size_t which) const { return floats_.data() + which * stride_; }

  /// The arrays, one after the other, not a whole number of pages apart: else they would compete
  /// for the same lines of the processor's cache.
  std::vector<float> floats_;
  std::size_t stride_ = 0;
  bool has_cubes_ = false;  ///< Some s3 has been other than zero.
  std::vector<std::uint32_t> agents_;
};

/// The times of a query; its motion and reach are zero.
FilterQuery TimesOf(const PlacementFrame& frame, TimeWindow window);

/// The query of a placed ball.
FilterQuery QueryOf(const PlacedBall& horn, const PlacementFrame& frame, TimeWindow window);

/// The distance from its place within which the query's ball stays [m].
inline float ReachFromPlace(const FilterQuery& query) {
  return (query.reach + query.u_max * query.speed) * numeric::kFewFloatRoundingsUp;
}

/// Appends the agents that a scan of the ranges finds; `hits` is scratch.
void ScanInto(const PlacedBalls& lanes, const FilterQuery& query,
              const std::vector<FilterRange>& ranges, std::vector<std::uint32_t>* hits,
              std::vector<std::uint32_t>* agents);

}  // namespace collision::broad_phase
