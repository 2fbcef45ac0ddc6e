// Convex solids from a text file (idl/solids.proto).
#pragma once

#include <string>
#include <vector>

#include "collision/solid.h"
#include "idl/solids.pb.h"

namespace collision::client {

/// The solid of a message; for one without a core a ball without a radius, which no shape accepts.
Solid SolidOf(const v1::ConvexSolid& message);

/// All solids of a file of protobuf text. Throws BadInput with the file's name, line and cause: the
/// file cannot be read or parsed, has no solids, one without a core, or a length
/// of a core that is missing or out of range. Shape::Make() checks all other values.
std::vector<Solid> ReadSolids(const std::string& path);

}  // namespace collision::client
