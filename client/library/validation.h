// Checks values before they are sent, where the caller sees which one is wrong: the service would
// refuse them later and less clearly. The limits are those of the wire (idl/limits.h).
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "collision/types.h"
#include "collision/world.h"
#include "idl/limits.h"

namespace collision::client {

using wire::kAccelerationMax;
using wire::kAngularSpeedMax;
using wire::kCoordinateMax;
using wire::kDomainMax;
using wire::kInstantMax;
using wire::kNameMax;
using wire::kRadiusMax;
using wire::kRotationErrorMax;
using wire::kShapeHullPointsMax;
using wire::kShapeRadiusTolerance;
using wire::kShapeSolidsMax;
using wire::kShapeTrianglesMax;
using wire::kSpeedMax;
using wire::kTimeStepMax;
using wire::kUnitTolerance;

inline constexpr std::uint32_t kAgentsMax = wire::kSlotMax + 1;  ///< Of one simulator.
inline constexpr std::uint32_t kChunkSizeMax = wire::kStatesPerChunkMax;
inline constexpr std::chrono::hours kLeadMax{1};  ///< Longer than any way there and back.

/// Each throws std::invalid_argument, "field: value, allowed: range", at the first value out of
/// range.
void Validate(const AgentDescription& description);
void Validate(const State& state);
void ValidateClock(std::int64_t clock_ns);

/// These throw std::runtime_error, as World::Connect() says.
void Validate(const WorldOptions& options);
void ValidateWorld(const std::string& world, std::uint32_t domain);

}  // namespace collision::client
