// Capsules, boxes and hulls: the same contest against FCL's and Bullet's own routines.
#include <algorithm>

#include "tests/bench/narrow_phase/cell.h"
#include "tests/bench/pairs/ours.h"
#include "tests/bench/pairs/peers.h"

namespace collision::bench {
namespace {

void Contest(const NarrowSettings& settings, const PlainConvex& a, const PlainConvex& b,
             NarrowReport* report) {
  const geometry::ConvexPair pair{SolidOf(a), SolidOf(b)};
  PairMethods methods = OurConvex(pair);
  Append(ConvexPeers(a, b), &methods);
  for (const GapClass& gap : GapClasses()) {
    Cell cell{"convex ", a.name + " " + b.name,
              std::max(a.hull.triangles.size(), b.hull.triangles.size()), 2, gap};
    const PairMethods wanted = WantedOf(settings, cell, methods);
    if (wanted.empty() || !DrawCell(settings, OracleOf(pair), methods[1], &cell)) continue;
    Measure(settings, cell, wanted, report);
  }
}

}  // namespace

void ConvexPart(const NarrowSettings& settings, NarrowReport* report) {
  const std::vector<PlainConvex> all = Convexes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = i; k < all.size(); ++k) Contest(settings, all[i], all[k], report);
  }
}

}  // namespace collision::bench
