// Placed agents in grids, one for each size of reach: the store for large and changing scenes.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/filter/filter_row.h"
#include "collision_core/broad_phase/filter/point_grid.h"
#include "collision_core/broad_phase/index/grid_level.h"
#include "collision_core/broad_phase/index/placed_store.h"

namespace collision::broad_phase {

/// Sorts agents by reach, in powers of 4 below the greatest, and gives each level a grid
/// (grid_level.h), so that neither a few large or fast agents nor clusters slow the others down;
/// size ratios of 1e6 cost a dozen look-ups. Agents that never move have levels of their own, which
/// are not compared with each other. To compare two levels, the store looks up the agents of one in
/// the grid of the other, whichever way is less work. The farthest-reaching levels come first,
/// because what they meet shortens the window for the rest.
///
/// An agent that is placed later goes to a list, which every query scans. Those tests, and tests
/// in windows after the placement's, count as wasted (SearchCost), which makes the search place all
/// agents anew.
///
/// A query about all agents at once is one pass over a grid of points (point_grid.h) where the
/// scene suits one grid; scenes with crowds, with very different reaches, or that mostly stand
/// still use the levels.
class GridStore : public PlacedStore {
 public:
  void PlaceAll(const PlacedScene& scene, std::vector<PlacedBall>* horns) override;
  bool PlaceForJoin(const PlacedScene& scene, double last) override;
  void Place(const PlacedBall& horn) override;
  void Unplace(std::uint32_t agent) override;
  bool Join(const PlacedScene& scene, TimeWindow window, SearchCost* cost, PairSink* sink) override;
  void FindNear(const PlacedScene& scene, const PlacedBall& horn, TimeWindow window,
                SearchCost* cost, std::vector<std::uint32_t>* near) override;
  bool Holds(std::uint32_t agent) const override;
  void Validate() const override;

 private:
  struct Level {
    bool still = false;
    std::uint32_t first = 0;  ///< Of sorted_.
    GridLevel grid;
  };
  struct Spot {
    std::uint32_t level = kUnsorted;  ///< Of grids, or kUnsorted.
    std::uint32_t place = 0;
  };
  static constexpr std::uint32_t kUnsorted = ~0u;

  /// The agents of one level, a part of sorted_.
  struct Part {
    std::uint32_t first, count;
    bool still;  ///< They never move.
  };
  /// Each agent of one level is looked for in the other.
  struct LevelPair {
    const Level *queries, *searched;
  };

  bool BuildPoints(const PlacedScene& scene, double last);
  void JoinPoints(const PlacedScene& scene, double last, SearchCost* cost, PairSink* sink);
  void SortByLevel(const PlacedScene& scene, const std::vector<PlacedBall>& horns);
  void BuildLevel(const PlacedScene& scene, const Part& part, const PlacedExtent& extent);
  void JoinRows(const Level& level, TimeWindow window, SearchCost* cost, PairSink* sink);
  static double CostOfSearch(const Level& level, const Level& other, TimeWindow window);
  void JoinCells(const PlacedScene& scene, const LevelPair& levels, TimeWindow window,
                 SearchCost* cost, PairSink* sink);
  void Scan(const PlacedBalls& lanes, const FilterQuery& query, SearchCost* cost,
            std::vector<std::uint32_t>* near);
  static void TakeAll(const GridLevel& grid, std::vector<std::uint32_t>* near);

  std::vector<Level> levels_;  ///< From small to large reach; the first level_count_ count.
  std::uint32_t level_count_ = 0;
  std::vector<PlacedBall> sorted_;  ///< In the order of levels and, within one, of agents.
  std::vector<Spot> places_;        ///< By agent.
  FilterRow unplaced_;
  PointGrid points_;        ///< Instead of levels, for one query about all agents.
  double points_last_ = 0;  ///< When points_ ends, after the begin [s]; 0: not in use.

  std::vector<float> reaches_;  ///< Of the horns given, like the keys of their levels.
  std::vector<std::uint8_t> keys_;
  std::vector<FilterRange> ranges_;
  std::vector<std::uint32_t> hits_, near_;
};

}  // namespace collision::broad_phase
