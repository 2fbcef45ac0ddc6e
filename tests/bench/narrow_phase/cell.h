// All contestants at the poses of one pair of bodies and one gap: asked, judged, compared.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/narrow_phase/parts.h"
#include "tests/bench/pairs/pose.h"

namespace collision::bench {

struct Cell {
  std::string kind;    ///< "" of meshes, "convex " of convex solids: before the names of the parts.
  std::string bodies;  ///< The mesh, or the kinds of the two solids.
  std::size_t triangles = 0;
  double diameter = 0;  ///< Of the larger one's bounding ball [m].
  const GapClass& gap;
  PoseSample sample = {};
  std::vector<Reply> distances = {};  ///< Certified, at the poses.
};

/// Named, not measured.
NarrowRow RowOf(const Cell& cell, const PairMethod& method);

/// The methods that are wanted at this cell.
PairMethods WantedOf(const NarrowSettings& settings, const Cell& cell, const PairMethods& methods);

/// Draws the poses, with the certified distance of each by `measure`. False: there are none.
bool DrawCell(const NarrowSettings& settings, const PairOracle& oracle, const PairMethod& measure,
              Cell* cell);

/// Adds a row for each method, and puts what is compared into the figures.
void Measure(const NarrowSettings& settings, const Cell& cell, const PairMethods& methods,
             NarrowReport* report);

}  // namespace collision::bench
