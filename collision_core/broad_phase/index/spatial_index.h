// The method for large and changing scenes: grids by size, asked best-first.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/index/grid_level.h"
#include "collision_core/broad_phase/index/windowed_search.h"

namespace collision::broad_phase {

/// Sorts agents by reach, in powers of 4 below the greatest, and gives each level a grid
/// (grid_level.h), so that neither a few large or fast agents nor clusters slow the others down. An
/// agent asks its own level and the coarser ones, so size ratios of 1e6 cost a dozen look-ups.
/// Agents that never move have grids of their own and do not ask each other. Of two levels, the one
/// for which it is less work asks the other: a few agents with a long reach ask the many, the
/// farthest-reaching first, because what they meet shortens the window for the rest.
///
/// An agent that is put anew goes to a list, which every question scans. All are placed anew once
/// as many tests were wasted on that list, or on a window long past, as placing costs: reaches grow
/// and agents stray from their places, so questions cost ever more. The moment is when the excess
/// over the first 64 questions adds up to the cost of placing, which is best where the excess grows
/// evenly. No answer depends on when that happens.
///
/// A question about all agents at once is one pass over a grid of points (point_grid.h) where the
/// scene suits one grid; crowds, very different reaches, and scenes that mostly stand still use the
/// levels.
class SpatialIndex : public WindowedSearch {
 protected:
  void PlaceAll() override;
  bool PlaceOnce(double last) override;
  void PlaceOne(const PlacedHorn& horn) override;
  void Unplace(std::uint32_t agent) override;
  void Join(TimeWindow stretch, PairSink* sink) override;
  void FindNear(const PlacedHorn& horn, TimeWindow stretch) override;

 private:
  struct Level {
    bool still = false;
    std::uint32_t first = 0;  ///< Its first horn in sorted_.
    GridLevel grid;
  };
  struct Place {
    std::uint32_t level = kLoose;  ///< Index of its level, or kLoose.
    std::uint32_t place = 0;
  };
  static constexpr std::uint32_t kLoose = ~0u;

  bool BuildPoints(double last);
  void JoinPoints(double last, PairSink* sink);
  void SortByLevel();
  void BuildLevel(bool still, std::uint32_t first, std::uint32_t count, const PlacedExtent& extent);
  void JoinRows(const Level& level, TimeWindow stretch, PairSink* sink);
  static double CostOfAsking(const Level& level, const Level& other, TimeWindow stretch);
  void JoinCells(const Level& level, const Level& other, TimeWindow stretch, PairSink* sink);
  void Scan(const PlacedBalls& lanes, const FilterQuery& query);
  void Take(const GridLevel& grid);

  std::vector<Level> levels_;  ///< From small to large reach; the first level_count_ count.
  std::uint32_t level_count_ = 0;
  std::vector<PlacedHorn> sorted_;  ///< In the order of levels and, within one, of agents.
  std::vector<Place> places_;       ///< By agent.
  FilterRow unplaced_;
  PointGrid points_;        ///< Instead of levels, for one question about all.
  double points_last_ = 0;  ///< Up to when it holds, after the begin [s]; 0: not in use.

  std::vector<float> reaches_;  ///< The reaches of horns_; keys_: those of their levels.
  std::vector<std::uint8_t> keys_;
  std::vector<FilterRange> ranges_;
  std::vector<std::uint32_t> hits_;
};

}  // namespace collision::broad_phase
