// Solids on their way from the caller to the bytes of a shape: judged, in one form, measured.
#pragma once

#include <vector>

#include "client/solid.h"
#include "idl/shape_bytes.h"

namespace collision::client {

/// The same solids, alike where they mean the same: −0 is 0. Throws std::invalid_argument, "solids[number] (kind): field is value; allowed are ...",
/// at the first that the service would refuse.
std::vector<Solid> Canonical(std::vector<Solid> solids);

/// Of the smallest known ball about the reference point that contains all of them, rounded up [m].
double RadiusOf(const std::vector<Solid>& solids);

/// As they travel.
std::vector<SolidContent> ContentOf(const std::vector<Solid>& solids);

}  // namespace collision::client
