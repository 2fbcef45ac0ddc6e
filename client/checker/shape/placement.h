// Points of a solid's own axes in those of its body.
#pragma once

#include <array>
#include <vector>

#include "client/checker/shape/vector.h"

namespace collision::checker {

/// The points rotated by q / |q| (w, x, y, z), then moved by p. Throws std::runtime_error for q =
/// 0.
std::vector<Vector> Placed(std::vector<Vector> points, const std::array<double, 4>& q,
                           const Vector& p);

}  // namespace collision::checker
