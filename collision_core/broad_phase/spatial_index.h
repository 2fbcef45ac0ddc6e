// The method for large and changing scenes: grids by size, asked best-first.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/grid_level.h"
#include "collision_core/broad_phase/near_search.h"

namespace collision {

/// Agents of like reach share a grid, so that neither a few large or fast ones nor clusters slow
/// the others down; those that never move have grids of their own, which they do not ask each other
/// about. Who is put anew goes to a list until the next placing. README.md beside this file.
class SpatialIndex : public NearSearch {
 protected:
  void PlaceAll() override;
  bool PlaceOnce(double last) override;
  void PlaceOne(const PlacedHorn& horn) override;
  void Unplace(std::uint32_t agent) override;
  void Join(Stretch stretch, PairSink* sink) override;
  void FindNear(const PlacedHorn& horn, Stretch stretch) override;

 private:
  struct Level {
    bool still = false;
    std::uint32_t first = 0;  ///< Of sorted_.
    GridLevel grid;
  };
  struct Place {
    std::uint32_t level = kLoose;  ///< Of grids, or kLoose.
    std::uint32_t place = 0;
  };
  static constexpr std::uint32_t kLoose = ~0u;

  bool BuildPoints(double last);
  void JoinPoints(double last, PairSink* sink);
  void SortByLevel();
  void BuildLevel(bool still, std::uint32_t first, std::uint32_t count, const PlacedExtent& extent);
  void JoinRows(const Level& level, Stretch stretch, PairSink* sink);
  static double CostOfAsking(const Level& level, const Level& other, Stretch stretch);
  void JoinCells(const Level& level, const Level& other, Stretch stretch, PairSink* sink);
  void Scan(const Lanes& lanes, const LaneQuery& query);
  void Take(const GridLevel& grid);

  std::vector<Level> levels_;  ///< From small to large reach; the first level_count_ count.
  std::uint32_t level_count_ = 0;
  std::vector<PlacedHorn> sorted_;  ///< In the order of levels and, within one, of agents.
  std::vector<Place> places_;       ///< By agent.
  LaneRow loose_;
  PointGrid points_;        ///< Instead of levels, for one question about all.
  double points_last_ = 0;  ///< Up to when it holds, after the begin [s]; 0: not in use.

  std::vector<float> reaches_;  ///< Of horns_, like the keys of their levels.
  std::vector<std::uint8_t> keys_;
  std::vector<LaneRange> ranges_;
  std::vector<std::uint32_t> hits_;
};

}  // namespace collision
