#include "collision_core/broad_phase/index/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace collision::broad_phase {
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
  unplaced_.Clear();
  level_count_ = 0;
  points_last_ = 0;
  if (horns_.empty()) return;
  const FilterQuery times = TimesOf(placing_, {0, placing_.window()});
  PlacedExtent extent;
  float least = std::numeric_limits<float>::infinity(), greatest = 0;
  for (const PlacedHorn& horn : horns_) {
    extent.Add(horn);
    const float reach = ReachAt(times.time, horn.s0, horn.s1, horn.s2) + times.way * horn.speed;
    least = std::min(least, reach), greatest = std::max(greatest, reach);
  }
  // Mostly all reach about as far, and move.
  if (table().still_count() == 0 && greatest < 4 * least) {
    sorted_.swap(horns_);
    BuildLevel(false, 0, static_cast<std::uint32_t>(sorted_.size()), extent);
  } else {
    SortByLevel();
  }
}

// Where most never move they had better not be asked.
bool SpatialIndex::PlaceOnce(double last) {
  return 2 * table().still_count() < table().count() && BuildPoints(last);
}

bool SpatialIndex::BuildPoints(double last) {
  const auto at = [&](std::uint32_t agent, ReachPoint* point) {
    if (!table().contains(agent) || IsWild(agent)) return false;
    *point = placing_.HalfWay(table(), agent, last);
    return true;
  };
  if (!points_.Build(table().size(), table().count(), 0.5 * last, at)) return false;
  points_last_ = last;
  return true;
}

void SpatialIndex::JoinPoints(double last, PairSink* sink) {
  const std::uint64_t tests = points_.tests(), ranges = points_.ranges();
  const auto fetch = [&](std::uint32_t a, std::uint32_t b) { table().Fetch(a), table().Fetch(b); };
  const auto visit = [&](std::uint32_t a, std::uint32_t b) {
    const Approaching pair = placing_.Approach(table(), a, b);
    const double until = std::min(last, sink->limit());
    ++work_.filter_tests;
    if (pair.MayMeetBy(until)) sink->Offer(a, b);
  };
  points_.ForEachPair(fetch, visit);
  work_.filter_tests += points_.tests() - tests;
  work_.visits += points_.ranges() - ranges;
}

void SpatialIndex::SortByLevel() {
  reaches_.resize(horns_.size());
  keys_.resize(horns_.size());
  float greatest = 0;
  for (std::size_t k = 0; k < horns_.size(); ++k) {
    reaches_[k] = static_cast<float>(placing_.Reach(horns_[k], {0, placing_.window()}));
    greatest = std::max(greatest, reaches_[k]);
  }
  std::uint32_t counts[kKeys] = {}, next[kKeys];
  for (std::size_t k = 0; k < horns_.size(); ++k) {
    keys_[k] = KeyOf(reaches_[k], greatest, table().row(horns_[k].agent).still);
    ++counts[keys_[k]];
  }
  std::uint32_t sum = 0;
  for (int key = 0; key < kKeys; ++key) next[key] = sum, sum += counts[key];
  sorted_.resize(horns_.size());
  for (std::size_t k = 0; k < horns_.size(); ++k) sorted_[next[keys_[k]]++] = horns_[k];
  for (int key = 0; key < kKeys; ++key) {
    if (counts[key] == 0) continue;
    const std::uint32_t first = next[key] - counts[key];
    PlacedExtent extent;
    for (std::uint32_t k = first; k < next[key]; ++k) extent.Add(sorted_[k]);
    BuildLevel(key % 2 == 1, first, counts[key], extent);
  }
}

void SpatialIndex::BuildLevel(bool still, std::uint32_t first, std::uint32_t count,
                              const PlacedExtent& extent) {
  if (levels_.size() == level_count_) levels_.emplace_back();
  Level& level = levels_[level_count_];
  level.still = still;
  level.first = first;
  level.grid.Build(placing_, sorted_.data() + first, count, extent);
  for (std::uint32_t k = 0; k < count; ++k) {
    places_[sorted_[first + k].agent] = {level_count_, level.grid.place(k)};
  }
  ++level_count_;
}

void SpatialIndex::PlaceOne(const PlacedHorn& horn) {
  places_[horn.agent] = {kLoose, unplaced_.size()};
  unplaced_.Add(horn);
}

void SpatialIndex::Unplace(std::uint32_t agent) {
  if (places_.size() <= agent) places_.resize(agent + 1);
  const Place place = places_[agent];
  if (place.level != kLoose) {
    levels_[place.level].grid.Vacate(place.place);
  } else if (place.place < unplaced_.size() && unplaced_.agent(place.place) == agent) {
    unplaced_.Vacate(place.place);
  }
  places_[agent] = {};
}

void SpatialIndex::Scan(const PlacedBalls& lanes, const FilterQuery& query) {
  for (const FilterRange& range : ranges_) work_.filter_tests += range.end - range.begin;
  work_.visits += ranges_.size();
  ScanInto(lanes, query, ranges_, &hits_, &near_);
}

void SpatialIndex::Take(const GridLevel& grid) {
  for (std::uint32_t k = 0; k < grid.size(); ++k) {
    if (grid.lanes().agent(k) != PlacedBalls::kNobody) near_.push_back(grid.lanes().agent(k));
  }
}

void SpatialIndex::JoinRows(const Level& level, TimeWindow stretch, PairSink* sink) {
  const PlacedBalls& lanes = level.grid.lanes();
  const auto visit = [&](std::uint32_t place, const FilterQuery& query,
                         const std::vector<FilterRange>& ranges) {
    near_.clear();
    work_.visits += ranges.size();
    ScanInto(lanes, query, ranges, &hits_, &near_);
    for (const std::uint32_t other : near_) sink->Offer(lanes.agent(place), other);
    return sink->limit();
  };
  level.grid.ForEachPlace(stretch, visit);
}

// Many agents of short reach ask a few of long reach, or the other way round.
double SpatialIndex::CostOfAsking(const Level& level, const Level& other, TimeWindow stretch) {
  return level.grid.size() * other.grid.RowsWithin(level.grid.ReachMax(stretch), stretch);
}

void SpatialIndex::JoinCells(const Level& level, const Level& other, TimeWindow stretch,
                             PairSink* sink) {
  for (std::uint32_t k = 0; k < level.grid.size(); ++k) {
    const PlacedHorn& horn = sorted_[level.first + k];
    stretch.last = std::min(stretch.last, std::max(stretch.first, sink->limit()));
    const std::uint32_t after = &level == &other ? level.grid.place(k) : PlacedBalls::kNobody;
    near_.clear();
    ranges_.clear();
    if (other.grid.Ranges(horn.c, placing_.Reach(horn, stretch), stretch, after, &ranges_)) {
      Scan(other.grid.lanes(), QueryOf(horn, placing_, stretch));
    } else {
      Take(other.grid);
    }
    for (const std::uint32_t partner : near_) sink->Offer(horn.agent, partner);
  }
}

void SpatialIndex::Join(TimeWindow stretch, PairSink* sink) {
  if (points_last_ > 0) {
    if (points_last_ >= stretch.last || BuildPoints(stretch.last)) {
      return JoinPoints(stretch.last, sink);
    }
    PlaceEverybody();
  }
  // From the farthest reaching on: they are few, and what they meet makes the window short for the
  // rest.
  for (std::uint32_t m = level_count_; m-- > 0;) {
    for (std::uint32_t l = m + 1; l-- > 0;) {
      if (levels_[l].still && levels_[m].still) continue;
      if (l == m && levels_[l].grid.in_rows()) {
        JoinRows(levels_[l], stretch, sink);
      } else if (CostOfAsking(levels_[l], levels_[m], stretch) <=
                 CostOfAsking(levels_[m], levels_[l], stretch)) {
        JoinCells(levels_[l], levels_[m], stretch, sink);
      } else {
        JoinCells(levels_[m], levels_[l], stretch, sink);
      }
    }
  }
}

void SpatialIndex::FindNear(const PlacedHorn& horn, TimeWindow stretch) {
  const bool still = horn.agent != PlacedHorn::kNoAgent && table().row(horn.agent).still;
  const bool late = stretch.first > placing_.window();
  const FilterQuery query = QueryOf(horn, placing_, stretch);
  for (std::uint32_t l = 0; l < level_count_; ++l) {
    if (levels_[l].still && still) continue;
    ranges_.clear();
    const GridLevel& grid = levels_[l].grid;
    if (grid.Ranges(horn.c, placing_.Reach(horn, stretch), stretch, PlacedBalls::kNobody,
                    &ranges_)) {
      const std::uint64_t before = work_.filter_tests;
      Scan(grid.lanes(), query);
      if (late) wasted_ += work_.filter_tests - before;
    } else {
      Take(grid);
      wasted_ += grid.size();
    }
  }
  if (unplaced_.size() == 0) return;
  wasted_ += unplaced_.size();
  unplaced_.FindNear(horn, placing_, stretch, &work_, &near_);
}

}  // namespace collision::broad_phase
