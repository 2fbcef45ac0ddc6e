// Surfaces and solids out of a fuzzer's bytes.
#pragma once

#include <memory>

#include "collision/shape.h"
#include "collision_core/shape/shape.h"
#include "tests/fuzz/fuzzed_data.h"

namespace collision::fuzz {

/// A few triangles between a few points, many of them at the same places, and a few solids; either
/// may be missing, and any number may be out of range.
client::Geometry FuzzedGeometry(FuzzedData* data);

/// A body of size 1 or so, or null: a ball. Always the same few, so that they cost nothing to
/// build.
std::shared_ptr<const shape::Shape> FuzzedBody(FuzzedData* data);

}  // namespace collision::fuzz
