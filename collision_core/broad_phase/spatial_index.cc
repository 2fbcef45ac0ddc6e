#include "collision_core/broad_phase/spatial_index.h"

#include <algorithm>
#include <cmath>

namespace collision {
namespace {

/// The level an agent belongs to, larger ones later: counted down from the greatest reach in powers
/// of 4, so that agents that are all alike share one. Odd for those that never move.
constexpr int kLevelsMax = 120;
constexpr int kKeys = 2 * kLevelsMax + 2;
std::uint8_t KeyOf(float reach, float greatest, bool still) {
  int exponent;
  std::frexp(greatest / reach, &exponent);
  return static_cast<std::uint8_t>(2 * (kLevelsMax - std::clamp(exponent / 2, 0, kLevelsMax)) +
                                   still);
}

}  // namespace

void SpatialIndex::PlaceAll() {
  places_.assign(table().size(), {});
  loose_count_ = 0;
  unsorted_.clear();
  keys_.clear();
  if (placing_.blind()) {
    level_count_ = 0;
    return;
  }
  unsorted_.reserve(table().count());
  reaches_.clear();
  reaches_.reserve(table().count());
  float greatest = 0;
  for (std::uint32_t agent = 0; agent < table().size(); ++agent) {
    if (!table().contains(agent) || table().row(agent).wild) continue;
    unsorted_.push_back(placing_.Place(table(), agent));
    const PlacedHorn& horn = unsorted_.back();
    reaches_.push_back(static_cast<float>(placing_.Reach(horn, {0, placing_.window()})));
    keys_.push_back(table().row(agent).still);
    greatest = std::max(greatest, reaches_.back());
  }
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    keys_[k] = KeyOf(reaches_[k], greatest, keys_[k] != 0);
  }
  FillLevels();
}

void SpatialIndex::FillLevels() {
  std::uint32_t counts[kKeys] = {}, next[kKeys];
  for (const std::uint8_t key : keys_) ++counts[key];
  std::uint32_t sum = 0;
  for (int key = 0; key < kKeys; ++key) next[key] = sum, sum += counts[key];
  if (std::count_if(counts, counts + kKeys, [](std::uint32_t n) { return n > 0; }) > 1) {
    horns_.resize(unsorted_.size());
    for (std::size_t k = 0; k < keys_.size(); ++k) horns_[next[keys_[k]]++] = unsorted_[k];
  } else {
    horns_.swap(unsorted_);
  }
  level_count_ = 0;
  std::uint32_t first = 0;
  for (int key = 0; key < kKeys; first += counts[key++]) {
    if (counts[key] == 0) continue;
    if (levels_.size() == level_count_) levels_.emplace_back();
    Level& level = levels_[level_count_];
    level.still = key % 2 == 1;
    level.first = first;
    level.grid.Build(placing_, horns_.data() + first, counts[key]);
    for (std::uint32_t k = 0; k < counts[key]; ++k) {
      places_[horns_[first + k].agent] = {level_count_, level.grid.place(k)};
    }
    ++level_count_;
  }
}

void SpatialIndex::PlaceOne(std::uint32_t agent) {
  if (places_.size() <= agent) places_.resize(agent + 1);
  const PlacedHorn horn = placing_.Place(table(), agent);
  if (loose_count_ == 0) std::copy_n(horn.c, 3, loose_corner_);
  if (loose_.size() <= loose_count_) loose_.Resize(2 * loose_count_ + 64);
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis) farthest += std::abs(horn.c[axis] - loose_corner_[axis]);
  places_[agent] = {kLoose, loose_count_};
  // What the asker loses is in his own, which Scan() is given as well.
  loose_.Set(loose_count_++, horn, loose_corner_, static_cast<float>(farthest * 0x1p-21));
}

void SpatialIndex::Unplace(std::uint32_t agent) {
  const Place place = places_[agent];
  if (place.level != kLoose) {
    levels_[place.level].grid.Vacate(place.place);
  } else if (place.place < loose_count_ && loose_.agent(place.place) == agent) {
    loose_.Vacate(place.place);
  }
}

void SpatialIndex::Scan(const Lanes& lanes, const LaneQuery& query) {
  for (const LaneRange& range : ranges_) work_.filter_tests += range.end - range.begin;
  work_.visits += ranges_.size();
  ScanInto(lanes, query, ranges_, &hits_, &near_);
}

void SpatialIndex::Take(const GridLevel& grid) {
  for (std::uint32_t k = 0; k < grid.size(); ++k) {
    if (grid.lanes().agent(k) != Lanes::kNobody) near_.push_back(grid.lanes().agent(k));
  }
}

void SpatialIndex::JoinRows(const Level& level, Stretch stretch, BestMeeting* best) {
  const Lanes& lanes = level.grid.lanes();
  const auto visit = [&](std::uint32_t place, Stretch ahead, const std::vector<LaneRange>& ranges) {
    near_.clear();
    work_.visits += ranges.size();
    ScanInto(lanes, lanes.QueryOf(place, placing_, ahead), ranges, &hits_, &near_);
    for (const std::uint32_t other : near_) best->Offer(lanes.agent(place), other);
    return best->limit();
  };
  level.grid.ForEachPlace(stretch, visit);
}

void SpatialIndex::JoinCells(const Level& level, const Level& other, Stretch stretch,
                             BestMeeting* best) {
  for (std::uint32_t k = 0; k < level.grid.size(); ++k) {
    const PlacedHorn& horn = horns_[level.first + k];
    stretch.last = std::min(stretch.last, std::max(stretch.first, best->limit()));
    const std::uint32_t after = &level == &other ? level.grid.place(k) : Lanes::kNobody;
    near_.clear();
    ranges_.clear();
    if (other.grid.Ranges(horn.c, placing_.Reach(horn, stretch), stretch, after, &ranges_)) {
      Scan(other.grid.lanes(), QueryOf(horn, placing_, stretch));
    } else {
      Take(other.grid);
    }
    for (const std::uint32_t partner : near_) best->Offer(horn.agent, partner);
  }
}

void SpatialIndex::Join(Stretch stretch, BestMeeting* best) {
  for (std::uint32_t l = 0; l < level_count_; ++l) {
    for (std::uint32_t m = l; m < level_count_; ++m) {
      if (levels_[l].still && levels_[m].still) continue;
      if (l == m && levels_[l].grid.in_rows()) {
        JoinRows(levels_[l], stretch, best);
      } else {
        JoinCells(levels_[l], levels_[m], stretch, best);
      }
    }
  }
}

void SpatialIndex::FindNear(const PlacedHorn& horn, Stretch stretch) {
  const bool still = table().row(horn.agent).still;
  const bool late = stretch.first > placing_.window();
  const LaneQuery query = QueryOf(horn, placing_, stretch);
  for (std::uint32_t l = 0; l < level_count_; ++l) {
    if (levels_[l].still && still) continue;
    ranges_.clear();
    const GridLevel& grid = levels_[l].grid;
    if (grid.Ranges(horn.c, placing_.Reach(horn, stretch), stretch, Lanes::kNobody, &ranges_)) {
      const std::uint64_t before = work_.filter_tests;
      Scan(grid.lanes(), query);
      if (late) wasted_ += work_.filter_tests - before;
    } else {
      Take(grid);
      wasted_ += grid.size();
    }
  }
  if (loose_count_ == 0) return;
  wasted_ += loose_count_;
  double farthest = 0;
  LaneRange all{0, loose_count_, 0, 0, 0};
  float* const at[3] = {&all.x, &all.y, &all.z};
  for (int axis = 0; axis < 3; ++axis) {
    const double offset = horn.c[axis] - loose_corner_[axis];
    *at[axis] = static_cast<float>(offset);
    farthest += std::abs(offset);
  }
  LaneQuery asked = query;
  asked.reach += static_cast<float>(farthest * 0x1p-21);
  ranges_.assign(1, all);
  Scan(loose_, asked);
}

}  // namespace collision
