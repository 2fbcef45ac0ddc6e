#include "collision_core/broad_phase/face_sweep/crossing_order.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "collision_core/base/check.h"

namespace collision::broad_phase {
namespace {

/// The first stretch, in ticks: as stretches without crossings grow eightfold, an order without
/// crossings takes five passes.
constexpr std::uint32_t kFirstStretch = CrossingOrder::kTicks >> 10;

/// Nearer than this to a whole number the quotient of a crossing, in ticks, is computed exactly:
/// four times what it is off by in doubles.
constexpr double kTicksUncertain = 0x1p-20;

bool StartsBelow(const AlphaTFace& a, const AlphaTFace& b) {
  if (a.start != b.start) return a.start < b.start;
  return a.end != b.end ? a.end < b.end : a.face < b.face;
}

}  // namespace

std::uint32_t CrossingTick(const AlphaTFace& below, const AlphaTFace& above) {
  // The gap is at_start (1 − x) + at_end x at the fraction x: negative beyond at_start / closing.
  const std::int64_t at_start = above.start - below.start;
  const std::int64_t closing = at_start - (above.end - below.end);
  CORE_CHECK(at_start >= 0 && closing > at_start, "the lower face ends above the other",
             static_cast<double>(at_start), static_cast<double>(closing));
  // Both are below 2^53, hence doubles; the quotient's error is below 2^−22 ticks.
  const double ticks =
      static_cast<double>(at_start) / static_cast<double>(closing) * CrossingOrder::kTicks;
  const auto whole = static_cast<std::uint32_t>(ticks);
  const double rest = ticks - whole;
  if (rest > kTicksUncertain && rest < 1 - kTicksUncertain) return whole + 1;
  return static_cast<std::uint32_t>((static_cast<__int128>(at_start) << CrossingOrder::kTickBits) /
                                    closing) +
         1;
}

void CrossingOrder::Start(const std::vector<AlphaTFace>& faces) {
  SortInto(faces);
  queue_.Reset(static_cast<std::uint32_t>(faces_.size()));
  due_ = 0;
  stretch_ = kFirstStretch;
  crossings_in_stretch_ = 0;
  queued_max_ = 0;
}

void CrossingOrder::SortInto(const std::vector<AlphaTFace>& faces) {
  faces_.resize(faces.size());
  if (faces.empty()) return;
  const auto by_start = [](const AlphaTFace& a, const AlphaTFace& b) { return a.start < b.start; };
  const auto [first, last] = std::minmax_element(faces.begin(), faces.end(), by_start);
  const std::int64_t lowest = first->start;
  const auto range = static_cast<std::uint64_t>(last->start - lowest);
  const int shift = std::max(
      static_cast<int>(std::bit_width(range)) - static_cast<int>(std::bit_width(faces.size())), 0);
  bucket_ends_.assign((range >> shift) + 2, 0);
  const auto bucket_of = [&](const AlphaTFace& face) {
    return static_cast<std::uint64_t>(face.start - lowest) >> shift;
  };
  for (const AlphaTFace& face : faces) ++bucket_ends_[bucket_of(face) + 1];
  std::partial_sum(bucket_ends_.begin(), bucket_ends_.end(), bucket_ends_.begin());
  for (const AlphaTFace& face : faces) faces_[bucket_ends_[bucket_of(face)]++] = face;
  std::uint32_t begin = 0;
  for (std::size_t bucket = 0; bucket + 1 < bucket_ends_.size(); ++bucket) {
    const std::uint32_t end = bucket_ends_[bucket];
    if (end - begin > 1) std::sort(faces_.begin() + begin, faces_.begin() + end, StartsBelow);
    begin = end;
  }
}

bool CrossingOrder::HasNext(std::uint32_t limit) {
  while (queue_.empty() && due_ < limit) Extend();
  return !queue_.empty() && queue_.tick() <= limit;
}

FaceCrossing CrossingOrder::Next() {
  CORE_CHECK(!queue_.empty(), "there is a next crossing");
  const std::uint32_t place = queue_.place();
  const FaceCrossing crossing{queue_.tick(), faces_[place], faces_[place + 1]};
  std::swap(faces_[place], faces_[place + 1]);
  queue_.Clear(place);
  if (place > 0) Schedule(place - 1);
  if (place + 2 < faces_.size()) Schedule(place + 1);
  ++crossings_in_stretch_;
  queued_max_ = std::max(queued_max_, queue_.size());
  return crossing;
}

void CrossingOrder::Schedule(std::uint32_t place) {
  const AlphaTFace& below = faces_[place];
  const AlphaTFace& above = faces_[place + 1];
  if (below.end > above.end) {
    const std::uint32_t tick = CrossingTick(below, above);
    if (tick <= due_) return queue_.Set(place, tick);
  }
  queue_.Clear(place);
}

void CrossingOrder::Extend() {
  const std::size_t faces = faces_.size();
  if (due_ > 0) {
    if (crossings_in_stretch_ <= faces / 8) {
      stretch_ = std::min(stretch_, kTicks / 8) * (crossings_in_stretch_ <= faces / 64 ? 8 : 2);
    } else if (crossings_in_stretch_ > faces) {
      stretch_ = std::max(stretch_ / 2, 1u);
    }
  }
  crossings_in_stretch_ = 0;
  due_ = std::min(due_ + stretch_, kTicks);
  // A cheap filter, rarely true: it passes every pair whose tick is up to due_, with a margin of
  // one tick for its rounding. Among pairs that draw apart it passes only those that coincide.
  // Schedule() decides.
  const double fraction = static_cast<double>(due_ + 1) / kTicks;
  for (std::uint32_t place = 0; place + 1 < faces_.size(); ++place) {
    const std::int64_t at_start = faces_[place + 1].start - faces_[place].start;
    const std::int64_t closing = at_start - (faces_[place + 1].end - faces_[place].end);
    if (static_cast<double>(at_start) <= static_cast<double>(closing) * fraction) Schedule(place);
  }
  queued_max_ = std::max(queued_max_, queue_.size());
}

}  // namespace collision::broad_phase
