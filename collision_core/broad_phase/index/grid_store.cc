#include "collision_core/broad_phase/index/grid_store.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision_core/base/check.h"

namespace collision::broad_phase {
namespace {

/// Levels and their keys: agents that move and agents that never move have a level each.
constexpr int kLevelsMax = 120;
constexpr int kKeys = 2 * kLevelsMax + 2;

/// The level of an agent, larger for larger reaches: counted down from the greatest reach in powers
/// of 4, so that agents of similar reach share one.
int LevelOf(float reach, float greatest) {
  int exponent;
  std::frexp(greatest / reach, &exponent);
  return kLevelsMax - std::clamp(exponent / 2, 0, kLevelsMax);
}

}  // namespace

void GridStore::PlaceAll(const PlacedScene& scene, std::vector<PlacedBall>* horns) {
  places_.assign(scene.table->size(), {});
  unplaced_.Clear();
  level_count_ = 0;
  points_last_ = 0;
  if (horns->empty()) return;
  const FilterQuery times = TimesOf(*scene.frame, {0, scene.frame->window()});
  PlacedExtent extent;
  float least = std::numeric_limits<float>::infinity(), greatest = 0;
  for (const PlacedBall& horn : *horns) {
    extent.Add(horn);
    const float reach =
        ReachAt(times.time, horn.s0, horn.s1, horn.s2, horn.s3) + times.u_max * horn.speed;
    least = std::min(least, reach), greatest = std::max(greatest, reach);
  }
  // The usual scene: all agents move, and reach about as far.
  if (scene.table->still_count() == 0 && greatest < 4 * least) {
    sorted_.swap(*horns);
    BuildLevel(scene, {0, static_cast<std::uint32_t>(sorted_.size()), false}, extent);
  } else {
    SortByLevel(scene, *horns);
  }
}

// Where most agents never move, levels spare the comparison of still agents with each other.
bool GridStore::PlaceForJoin(const PlacedScene& scene, double last) {
  return 2 * scene.table->still_count() < scene.table->count() && BuildPoints(scene, last);
}

bool GridStore::BuildPoints(const PlacedScene& scene, double last) {
  const HornTable& table = *scene.table;
  const auto at = [&](std::uint32_t agent, ReachPoint* point) {
    if (!table.contains(agent) || scene.IsUnfilterable(agent)) return false;
    *point = scene.frame->HalfWay(table, agent, last);
    return true;
  };
  if (!points_.Build(table.size(), table.count(), 0.5 * last, at)) return false;
  points_last_ = last;
  return true;
}

void GridStore::JoinPoints(const PlacedScene& scene, double last, SearchCost* cost,
                           PairSink* sink) {
  const HornTable& table = *scene.table;
  const std::uint64_t tests = points_.tests(), ranges = points_.ranges();
  const auto fetch = [&](std::uint32_t a, std::uint32_t b) { table.Fetch(a), table.Fetch(b); };
  const auto visit = [&](std::uint32_t a, std::uint32_t b) {
    const double until = std::min(last, sink->limit());
    ++cost->work.filter_tests;
    if (MayMeetBy(scene.frame->DifferenceOf(table, a, b), until)) sink->Offer(a, b);
  };
  points_.ForEachPair(fetch, visit);
  cost->work.filter_tests += points_.tests() - tests;
  cost->work.visits += points_.ranges() - ranges;
}

void GridStore::SortByLevel(const PlacedScene& scene, const std::vector<PlacedBall>& horns) {
  reaches_.resize(horns.size());
  keys_.resize(horns.size());
  float greatest = 0;
  for (std::size_t k = 0; k < horns.size(); ++k) {
    reaches_[k] = static_cast<float>(scene.frame->Reach(horns[k], {0, scene.frame->window()}));
    greatest = std::max(greatest, reaches_[k]);
  }
  std::uint32_t counts[kKeys] = {}, next[kKeys];
  for (std::size_t k = 0; k < horns.size(); ++k) {
    const bool still = scene.table->row(horns[k].agent).still;
    keys_[k] = static_cast<std::uint8_t>(2 * LevelOf(reaches_[k], greatest) + still);
    ++counts[keys_[k]];
  }
  std::uint32_t sum = 0;
  for (int key = 0; key < kKeys; ++key) next[key] = sum, sum += counts[key];
  sorted_.resize(horns.size());
  for (std::size_t k = 0; k < horns.size(); ++k) sorted_[next[keys_[k]]++] = horns[k];
  for (int key = 0; key < kKeys; ++key) {
    if (counts[key] == 0) continue;
    const std::uint32_t first = next[key] - counts[key];
    PlacedExtent extent;
    for (std::uint32_t k = first; k < next[key]; ++k) extent.Add(sorted_[k]);
    BuildLevel(scene, {first, counts[key], key % 2 == 1}, extent);
  }
}

void GridStore::BuildLevel(const PlacedScene& scene, const Part& part, const PlacedExtent& extent) {
  if (levels_.size() == level_count_) levels_.emplace_back();
  Level& level = levels_[level_count_];
  level.still = part.still;
  level.first = part.first;
  level.grid.Build(*scene.frame, sorted_.data() + part.first, part.count, extent);
  for (std::uint32_t k = 0; k < part.count; ++k) {
    places_[sorted_[part.first + k].agent] = {level_count_, level.grid.place(k)};
  }
  ++level_count_;
}

void GridStore::Place(const PlacedBall& horn) {
  places_[horn.agent] = {kUnsorted, unplaced_.size()};
  unplaced_.Add(horn);
}

void GridStore::Unplace(std::uint32_t agent) {
  if (places_.size() <= agent) places_.resize(agent + 1);
  const Spot place = places_[agent];
  if (place.level != kUnsorted) {
    levels_[place.level].grid.Vacate(place.place);
  } else if (place.place < unplaced_.size() && unplaced_.agent(place.place) == agent) {
    unplaced_.Vacate(place.place);
  }
  places_[agent] = {};
}

void GridStore::Scan(const PlacedBalls& lanes, const FilterQuery& query, SearchCost* cost,
                     std::vector<std::uint32_t>* near) {
  for (const FilterRange& range : ranges_) cost->work.filter_tests += range.end - range.begin;
  cost->work.visits += ranges_.size();
  ScanInto(lanes, query, ranges_, &hits_, near);
}

void GridStore::TakeAll(const GridLevel& grid, std::vector<std::uint32_t>* near) {
  for (std::uint32_t k = 0; k < grid.size(); ++k) {
    if (grid.lanes().agent(k) != PlacedBalls::kNoAgent) near->push_back(grid.lanes().agent(k));
  }
}

void GridStore::JoinRows(const Level& level, TimeWindow window, SearchCost* cost, PairSink* sink) {
  const PlacedBalls& lanes = level.grid.lanes();
  const auto visit = [&](std::uint32_t place, const FilterQuery& query,
                         const std::vector<FilterRange>& ranges) {
    near_.clear();
    cost->work.visits += ranges.size();
    ScanInto(lanes, query, ranges, &hits_, &near_);
    for (const std::uint32_t other : near_) sink->Offer(lanes.agent(place), other);
    return sink->limit();
  };
  level.grid.ForEachPlace(window, visit);
}

// The cost of looking up every agent of `level` in the grid of `other`, in rows looked at.
double GridStore::CostOfSearch(const Level& level, const Level& other, TimeWindow window) {
  return level.grid.size() * other.grid.RowsWithin(level.grid.ReachMax(window), window);
}

void GridStore::JoinCells(const PlacedScene& scene, const LevelPair& levels, TimeWindow window,
                          SearchCost* cost, PairSink* sink) {
  const Level &level = *levels.queries, &other = *levels.searched;
  for (std::uint32_t k = 0; k < level.grid.size(); ++k) {
    const PlacedBall& horn = sorted_[level.first + k];
    window.last = std::min(window.last, std::max(window.first, sink->limit()));
    const std::uint32_t after = &level == &other ? level.grid.place(k) : PlacedBalls::kNoAgent;
    near_.clear();
    ranges_.clear();
    if (other.grid.Ranges(horn.c, scene.frame->Reach(horn, window), window, after, &ranges_)) {
      Scan(other.grid.lanes(), QueryOf(horn, *scene.frame, window), cost, &near_);
    } else {
      TakeAll(other.grid, &near_);
    }
    for (const std::uint32_t partner : near_) sink->Offer(horn.agent, partner);
  }
}

bool GridStore::Join(const PlacedScene& scene, TimeWindow window, SearchCost* cost,
                     PairSink* sink) {
  if (points_last_ > 0) {
    if (points_last_ < window.last && !BuildPoints(scene, window.last)) return false;
    JoinPoints(scene, window.last, cost, sink);
    return true;
  }
  // The farthest-reaching levels first: they are small, and what they meet shortens the window for
  // the rest.
  for (std::uint32_t m = level_count_; m-- > 0;) {
    for (std::uint32_t l = m + 1; l-- > 0;) {
      if (levels_[l].still && levels_[m].still) continue;
      if (l == m && levels_[l].grid.in_rows()) {
        JoinRows(levels_[l], window, cost, sink);
      } else if (CostOfSearch(levels_[l], levels_[m], window) <=
                 CostOfSearch(levels_[m], levels_[l], window)) {
        JoinCells(scene, {&levels_[l], &levels_[m]}, window, cost, sink);
      } else {
        JoinCells(scene, {&levels_[m], &levels_[l]}, window, cost, sink);
      }
    }
  }
  return true;
}

void GridStore::FindNear(const PlacedScene& scene, const PlacedBall& horn, TimeWindow window,
                         SearchCost* cost, std::vector<std::uint32_t>* near) {
  const bool still = horn.agent != PlacedBall::kNoAgent && scene.table->row(horn.agent).still;
  const bool late = window.first > scene.frame->window();
  const FilterQuery query = QueryOf(horn, *scene.frame, window);
  for (std::uint32_t l = 0; l < level_count_; ++l) {
    if (levels_[l].still && still) continue;
    ranges_.clear();
    const GridLevel& grid = levels_[l].grid;
    if (grid.Ranges(horn.c, scene.frame->Reach(horn, window), window, PlacedBalls::kNoAgent,
                    &ranges_)) {
      const std::uint64_t before = cost->work.filter_tests;
      Scan(grid.lanes(), query, cost, near);
      if (late) cost->wasted += cost->work.filter_tests - before;
    } else {
      TakeAll(grid, near);
      cost->wasted += grid.size();
    }
  }
  if (unplaced_.size() == 0) return;
  cost->wasted += unplaced_.size();
  unplaced_.FindNear(horn, *scene.frame, window, &cost->work, near);
}

bool GridStore::Holds(std::uint32_t agent) const {
  if (agent >= places_.size()) return false;
  const Spot& spot = places_[agent];
  if (spot.level != kUnsorted) return levels_[spot.level].grid.lanes().agent(spot.place) == agent;
  return spot.place < unplaced_.size() && unplaced_.agent(spot.place) == agent;
}

void GridStore::Validate() const {
  unplaced_.Validate();
  if (points_last_ > 0) return;
  std::size_t held = 0, taken = 0;
  const auto count = [&taken](const auto& places) {
    for (std::uint32_t k = 0; k < places.size(); ++k) {
      taken += places.agent(k) != PlacedBalls::kNoAgent;
    }
  };
  count(unplaced_);
  for (std::uint32_t l = 0; l < level_count_; ++l) {
    levels_[l].grid.Validate();
    count(levels_[l].grid.lanes());
  }
  for (std::uint32_t agent = 0; agent < places_.size(); ++agent) {
    const Spot& place = places_[agent];
    held += place.level != kUnsorted || Holds(agent);
    if (place.level == kUnsorted) continue;
    CORE_CHECK(place.level < level_count_, "a place names a level that is in use", agent,
               place.level, level_count_);
    const PlacedBalls& lanes = levels_[place.level].grid.lanes();
    CORE_CHECK(place.place < lanes.size() && lanes.agent(place.place) == agent,
               "an agent stands at its place in its level", agent, place.level, place.place);
  }
  CORE_CHECK(held == taken, "each place that is taken is its agent's", held, taken);
}

}  // namespace collision::broad_phase
