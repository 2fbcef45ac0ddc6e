// Convex solids on their way into a shape: checked, in canonical form, measured.
#pragma once

#include <vector>

#include "collision/solid.h"
#include "idl/shape_bytes.h"

namespace collision::client {

/// Greatest length of a core, and of what it is rounded by [m]; the core's kConvexSizeMax.
inline constexpr double kSolidLengthMax = 1e7;

/// The same solids in a form in which equal values have equal bytes: −0 becomes 0. Throws
/// std::invalid_argument, "solids[number] (kind): field: value, allowed: range", for the first
/// that the service would refuse.
std::vector<Solid> Canonical(std::vector<Solid> solids);

/// Radius of a ball about the reference point that contains all of them, rounded up [m].
double RadiusOf(const std::vector<Solid>& solids);

/// As they are sent.
std::vector<SolidContent> ContentOf(const std::vector<Solid>& solids);

}  // namespace collision::client
