// What distances and their squares may lose to underflow.
#pragma once

namespace collision::sphere_tree {

/// Squares of coordinates below about 1e-154 m vanish, so that a computed distance is too small by
/// less than this [m].
inline constexpr double kDistanceUnderflow = 1e-150;

/// A computed square of a distance is too small by less than this through underflow [m²].
inline constexpr double kSquareUnderflow = 1e-290;

}  // namespace collision::sphere_tree
