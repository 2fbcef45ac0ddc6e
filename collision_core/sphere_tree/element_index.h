// The elements of a shape: triangles and convex solids.
#pragma once

#include "collision_core/base/ids.h"

namespace collision {

/// An element of one shape. With n triangles in its surface, 0 to n − 1 are these triangles, and
/// n + k is its convex solid k.
using ElementIndex = Index<struct ElementTag>;

}  // namespace collision
