#include "collision_core/broad_phase/face_sweep/face_sweep_start.h"

#include <algorithm>

namespace collision::broad_phase {

std::uint64_t FaceSweepStart::ForEach(const std::array<const std::vector<AlphaTFace>*, 3>& orders,
                                      std::uint32_t ceiling, const Found& found) {
  tests_ = 0;
  ceiling_ = ceiling;
  ChooseAxes(orders);
  const std::size_t strips = orders[across_]->size() / strip_width_ + 1;
  if (strips_.size() < strips) strips_.resize(strips);
  for (Strip& strip : strips_) {
    strip.useful.clear();
    strip.others.clear();
  }
  for (const AlphaTFace& face : *orders[along_]) {
    if (!face.is_upper()) Enter(EntryOf(face.slot()), found);
  }
  return tests_;
}

void FaceSweepStart::ChooseAxes(const std::array<const std::vector<AlphaTFace>*, 3>& orders) {
  std::array<std::int64_t, 3> overlaps = {};
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<AlphaTFace>& order = *orders[axis];
    places_[axis].resize(order.size());
    std::int64_t open = 0;
    for (std::uint32_t place = 0; place < order.size(); ++place) {
      places_[axis][order[place].face] = place;
      if (order[place].is_upper()) {
        --open;
      } else {
        overlaps[axis] += open++;
      }
    }
  }
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return overlaps[a] < overlaps[b]; });
  along_ = axes[0], across_ = axes[1], other_ = axes[2];
  const std::vector<std::uint32_t>& places = places_[across_];
  std::uint64_t span = 0;
  for (std::size_t face = 0; face < places.size(); face += 2) {
    const auto [first, last] = std::minmax(places[face], places[face + 1]);
    span += last - first;
  }
  strip_width_ = static_cast<std::uint32_t>(span / std::max<std::size_t>(places.size() / 2, 1)) + 1;
}

FaceSweepStart::Entry FaceSweepStart::EntryOf(std::uint32_t slot) const {
  const std::uint32_t lower = 2 * slot, upper = lower + 1;
  return {slot,
          places_[along_][upper],
          places_[across_][lower],
          places_[across_][upper],
          places_[other_][lower],
          places_[other_][upper]};
}

void FaceSweepStart::Enter(const Entry& entry, const Found& found) {
  const auto [low, high] = std::minmax(entry.lower_across, entry.upper_across);
  const std::uint32_t first = low / strip_width_, last = high / strip_width_;
  for (std::uint32_t strip = first; strip <= last; ++strip) {
    TestAll(entry, strip, &strips_[strip].useful, found);
    if (entry.slot <= ceiling_) TestAll(entry, strip, &strips_[strip].others, found);
    const bool is_useful = entry.slot <= ceiling_;
    (is_useful ? strips_[strip].useful : strips_[strip].others).push_back(entry);
  }
}

void FaceSweepStart::TestAll(const Entry& entry, std::uint32_t strip, std::vector<Entry>* actives,
                             const Found& found) {
  const std::uint32_t start = places_[along_][2 * entry.slot];
  // The box that entered last comes first: where agents lie in descending order, that lowers the
  // ceiling soonest.
  for (std::size_t i = actives->size(); i-- > 0;) {
    Entry& active = (*actives)[i];
    const bool is_over = active.end < start;
    const bool is_demoted = active.slot > ceiling_ && actives != &strips_[strip].others;
    if (is_over || is_demoted) {
      if (!is_over) strips_[strip].others.push_back(active);
      active = actives->back();
      actives->pop_back();
      continue;
    }
    ++tests_;
    // Two boxes may share several strips; the pair is reported in the first of them.
    const bool is_first = std::max(entry.lower_across, active.lower_across) / strip_width_ == strip;
    if (is_first && entry.lower_across < active.upper_across &&
        active.lower_across < entry.upper_across && entry.lower_other < active.upper_other &&
        active.lower_other < entry.upper_other) {
      const auto [lower, higher] = std::minmax(entry.slot, active.slot);
      ceiling_ = found(lower, higher);
    }
  }
}

}  // namespace collision::broad_phase
