// Convex solids from a text file (idl/solids.proto).
#pragma once

#include <string>
#include <vector>

#include "client/solid.h"
#include "idl/solids.pb.h"

namespace collision::client {

/// What the message says; of a solid without a core a ball without a radius, which no shape takes.
Solid SolidOf(const v1::ConvexSolid& message);

/// All solids of a file of protobuf text. Throws BadInput, with the file's name, line and cause: not
/// to be read, not such a text, no solids, one without a core. Values are judged by Shape::Make().
std::vector<Solid> ReadSolids(const std::string& path);

}  // namespace collision::client
