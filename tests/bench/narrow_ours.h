// Our narrow phase as a contestant.
#pragma once

#include <memory>

#include "collision_core/shape/shape.h"
#include "tests/bench/narrow_query.h"

namespace collision::bench {

/// What answers of distance are held to, of the distance; and of brackets, of the diameter.
inline constexpr double kDistanceShare = 1e-6;
inline constexpr double kBracketShare = 0.01;

/// Decision, distance and bracket; from the pose as the caller has it to the certified answer.
NarrowQueries OurQueries(std::shared_ptr<const shape::Shape> shape, double diameter,
                         const std::string& name, Who who);

}  // namespace collision::bench
