#include "server/codec/codec.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "collision_core/numeric/rounding.h"
#include "collision_core/shape/fixed_half_space.h"
#include "collision_core/shape/grown_shape.h"
#include "idl/identity.h"
#include "idl/limits.h"
#include "idl/shape_bytes.h"
#include "server/codec/field_check.h"
#include "server/codec/hypothetical.h"

namespace collision::server {

static_assert(wire::kMarginMin == shape::kMarginMin);
static_assert(wire::kCoordinateMax == shape::kHalfSpaceOffsetMax);

namespace {

Eigen::Vector3d ToVector(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

std::optional<Refusal> CheckName(std::uint64_t id, const std::string& name, Refusal where) {
  FieldCheck check(std::move(where));
  CheckSimulatorName(name, &check);
  if (id != SimulatorId(name)) {
    check.Refuse(v1::REJECTED_ID_MISMATCH, "simulator_id",
                 std::to_string(id) + "; the name \"" + name.substr(0, wire::kNameMax) + "\" has " +
                     std::to_string(SimulatorId(name)));
  }
  return check.refusal();
}

/// INT64_MAX is never; everything else must leave room for differences.
void CheckLater(const char* field, std::int64_t ns, FieldCheck* check) {
  if (ns != Instant::Never().nanoseconds())
    check->Integer(field, ns, -wire::kInstantMax, wire::kInstantMax);
}

/// Turns how far the length of a quaternion is off 1 into a rotation error [rad]: DecodeState().
constexpr double kRotationPerLengthError = 2.00001;

void TakeOrientation(const v1::Quaternion& wire, FieldCheck* check, motion::MotionState* state) {
  for (const double component : {wire.w(), wire.x(), wire.y(), wire.z()}) {
    check->Number("orientation", component, -2, 2);
  }
  const double length = std::sqrt(wire.w() * wire.w() + wire.x() * wire.x() + wire.y() * wire.y() +
                                  wire.z() * wire.z());
  if (length < wire::kUnitTolerance) {
    check->Refuse(v1::REJECTED_ZERO_QUATERNION, "orientation",
                  "length " + Show(length) + "; allowed: 1 within " + Show(wire::kUnitTolerance));
  }
  const double off = std::abs(length - 1);
  if (!(off <= wire::kUnitTolerance)) {
    check->Refuse(v1::REJECTED_NOT_UNIT, "orientation",
                  "length " + Show(length) + "; allowed: 1 within " + Show(wire::kUnitTolerance));
  }
  if (!check->passed()) return;
  state->q_WB = Eigen::Quaterniond(wire.w() / length, wire.x() / length, wire.y() / length,
                                   wire.z() / length);
  state->rotation_error =
      std::min(wire::kRotationErrorMax, state->rotation_error + kRotationPerLengthError * off);
}

/// Zero is "not declared". Normalising changes its length, not where it points.
void TakeDirection(const v1::AgentState& wire, FieldCheck* check, motion::MotionState* state) {
  check->Vector("thrust_direction", wire.thrust_direction(), 2);
  if (!check->passed()) return;
  const Eigen::Vector3d direction = ToVector(wire.thrust_direction());
  const double length = std::sqrt(direction.dot(direction));
  if (direction.isZero(0)) return;
  if (std::abs(length - 1) > wire::kUnitTolerance) {
    check->Refuse(
        v1::REJECTED_NOT_UNIT, "thrust_direction",
        "length " + Show(length) + "; allowed: 0, or 1 within " + Show(wire::kUnitTolerance));
  }
  CheckLater("direction_until_ns", wire.direction_until_ns(), check);
  state->direction = direction / length;
  state->direction_until = Instant::FromNanoseconds(wire.direction_until_ns());
}

/// Each list by itself, and that they do not contradict each other.
void CheckPartners(const v1::AgentDescription& wire, FieldCheck* check) {
  check->Text("assembly", wire.assembly(), wire::kNameMax);
  const auto check_list = [&](const char* field, const auto& names) {
    check->Integer(field, names.size(), 0, wire::kPartnersListedMax);
    for (const std::string& name : names) {
      check->Text(field, name, wire::kNameMax);
      if (name.empty()) {
        check->Refuse(v1::REJECTED_OUT_OF_RANGE, field, "an empty name; allowed: names of agents");
      } else if (name == wire.agent_name()) {
        check->Refuse(v1::REJECTED_OUT_OF_RANGE, field,
                      "\"" + name + "\", the agent itself; allowed: other agents");
      }
    }
  };
  check_list("meets_in_assembly", wire.meets_in_assembly());
  check_list("never_meets", wire.never_meets());
  if (!check->passed()) return;
  for (const std::string& name : wire.never_meets()) {
    if (std::ranges::count(wire.meets_in_assembly(), name) == 0) continue;
    check->Refuse(
        v1::REJECTED_OUT_OF_RANGE, "never_meets",
        "\"" + name + "\", which meets_in_assembly names too; allowed: in one of the two");
  }
}

void CheckStamp(std::int64_t stamp_ns, const StampRules& rules, FieldCheck* check) {
  check->Integer("stamp_ns", stamp_ns, -wire::kInstantMax, rules.latest.nanoseconds(),
                 v1::REJECTED_FUTURE_STAMP);
  check->Integer("stamp_ns", stamp_ns, rules.earliest.nanoseconds(), wire::kInstantMax,
                 v1::REJECTED_STALE);
}

}  // namespace

std::optional<Refusal> CheckIdentity(const v1::AgentDescription& description) {
  return CheckName(description.simulator_id(), description.simulator_name(), At(description));
}

std::optional<Refusal> CheckIdentity(const v1::SimulatorClock& clock) {
  return CheckName(clock.simulator_id(), clock.simulator_name(), At(clock));
}

namespace {

void CheckTags(const v1::AgentDescription& wire, FieldCheck* check) {
  std::set<std::string_view> keys;
  for (const v1::Tag& tag : wire.tags()) {
    check->Text("tags.key", tag.key(), wire::kTagKeyMax);
    check->Text("tags.value", tag.value(), wire::kTagValueMax);
    if (tag.key().empty()) {
      check->Refuse(v1::REJECTED_OUT_OF_RANGE, "tags.key",
                    "0 bytes; allowed: 1 to " + std::to_string(wire::kTagKeyMax));
    }
    if (!keys.insert(tag.key()).second) {
      check->Refuse(v1::REJECTED_OUT_OF_RANGE, "tags.key",
                    "\"" + tag.key().substr(0, wire::kTagKeyMax) + "\" twice; allowed: once");
    }
  }
}

/// Refuses what makes no sense of a half-space.
void CheckHalfSpace(const v1::AgentDescription& wire, FieldCheck* check) {
  if (!wire.has_half_space()) return;
  const Eigen::Vector3d normal = ToVector(wire.half_space().normal());
  if (auto refusal = shape::RefusalOfHalfSpace(normal, wire.half_space().offset_m())) {
    check->Refuse(v1::REJECTED_OUT_OF_RANGE, "half_space", *refusal);
  }
  const auto none = [&](const char* field, double told) {
    if (told == 0) return;
    check->Refuse(v1::REJECTED_OUT_OF_RANGE, field,
                  Show(told) + "; allowed of a half-space, which never moves and has no radius: 0");
  };
  none("radius_m", wire.radius_m());
  none("acceleration_max_m_s2", wire.acceleration_max_m_s2());
  none("jerk_max_m_s3", wire.jerk_max_m_s3());
  if (!ShapeHashOf(wire).empty()) {
    check->Refuse(v1::REJECTED_BAD_SHAPE, "shape_hash",
                  "a shape beside half_space; allowed: one of the two");
  }
  if (wire.hypothetical()) {
    check->Refuse(v1::REJECTED_OUT_OF_RANGE, "hypothetical",
                  "of a half-space; allowed: of what can move");
  }
}

std::shared_ptr<const shape::FixedHalfSpace> HalfSpaceOf(const v1::AgentDescription& wire) {
  if (!wire.has_half_space()) return nullptr;
  const v1::HalfSpace& told = wire.half_space();
  const auto half_space = shape::FixedHalfSpace::Build(ToVector(told.normal()), told.offset_m());
  return wire.margin_m() > 0 ? half_space->Grown(wire.margin_m()) : half_space;
}

}  // namespace

Decoded<detection::AgentDeclaration> DecodeDescription(const v1::AgentDescription& wire,
                                                       const AgentClasses& classes) {
  FieldCheck check(At(wire));
  check.Integer("slot", wire.slot(), 0, wire::kSlotMax);
  check.Text("agent_name", wire.agent_name(), wire::kNameMax);
  check.Text("assembly", wire.assembly(), wire::kNameMax);
  CheckTags(wire, &check);
  check.Number("radius_m", wire.radius_m(), 0, wire::kRadiusMax);
  check.Number("acceleration_max_m_s2", wire.acceleration_max_m_s2(), 0, wire::kAccelerationMax);
  check.Number("jerk_max_m_s3", wire.jerk_max_m_s3(), 0, wire::kJerkMax);
  check.Number("angular_acceleration_max_rad_s2", wire.angular_acceleration_max_rad_s2(),
               -wire::kAccelerationMax, wire::kAccelerationMax);
  check.Number("speed_max_m_s", wire.speed_max_m_s(), 0, wire::kSpeedMax);
  check.Number("time_step_s", wire.time_step_s(), 0, wire::kTimeStepMax);
  check.Number("margin_m", wire.margin_m(), 0, wire::kRadiusMax);
  if (wire.margin_m() > 0 && wire.margin_m() < wire::kMarginMin) {
    check.Refuse(v1::REJECTED_OUT_OF_RANGE, "margin_m",
                 Show(wire.margin_m()) + "; allowed: 0, or " + Show(wire::kMarginMin) + " to " +
                     Show(wire::kRadiusMax));
  }
  CheckPartners(wire, &check);
  const auto filter = classes.FilterOf(wire.class_name());
  if (!filter) {
    check.Text("class_name", wire.class_name(), wire::kClassNameMax);
    check.Refuse(v1::REJECTED_OUT_OF_RANGE, "class_name",
                 "\"" + wire.class_name() +
                     "\"; allowed: the classes of the service's configuration: " + classes.Names() +
                     "; or none");
  }
  const std::string hash = ShapeHashOf(wire);
  if (!hash.empty() && hash.size() != kShapeHashBytes) {
    check.Refuse(
        v1::REJECTED_BAD_SHAPE, "shape_hash",
        std::to_string(hash.size()) + " bytes; allowed: 0 or " + std::to_string(kShapeHashBytes));
  }
  CheckHalfSpace(wire, &check);
  if (!check.passed()) return *check.refusal();
  broad_phase::CollisionFilter of_agent = *filter;
  if (wire.hypothetical()) of_agent.side = kHypotheticalSide;
  const double alpha = wire.angular_acceleration_max_rad_s2();
  const double cap = wire.speed_max_m_s(), margin = wire.margin_m();
  const double radius = margin > 0 ? numeric::AddUp(wire.radius_m(), margin) : wire.radius_m();
  return detection::AgentDeclaration{.limits = {.radius = radius,
                                                .acceleration_max = wire.acceleration_max_m_s2(),
                                                .jerk_max = wire.jerk_max_m_s3(),
                                                .time_step = wire.time_step_s(),
                                                .speed_max = cap > 0 ? cap : numeric::kInfinity,
                                                .angular_acceleration_max = alpha < 0 ? -1 : alpha},
                                     .filter = of_agent,
                                     .margin = wire.margin_m(),
                                     .shape_awaited = !hash.empty(),
                                     .half_space = HalfSpaceOf(wire)};
}

v1::AgentLabel LabelOf(const v1::AgentDescription& description) {
  v1::AgentLabel label;
  label.set_simulator_name(description.simulator_name());
  label.set_agent_name(description.agent_name());
  label.set_assembly(description.assembly());
  *label.mutable_tags() = description.tags();
  return label;
}

std::optional<Refusal> CheckChunk(const v1::AgentStates& chunk) {
  FieldCheck check(At(chunk));
  check.Integer("states", chunk.states_size(), 0, wire::kStatesPerSampleMax,
                v1::REJECTED_CHUNK_TOO_LARGE);
  check.Integer("chunk", chunk.chunk(), 0, wire::kSlotMax);
  return check.refusal();
}

std::optional<Refusal> CheckSlot(const v1::AgentStates& chunk, const v1::AgentState& state) {
  FieldCheck check(At(chunk, state));
  check.Integer("slot", state.slot(), 0, wire::kSlotMax);
  return check.refusal();
}

Decoded<motion::MotionState> DecodeState(const v1::AgentStates& chunk, const v1::AgentState& wire,
                                         const StampRules& rules) {
  FieldCheck check(At(chunk, wire));
  check.Vector("position_m", wire.position_m(), wire::kCoordinateMax);
  check.Vector("velocity_m_s", wire.velocity_m_s(), wire::kSpeedMax);
  check.Vector("acceleration_m_s2", wire.acceleration_m_s2(), wire::kAccelerationMax);
  check.Vector("angular_velocity_rad_s", wire.angular_velocity_rad_s(), wire::kAngularSpeedMax);
  check.Number("position_error_m", wire.position_error_m(), 0, wire::kRadiusMax);
  check.Number("velocity_error_m_s", wire.velocity_error_m_s(), 0, wire::kSpeedMax);
  check.Number("rotation_error_rad", wire.rotation_error_rad(), 0, wire::kRotationErrorMax);
  CheckLater("expiry_ns", wire.expiry_ns(), &check);
  check.Integer("stamp_ns", wire.stamp_ns(), -wire::kInstantMax, wire::kInstantMax);
  CheckStamp(wire.stamp_ns(), rules, &check);
  if (wire.discontinuity()) {
    check.Integer("stamp_ns", wire.stamp_ns(), rules.discontinuity_from.nanoseconds(),
                  wire::kInstantMax, v1::REJECTED_STALE);
  }

  motion::MotionState state{.stamp = Instant::FromNanoseconds(wire.stamp_ns()),
                            .p_WA = ToVector(wire.position_m()),
                            .v_WA = ToVector(wire.velocity_m_s()),
                            .a_WA = ToVector(wire.acceleration_m_s2()),
                            .w_WB = ToVector(wire.angular_velocity_rad_s()),
                            .position_error = wire.position_error_m(),
                            .velocity_error = wire.velocity_error_m_s(),
                            .rotation_error = wire.rotation_error_rad(),
                            .expiry = Instant::FromNanoseconds(wire.expiry_ns()),
                            .discontinuity = wire.discontinuity()};
  TakeOrientation(wire.orientation(), &check, &state);
  TakeDirection(wire, &check, &state);
  if (!check.passed()) return *check.refusal();
  return state;
}

std::optional<Refusal> CheckStamp(const detection::AgentId& agent, Instant stamp,
                                  const StampRules& rules) {
  FieldCheck check({.topic = v1::TOPIC_AGENT_STATES,
                    .simulator_id = agent.simulator,
                    .run = agent.run,
                    .slot = agent.slot,
                    .generation = agent.generation});
  CheckStamp(stamp.nanoseconds(), rules, &check);
  return check.refusal();
}

Decoded<Instant> DecodeClock(const v1::SimulatorClock& wire, const ClockRules& rules) {
  FieldCheck check(At(wire));
  if (wire.lock_step() != rules.lock_step) {
    check.Refuse(v1::REJECTED_OUT_OF_RANGE, "lock_step",
                 rules.lock_step
                     ? "false (real time); this world runs in lock-step: start the "
                       "simulator in lock-step, or the service with clock kind REAL_TIME"
                     : "true (lock-step); this world runs in real time: start the "
                       "simulator in real time, or the service with clock kind LOCK_STEP");
  }
  check.Integer("clock_ns", wire.clock_ns(), -wire::kInstantMax, wire::kInstantMax);
  check.Integer("clock_ns", wire.clock_ns(), rules.earliest.nanoseconds(),
                Instant::Never().nanoseconds(), v1::REJECTED_CLOCK_BACKWARD);
  check.Integer("clock_ns", wire.clock_ns(), rules.earliest.nanoseconds(),
                rules.latest.nanoseconds(), v1::REJECTED_CLOCK_BEYOND_GRANT);
  if (!check.passed()) return *check.refusal();
  return Instant::FromNanoseconds(wire.clock_ns());
}

std::string ShapeHashOf(const v1::AgentDescription& description) {
  const std::string& hash = description.shape_hash();
  const bool none = std::all_of(hash.begin(), hash.end(), [](char byte) { return byte == 0; });
  return none ? std::string() : hash;
}

std::optional<Refusal> CheckShapePart(const v1::ShapePart& part) {
  FieldCheck check(At(part));
  const auto refuse = [&check](const char* field, const std::string& detail) {
    check.Refuse(v1::REJECTED_BAD_SHAPE, field, detail);
  };
  if (part.content_hash().size() != kShapeHashBytes) {
    refuse("content_hash", std::to_string(part.content_hash().size()) + " bytes; allowed: " +
                               std::to_string(kShapeHashBytes) + ", not all zero");
  }
  const std::uint64_t total = part.total_bytes();
  if (total < kShapeHeaderBytes) {
    refuse("total_bytes",
           std::to_string(total) + "; a shape has at least " + std::to_string(kShapeHeaderBytes));
  }
  const std::uint64_t parts = ShapeParts(total);
  const std::string of_all =
      std::to_string(parts) + " parts of " + std::to_string(wire::kShapePartBytes);
  if (part.parts() != parts) {
    refuse("parts", std::to_string(part.parts()) + "; " + std::to_string(total) + " bytes make " +
                        of_all + ", the last one shorter");
  }
  if (part.part() >= part.parts()) {
    refuse("part", std::to_string(part.part()) + "; allowed: 0 to " +
                       std::to_string(std::int64_t{part.parts()} - 1));
  }
  const bool last = part.part() + std::uint64_t{1} == parts;
  const std::uint64_t bytes =
      last ? total - part.part() * wire::kShapePartBytes : wire::kShapePartBytes;
  if (part.bytes().size() != bytes) {
    refuse("bytes", std::to_string(part.bytes().size()) + "; part " + std::to_string(part.part()) +
                        " of " + of_all + " has " + std::to_string(bytes));
  }
  return check.refusal();
}

}  // namespace collision::server
