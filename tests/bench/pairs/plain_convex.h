// Capsules, boxes and hulls, as plain numbers.
#pragma once

#include <array>
#include <string>

#include "tests/bench/pairs/method.h"

namespace collision::bench {

struct PlainConvex {
  enum class Kind { kCapsule, kBox, kHull };

  std::string name;
  Kind kind = Kind::kBox;
  /// Half extents of a box; for a capsule z counts, half its axis without the caps [m].
  std::array<double, 3> half{};
  double radius = 0;  ///< Of a capsule [m].
  PlainMesh hull;     ///< Closed and convex.
};

}  // namespace collision::bench
