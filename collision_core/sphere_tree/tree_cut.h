// A sphere tree at a given number of balls: how well do they fit?
#pragma once

#include <span>
#include <vector>

#include "collision_core/sphere_tree/sphere_tree.h"

namespace collision::sphere_tree {

/// A cut of at most `count` nodes through the tree (at least the root), in ascending order: the
/// node that may overshoot its surface by the most is replaced by its children as long as they fit;
/// of equal ones the first node. Together the parts of a cut are the whole surface.
std::vector<NodeIndex> CutOfCount(const SphereTree& tree, std::size_t count);

/// How far the balls of a cut may reach beyond the surface: radius + signed distance [m].
struct Overshoot {
  double max = 0;
  double mean = 0;
};
/// The overshoot of a cut: how tight the builder's balls are.
Overshoot OvershootOf(const SphereTree& tree, std::span<const NodeIndex> cut);

}  // namespace collision::sphere_tree
