// From the wire to the core: the one place that validates.
//
// Behind the codec every value is trusted. A refusal names reason, topic, slot, generation, field,
// the value and the allowed range; it costs the message that it names and nothing else: of a chunk,
// the bad slot. It is counted per reason and per simulator, logged at most once a second, and
// published as a rejection (world/rejections.h). Limits: idl/limits.h.
//
//   what                          allowed                                   else
//   any number                    finite                                    NOT_FINITE
//   coordinates, speeds, bounds   their limits; bounds and errors >= 0      OUT_OF_RANGE
//   instants                      +-2^62 ns; INT64_MAX means never          OUT_OF_RANGE
//   quaternion                    length 1 within 1e-3; is normalised       ZERO_QUATERNION,
//                                                                           NOT_UNIT
//   thrust direction              zero, or length 1 within 1e-3             NOT_UNIT
//   margin                        0, or 1e-6 m to a radius                  OUT_OF_RANGE
//   class                         one of the configuration, or none         OUT_OF_RANGE
//   lists of partners             16 names; not itself, none in both        OUT_OF_RANGE
//   hypothetical                  as the agent was described first          OUT_OF_RANGE
//   simulator id                  the hash of the name                      ID_MISMATCH
//   stamp                         simulated clock: the time granted;        FUTURE_STAMP
//                                 before the first grant now, or its first
//                                 clock, + grant_ahead_max_s;
//                                 wall clock: now + skew_max_s
//                                 not before the wall clock was set,        STALE
//                                 by more than skew_max_s, less that
//   discontinuity                 not before its simulator's clock          STALE
//   clock                         not before the last one of its run,       CLOCK_BACKWARD,
//                                 not later than a stamp may be             CLOCK_BEYOND_GRANT
//   lock-step                     as the world's clock: simulated yes,      OUT_OF_RANGE
//                                 wall no
//   chunk                         64 states, slots 0 to 65535               CHUNK_TOO_LARGE,
//                                                                           OUT_OF_RANGE
//   part of a shape               part, parts, total_bytes and the length   BAD_SHAPE
//                                 of bytes fit together (idl/PROTOCOL.md)
//
// Further reasons come from behind the codec: the owner of an id (world/world.h), what is missing
// (intake/agent_registry.h), shapes as a whole (shapes/shape_decoding.h, intake/agent_shapes.h), a
// sender whose clock is off (intake/sender_clocks.h).
// No errors: a state that is older than its agent's newest, of an ended generation, or repeated.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "collision_core/detection/agents/agent_declaration.h"
#include "idl/limits.h"
#include "idl/messages.pb.h"
#include "server/codec/agent_classes.h"
#include "server/codec/refusal.h"

namespace collision::server {

/// The value, or why there is none.
template <typename Value>
using Decoded = std::variant<Value, Refusal>;

/// Whether the id is the one of the name it claims: otherwise one simulator could speak for
/// another.
std::optional<Refusal> CheckIdentity(const v1::AgentDescription& description);
std::optional<Refusal> CheckIdentity(const v1::SimulatorClock& clock);

/// The declaration of an agent, but for what its names mean (intake/partner_names.h): assembly,
/// name and lists of its filter are empty. A speed cap of 0 is none: a recording from before the
/// field says nothing about speed. A description with a shape hash awaits its shape: only the
/// intake knows which shapes are there.
Decoded<detection::AgentDeclaration> DecodeDescription(const v1::AgentDescription& description,
                                                       const AgentClasses& classes = {});

/// What the agent is called, as events carry it.
v1::AgentLabel LabelOf(const v1::AgentDescription& description);

/// Which times a state may carry.
struct StampRules {
  Instant earliest = Instant::Always();  ///< See the table above.
  Instant latest = Instant::Never();     ///< Likewise.
  Instant discontinuity_from =
      Instant::Always();  ///< The simulator's clock: a jump before it comes too late.
};

/// A quaternion whose length is off by e <= 1e-3 is normalised, and the rotation error grows by
/// 2.00001 e: its components are off by about e, and across the quaternion that turns the rotation
/// by up to 2 asin(e) <= 2 e (1 + e^2). Normalising a direction does not turn it.
Decoded<motion::MotionState> DecodeState(const v1::AgentStates& chunk, const v1::AgentState& state,
                                         const StampRules& rules);

/// Whether a chunk as a whole may be taken: its size.
std::optional<Refusal> CheckChunk(const v1::AgentStates& chunk);

/// Whether a state names a slot that may exist; called before the slot is looked up.
std::optional<Refusal> CheckSlot(const v1::AgentStates& chunk, const v1::AgentState& state);

/// Checks the stamp of a state that has waited again: its rules were not known when it came.
std::optional<Refusal> CheckStamp(const detection::AgentId& agent, Instant stamp,
                                  const StampRules& rules);

/// Which clocks a simulator may publish.
struct ClockRules {
  Instant earliest = Instant::Always();  ///< The newest clock of this run.
  Instant latest = Instant::Never();     ///< As for a stamp.
  bool lock_step = true;                 ///< The world's time is simulated.
};

Decoded<Instant> DecodeClock(const v1::SimulatorClock& clock, const ClockRules& rules);

/// The hash of the agent's shape; empty: the ball is its shape.
std::string ShapeHashOf(const v1::AgentDescription& description);

/// Whether `part`, `parts`, `total_bytes` and the length of `bytes` fit together.
std::optional<Refusal> CheckShapePart(const v1::ShapePart& part);

}  // namespace collision::server
