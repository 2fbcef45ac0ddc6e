// From the wire to the core: the one place that validates.
//
// Whatever passes here is trusted by everything behind it. The ranges keep every intermediate
// result of the core finite (the pair polynomial reaches the fourth power of a distance) and far
// from where doubles are coarse; each is generous against anything that exists.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "collision_core/motion/motion_state.h"
#include "idl/messages.pb.h"
#include "server/refusal.h"

namespace collision::server {

inline constexpr double kCoordinateMax = 1e15;  ///< [m] A tenth of a light year.
inline constexpr double kSpeedMax = 1e9;        ///< [m/s] Three times light.
inline constexpr double kAccelerationMax =
    1e18;  ///< [m/s²] Any impact; "no bound at all" is not a bound.
inline constexpr double kRadiusMax = 1e12;  ///< [m] Beyond any star; also of a position's error.
inline constexpr double kAngularSpeedMax = 1e9;  ///< [rad/s]
inline constexpr double kRotationErrorMax =
    3.1415926535897936;                       ///< [rad] π rounded up: says nothing.
inline constexpr double kTimeStepMax = 3600;  ///< [s] Of an integrator.
inline constexpr std::int64_t kInstantMax = std::int64_t{1}
                                            << 62;  ///< [ns] Differences of two fit.
inline constexpr double kUnitTolerance = 1e-3;  ///< A unit vector or quaternion may be off by this.
inline constexpr std::uint32_t kSlotMax = 65535;  ///< Slots are reused, so they stay few.
inline constexpr int kStatesPerChunkMax = 64;     ///< As in collision.idl.
inline constexpr std::size_t kNameMax = 64;       ///< Characters, as in collision.idl.

template <typename Value>
using Decoded = std::variant<Value, Refusal>;

/// Whether the id is the one of the name it claims: otherwise one simulator could speak for
/// another.
std::optional<Refusal> CheckIdentity(const v1::AgentDescription& description);
std::optional<Refusal> CheckIdentity(const v1::SimulatorClock& clock);

/// The declaration of an agent. A speed cap of 0 is none: what was recorded before there was one, or
/// left the field out, says nothing about speed. Whoever names a shape awaits it: only the intake knows what has arrived.
Decoded<motion::AgentDeclaration> DecodeDescription(const v1::AgentDescription& description);

/// What is known about the times a state may carry.
struct StampRules {
  Instant latest = Instant::Never();  ///< The greatest time granted, or now + κ.
  Instant discontinuity_from =
      Instant::Always();  ///< The clock already told: a jump before it comes too late.
};

/// A quaternion that is nearly of unit length is normalised and its rotation error grows by what
/// that may hide.
Decoded<motion::MotionState> DecodeState(const v1::AgentStates& chunk, const v1::AgentState& state,
                                         const StampRules& rules);

/// Whether a chunk as a whole may be taken: its size.
std::optional<Refusal> CheckChunk(const v1::AgentStates& chunk);

/// Whether a state names a slot at all; it comes before everything that looks the slot up.
std::optional<Refusal> CheckSlot(const v1::AgentStates& chunk, const v1::AgentState& state);

/// Asks again for a state that has waited: its rules may not have been known when it came.
std::optional<Refusal> CheckStamp(const detection::AgentId& agent, Instant stamp,
                                  const StampRules& rules);

struct ClockRules {
  Instant earliest = Instant::Always();  ///< The clock told last in this run.
  Instant latest = Instant::Never();     ///< The greatest time granted, or now + κ.
  bool lock_step = true;                 ///< The world's time is simulated.
};

Decoded<Instant> DecodeClock(const v1::SimulatorClock& clock, const ClockRules& rules);

/// The hash of the agent's shape; empty: the ball is its shape.
std::string ShapeHashOf(const v1::AgentDescription& description);

/// Whether a part is one of as many as its shape makes, and of the length that it has among them.
std::optional<Refusal> CheckShapePart(const v1::ShapePart& part);

}  // namespace collision::server
