// A shape with a margin around it.
#pragma once

#include <cstddef>
#include <memory>

#include "collision_core/shape/shape.h"

namespace collision::shape {

/// The most triangles and solids of a shape that can be grown: each triangle becomes a solid, of
/// some 0.6 kB, and takes some 20 µs.
inline constexpr std::size_t kGrownElementsMax = 4096;

/// The least margin [m]: with it the smallest triangle makes a solid that may be part of a shape.
inline constexpr double kMarginMin = 1e-6;

/// Whether GrownShape() can grow the shape.
bool CanGrow(const Shape& shape);

/// The body of `shape` and all points within `margin` of it: its Minkowski sum with a ball.
///
/// It is a compound of solids: each solid is rounded by `margin` more, and each triangle becomes
/// the hull of its corners, rounded by `margin`. A closed surface stays beside them for its inside.
/// So everything that is certified about solids holds for the grown body, exactly up to one
/// rounding of the sum of two lengths: two bodies are within the sum of their margins of each other
/// exactly where the grown ones touch, and farther apart by as much.
///
/// `twin`: what this returned for a twin of `shape` and the same margin; null: none. Requires
/// CanGrow(shape) and a finite margin >= kMarginMin.
std::shared_ptr<const Shape> GrownShape(const std::shared_ptr<const Shape>& shape, double margin,
                                        const Shape* twin = nullptr);

}  // namespace collision::shape
