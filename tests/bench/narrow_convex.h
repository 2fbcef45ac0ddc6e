// Capsules, boxes and hulls, as plain numbers.
#pragma once

#include <array>
#include <string>

#include "tests/bench/narrow_query.h"

namespace collision::bench {

struct PlainConvex {
  enum class Kind { kCapsule, kBox, kHull };

  std::string name;
  Kind kind = Kind::kBox;
  /// Half extents of a box; of a capsule z counts, half its axis without the caps [m].
  std::array<double, 3> half{};
  double radius = 0;  ///< Of a capsule [m].
  PlainMesh hull;     ///< Closed and convex.
};

/// Each library asks its own routine for this pair of kinds. One that was not found when this was
/// built answers nothing.
NarrowQueries FclConvexQueries(const PlainConvex& a, const PlainConvex& b);
NarrowQueries BulletConvexQueries(const PlainConvex& a, const PlainConvex& b);
NarrowQueries ConvexPeerQueries(const PlainConvex& a, const PlainConvex& b);

}  // namespace collision::bench
