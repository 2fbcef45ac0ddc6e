#include "collision_core/broad_phase/filter/filter_row.h"

#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"

namespace collision::broad_phase {
namespace {

/// Relative to the sum of an offset's coordinates: casts take 2^-24 of each, and the sum and its
/// own cast are rounded by less than as much again; twice that.
constexpr double kOffsetLoss = 0x1p-22;

/// What a position as seen from a corner loses in single precision; `offset` leads there.
float LostAt(const double* offset) {
  return static_cast<float>((std::abs(offset[0]) + std::abs(offset[1]) + std::abs(offset[2])) *
                            kOffsetLoss);
}

}  // namespace

void FilterRow::Grow(std::uint32_t size) {
  if (lanes_.size() < size) lanes_.Resize(std::max(size, 2 * lanes_.size()));
  for (; count_ < size; ++count_) lanes_.Vacate(count_);
}

void FilterRow::Add(const PlacedBall& horn) { Set(count_, horn); }

void FilterRow::Set(std::uint32_t k, const PlacedBall& horn) {
  if (count_ == 0) std::copy_n(horn.c, 3, corner_);
  if (k >= count_) Grow(k + 1);
  const double offset[3] = {horn.c[0] - corner_[0], horn.c[1] - corner_[1], horn.c[2] - corner_[2]};
  lanes_.Set(k, horn, corner_, LostAt(offset));
}

void FilterRow::Join(const PlacementFrame& frame, TimeWindow window, BroadPhaseWork* work,
                     PairSink* sink) {
  FilterQuery times = TimesOf(frame, window);
  for (std::uint32_t k = 0; k + 1 < count_; ++k) {
    if (lanes_.agent(k) == PlacedBalls::kNoAgent) continue;
    if (sink->limit() < window.last) {
      window.last = std::max(window.first, sink->limit());
      times = TimesOf(frame, window);
    }
    near_.clear();
    range_.assign(1, {k + 1, count_, lanes_.x()[k], lanes_.y()[k], lanes_.z()[k]});
    work->filter_tests += count_ - (k + 1);
    ++work->visits;
    ScanInto(lanes_, lanes_.QueryOf(k, times), range_, &hits_, &near_);
    for (const std::uint32_t other : near_) sink->Offer(lanes_.agent(k), other);
  }
}

void FilterRow::FindNear(const PlacedBall& horn, const PlacementFrame& frame, TimeWindow window,
                         BroadPhaseWork* work, std::vector<std::uint32_t>* near) {
  double offset[3];
  FilterRange all{0, count_, 0, 0, 0};
  float* const at[3] = {&all.x, &all.y, &all.z};
  for (int axis = 0; axis < 3; ++axis) {
    offset[axis] = horn.c[axis] - corner_[axis];
    *at[axis] = static_cast<float>(offset[axis]);
  }
  FilterQuery query = QueryOf(horn, frame, window);
  query.reach += LostAt(offset);
  range_.assign(1, all);
  work->filter_tests += count_;
  ++work->visits;
  ScanInto(lanes_, query, range_, &hits_, near);
}

void FilterRow::Validate() const {
  CORE_CHECK(count_ <= lanes_.size(), "every place of a row has its lane", count_, lanes_.size());
  lanes_.Validate(count_);
}

}  // namespace collision::broad_phase
