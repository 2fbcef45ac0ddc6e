#include "collision_core/broad_phase/filter/placed_balls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "collision_core/base/check.h"

namespace collision::broad_phase {
namespace {

float Up(double x) { return static_cast<float>(x) * static_cast<float>(kFloatUp); }

}  // namespace

void PlacedBalls::Reset(std::uint32_t size) {
  constexpr std::size_t kPage = 1024, kApart = 80;
  const std::size_t room = (size + kLanesMax + kPage - 1) / kPage * kPage + kApart;
  if (room > stride_) {
    stride_ = room;
    floats_.assign(kArrays * stride_, 0);
  }
  agents_.resize(size);
  has_cubes_ = false;
}

void PlacedBalls::Resize(std::uint32_t size) {
  PlacedBalls grown;
  grown.Reset(size);
  grown.agents_.assign(size, kNoAgent);
  const auto kept = static_cast<std::ptrdiff_t>(std::min(this->size(), size));
  for (std::size_t which = 0; which < kArrays && kept > 0; ++which) {
    std::copy_n(array(which), kept,
                grown.floats_.begin() + static_cast<std::ptrdiff_t>(which * grown.stride_));
  }
  std::copy_n(agents_.begin(), kept, grown.agents_.begin());
  grown.has_cubes_ = has_cubes_;
  *this = std::move(grown);
}

FilterView PlacedBalls::view() const {
  return {
      array(kX),      array(kX + 1), array(kX + 2), array(kVx), array(kVx + 1),
      array(kVx + 2), array(kS0),    array(kS1),    array(kS2), has_cubes_ ? array(kS3) : nullptr,
      array(kSpeed)};
}

void PlacedBalls::Validate(std::uint32_t count) const {
  CORE_CHECK(count <= size(), "lanes hold all places that count", count, size());
  std::vector<std::uint32_t> agents;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (agents_[k] == kNoAgent) {
      CORE_CHECK(array(kX)[k] >= kFarAway, "a vacant place is far away", k, array(kX)[k]);
      continue;
    }
    agents.push_back(agents_[k]);
    for (std::size_t which = 0; which < kArrays; ++which) {
      CORE_CHECK(!std::isnan(array(which)[k]), "a placed agent's lanes are numbers", k, which);
    }
    for (const std::size_t which : {kS0, kS1, kS2, kS3, kSpeed}) {
      CORE_CHECK(array(which)[k] >= 0, "reaches and speed are not negative", k, which);
    }
  }
  std::sort(agents.begin(), agents.end());
  CORE_CHECK(std::adjacent_find(agents.begin(), agents.end()) == agents.end(),
             "an agent stands at one place", count);
}

FilterQuery TimesOf(const PlacementFrame& frame, TimeWindow window) {
  FilterQuery times{};
  times.first = static_cast<float>(window.first - frame.middle());
  times.last = static_cast<float>(window.last - frame.middle());
  times.u_max = std::max(std::abs(times.first), std::abs(times.last));
  times.time = Up(window.last);
  return times;
}

FilterQuery QueryOf(const PlacedBall& horn, const PlacementFrame& frame, TimeWindow window) {
  FilterQuery query = TimesOf(frame, window);
  query.vx = horn.v[0], query.vy = horn.v[1], query.vz = horn.v[2], query.speed = horn.speed;
  query.reach = ReachAt(query.time, horn.s0, horn.s1, horn.s2, horn.s3);
  return query;
}

void ScanInto(const PlacedBalls& lanes, const FilterQuery& query,
              const std::vector<FilterRange>& ranges, std::vector<std::uint32_t>* hits,
              std::vector<std::uint32_t>* agents) {
  std::size_t room = kLanesMax;
  for (const FilterRange& range : ranges) room += range.end - range.begin;
  if (hits->size() < room) hits->resize(room);
  static const SphereFilter scan = WidestSphereFilter();
  const std::uint32_t count = scan(lanes.view(), query, ranges.data(),
                                   static_cast<std::uint32_t>(ranges.size()), hits->data());
  for (std::uint32_t hit = 0; hit < count; ++hit) {
    const std::uint32_t agent = lanes.agent((*hits)[hit]);
    if (agent != PlacedBalls::kNoAgent) agents->push_back(agent);
  }
}

}  // namespace collision::broad_phase
