// Bad values stop here, where the caller can see which: the service would refuse them later and
// less clearly. The limits are those of the service.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "client/types.h"
#include "client/world.h"

namespace collision::client {

inline constexpr std::size_t kNameLengthMax = 64;  ///< Bytes, as in the IDL.
inline constexpr double kCoordinateMax = 1e15;     ///< [m]
inline constexpr double kSpeedMax = 1e9;           ///< [m/s]
inline constexpr double kAccelerationMax = 1e18;   ///< [m/s²], and [rad/s²]
inline constexpr double kRadiusMax = 1e12;         ///< [m], also of a position's error.
inline constexpr double kAngularSpeedMax = 1e9;    ///< [rad/s]
inline constexpr double kRotationErrorMax = 3.1415926535897936;     ///< [rad] π rounded up.
inline constexpr double kTimeStepMax = 3600;                        ///< [s]
inline constexpr double kUnitTolerance = 1e-3;                      ///< Of a length 1.
inline constexpr std::int64_t kInstantMax = std::int64_t{1} << 62;  ///< [ns] 146 years.
inline constexpr std::uint32_t kAgentsMax = 65536;                  ///< Of one simulator.
inline constexpr std::uint32_t kChunkSizeMax = 64;                  ///< As in the IDL.
inline constexpr std::size_t kShapeTrianglesMax = 5'000'000;  ///< The most a service can allow.
inline constexpr std::size_t kShapeSolidsMax = 65536;         ///< Of one shape.
inline constexpr std::size_t kShapeHullPointsMax = 1 << 20;   ///< Of all hulls of one shape.
/// Relative: a shape may stand out of its agent's ball by what rounding makes of a radius.
inline constexpr double kShapeRadiusTolerance = 1e-9;
inline constexpr std::chrono::hours kLeadMax{1};  ///< Longer than any way there and back.
inline constexpr std::uint32_t kDomainMax = 230;  ///< Beyond, RTPS has no ports left.

/// Each throws std::invalid_argument, "field: value, allowed: range", at the first value out of
/// range.
void Validate(const AgentDescription& description);
void Validate(const State& state);
void ValidateClock(std::int64_t clock_ns);

/// These throw std::runtime_error, as World::Connect() says.
void Validate(const WorldOptions& options);
void ValidateWorld(const std::string& world, std::uint32_t domain);

}  // namespace collision::client
