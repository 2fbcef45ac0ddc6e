// A sphere tree at a given number of balls: how well do they fit?
#pragma once

#include <span>
#include <vector>

#include "collision_core/shape/sphere_tree.h"

namespace collision {

/// A cut of at most `count` nodes through the tree (at least the root): again and again the node
/// that may overshoot its surface by the most is replaced by its children, if they fit; ties by
/// number. Together the parts of a cut are the whole surface.
std::vector<std::uint32_t> CutOfCount(const SphereTree& tree, std::size_t count);

/// How far the balls of a cut may reach beyond the surface: radius + signed distance [m].
struct Overshoot {
  double max = 0;
  double mean = 0;
};
Overshoot OvershootOf(const SphereTree& tree, std::span<const std::uint32_t> cut);

}  // namespace collision
