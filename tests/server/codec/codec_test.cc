#include "server/codec/codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "collision_core/shape/fixed_half_space.h"
#include "idl/control_character.h"
#include "idl/limits.h"
#include "idl/shape_bytes.h"
#include "tests/server/shapes/shapes.h"

namespace collision::server {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Decoded<motion::MotionState> Decode(const v1::AgentState& state, const StampRules& rules = {}) {
  return DecodeState(Chunk("a"), state, rules);
}

struct StateCase {
  const char* field;
  v1::RejectionReason reason;
  std::function<void(v1::AgentState*)> spoil;
};

std::vector<StateCase> BadStates() {
  using S = v1::AgentState;
  const auto far = v1::REJECTED_OUT_OF_RANGE, odd = v1::REJECTED_NOT_FINITE;
  return {
      {"position_m.x", odd, [](S* s) { s->mutable_position_m()->set_x(kNaN); }},
      {"position_m.y", odd, [](S* s) { s->mutable_position_m()->set_y(-kInf); }},
      {"position_m.z", far, [](S* s) { s->mutable_position_m()->set_z(1.001e15); }},
      {"velocity_m_s.x", odd, [](S* s) { s->mutable_velocity_m_s()->set_x(kInf); }},
      {"velocity_m_s.z", far, [](S* s) { s->mutable_velocity_m_s()->set_z(-1.001e9); }},
      {"angular_velocity_rad_s.y", odd,
       [](S* s) { s->mutable_angular_velocity_rad_s()->set_y(kNaN); }},
      {"position_error_m", far, [](S* s) { s->set_position_error_m(-1e-300); }},
      {"position_error_m", odd, [](S* s) { s->set_position_error_m(kInf); }},
      {"velocity_error_m_s", far, [](S* s) { s->set_velocity_error_m_s(-1); }},
      {"rotation_error_rad", far, [](S* s) { s->set_rotation_error_rad(3.2); }},
      {"orientation", odd, [](S* s) { s->mutable_orientation()->set_x(kNaN); }},
      {"orientation", v1::REJECTED_ZERO_QUATERNION,
       [](S* s) { s->mutable_orientation()->set_w(0); }},
      {"orientation", v1::REJECTED_NOT_UNIT,
       [](S* s) { s->mutable_orientation()->set_w(1.00101); }},
      {"orientation", v1::REJECTED_NOT_UNIT,
       [](S* s) { s->mutable_orientation()->set_w(-0.9989); }},
      {"thrust_direction", v1::REJECTED_NOT_UNIT,
       [](S* s) { s->mutable_thrust_direction()->set_y(0.5); }},
      {"thrust_direction.z", odd, [](S* s) { s->mutable_thrust_direction()->set_z(kNaN); }},
      {"stamp_ns", far, [](S* s) { s->set_stamp_ns(kNeverNs); }},
      {"expiry_ns", far, [](S* s) { s->set_expiry_ns(kNeverNs - 1); }},
  };
}

// Goal:   every value that is not a number, or lies outside its range, is refused with its field
//         and reason.
// Method: one good state, spoiled in one place at a time; the good one passes.
TEST(Codec, RefusesBadStatesByField) {
  ASSERT_TRUE(std::holds_alternative<motion::MotionState>(Decode(State(3, 5, 1))));
  for (const StateCase& bad : BadStates()) {
    v1::AgentState state = State(3, 5, 1);
    bad.spoil(&state);
    const auto decoded = Decode(state);
    const Refusal* refusal = std::get_if<Refusal>(&decoded);
    ASSERT_NE(refusal, nullptr) << bad.field;
    EXPECT_EQ(refusal->reason, bad.reason) << bad.field;
    EXPECT_EQ(refusal->field, bad.field);
    EXPECT_EQ(refusal->topic, v1::TOPIC_AGENT_STATES);
    EXPECT_EQ(refusal->slot, 3u);
    EXPECT_EQ(refusal->generation, 1u);
    EXPECT_FALSE(refusal->detail.empty());
  }
}

// Goal:   words about an agent that the wire could not carry in its events are refused by field.
// Method: one good description, spoiled in one place at a time.
TEST(Codec, RefusesAssembliesAndTagsThatEventsCannotCarry) {
  v1::AgentDescription good = Description("a", 1);
  good.set_assembly(std::string(wire::kNameMax, 'x'));
  good.add_tags()->set_key(std::string(wire::kTagKeyMax, 'k'));
  good.mutable_tags(0)->set_value(std::string(wire::kTagValueMax, 'v'));
  EXPECT_TRUE(std::holds_alternative<detection::AgentDeclaration>(DecodeDescription(good)));
  const auto field_of = [&good](const std::function<void(v1::AgentDescription*)>& spoil) {
    v1::AgentDescription bad = good;
    spoil(&bad);
    const auto decoded = DecodeDescription(bad);
    const Refusal* refusal = std::get_if<Refusal>(&decoded);
    return refusal == nullptr ? "" : refusal->field;
  };
  using D = v1::AgentDescription;
  EXPECT_EQ(field_of([](D* d) { d->mutable_assembly()->push_back('x'); }), "assembly");
  EXPECT_EQ(field_of([](D* d) { d->mutable_tags(0)->mutable_key()->push_back('k'); }), "tags.key");
  EXPECT_EQ(field_of([](D* d) { d->mutable_tags(0)->clear_key(); }), "tags.key");
  EXPECT_EQ(field_of([](D* d) { *d->add_tags() = d->tags(0); }), "tags.key") << "twice";
  EXPECT_EQ(field_of([](D* d) { d->mutable_tags(0)->mutable_value()->push_back('v'); }),
            "tags.value");
}

// Goal:   the ends of every range still pass.
// Method: values at the limits, all at once.
TEST(Codec, AcceptsTheLimits) {
  v1::AgentState state = State(wire::kSlotMax, -wire::kInstantMax, 1);
  state.mutable_position_m()->set_x(-wire::kCoordinateMax);
  state.mutable_velocity_m_s()->set_y(wire::kSpeedMax);
  state.set_position_error_m(wire::kRadiusMax);
  state.set_rotation_error_rad(wire::kRotationErrorMax);
  state.set_expiry_ns(wire::kInstantMax);
  EXPECT_TRUE(std::holds_alternative<motion::MotionState>(Decode(state)));
  v1::AgentDescription description = Description("a", wire::kSlotMax);
  description.set_radius_m(0);
  description.set_acceleration_max_m_s2(wire::kAccelerationMax);
  description.set_shape_hash(std::string(kShapeHashBytes, '\0'));
  const auto ball = DecodeDescription(description);
  ASSERT_TRUE(std::holds_alternative<detection::AgentDeclaration>(ball));
  EXPECT_FALSE(std::get<detection::AgentDeclaration>(ball).shape_awaited);
  description.set_shape_hash(std::string(kShapeHashBytes, 'h'));
  description.set_angular_acceleration_max_rad_s2(wire::kAccelerationMax);
  const auto shaped = DecodeDescription(description);
  ASSERT_TRUE(std::holds_alternative<detection::AgentDeclaration>(shaped));
  EXPECT_TRUE(std::get<detection::AgentDeclaration>(shaped).shape_awaited);
  EXPECT_EQ(std::get<detection::AgentDeclaration>(shaped).limits.angular_acceleration_max,
            wire::kAccelerationMax);
}

// Goal:   a margin is part of the radius, rounded up; none leaves it as it is.
TEST(Codec, AddsTheMarginToTheRadius) {
  v1::AgentDescription description = Description("a", 1);
  description.set_radius_m(0.1);
  const auto plain = std::get<detection::AgentDeclaration>(DecodeDescription(description));
  EXPECT_EQ(plain.limits.radius, 0.1);
  EXPECT_EQ(plain.margin, 0);
  description.set_margin_m(0.7);
  const auto grown = std::get<detection::AgentDeclaration>(DecodeDescription(description));
  EXPECT_GE(grown.limits.radius, 0.1 + 0.7);
  EXPECT_LE(grown.limits.radius, std::nextafter(0.1 + 0.7, 1));
  EXPECT_EQ(grown.margin, 0.7);
}

// Goal:   an angular acceleration that is not declared is one number, whatever was sent for it.
TEST(Codec, TakesTheAngularAcceleration) {
  v1::AgentDescription description = Description("a", 1);
  for (const auto& [sent, taken] : {std::pair(-7.0, -1.0), {-0.0, 0.0}, {0.0, 0.0}, {2.5, 2.5}}) {
    description.set_angular_acceleration_max_rad_s2(sent);
    const auto decoded = std::get<detection::AgentDeclaration>(DecodeDescription(description));
    EXPECT_EQ(decoded.limits.angular_acceleration_max, taken);
  }
}

// Goal:   a speed cap reaches the core as it is; none is no cap, also where the field was not there
//         yet.
// Method: the least and the greatest; a description as it was recorded before there was the field.
TEST(Codec, TakesTheSpeedCap) {
  v1::AgentDescription description = Description("a", 1);
  for (const auto& [sent, taken] : {std::pair(15.0, 15.0),
                                    {1e-300, 1e-300},
                                    {wire::kSpeedMax, wire::kSpeedMax},
                                    {0.0, kInf},
                                    {-0.0, kInf}}) {
    description.set_speed_max_m_s(sent);
    EXPECT_EQ(
        std::get<detection::AgentDeclaration>(DecodeDescription(description)).limits.speed_max,
        taken)
        << sent;
  }
  description.set_speed_max_m_s(7);
  v1::AgentDescription recorded;
  ASSERT_TRUE(recorded.ParseFromString(description.SerializeAsString()));
  recorded.clear_speed_max_m_s();
  EXPECT_EQ(std::get<detection::AgentDeclaration>(DecodeDescription(recorded)).limits.speed_max,
            kInf);
}

// Goal:   a quaternion off by less than 1e-3 is normalised, and its error covers what that may
//         hide; an exact one gains no more than rounding.
TEST(Codec, NormalisesQuaternionsConservatively) {
  v1::AgentState state = State(0, 0, 1);
  state.mutable_orientation()->set_w(0.6 * 1.0009);
  state.mutable_orientation()->set_z(0.8 * 1.0009);
  state.set_rotation_error_rad(0.1);
  const auto near = std::get<motion::MotionState>(Decode(state));
  EXPECT_NEAR(near.q_WB.norm(), 1, 1e-15);
  EXPECT_GE(near.rotation_error, 0.1 + 2 * std::asin(0.0009));
  EXPECT_LE(near.rotation_error, 0.1 + 0.0019);
  const auto exact = std::get<motion::MotionState>(Decode(State(0, 0, 1)));
  EXPECT_EQ(exact.rotation_error, 0);
}

TEST(Codec, NormalisesTheThrustDirection) {
  v1::AgentState state = State(0, 0, 1);
  state.mutable_thrust_direction()->set_y(-1.0009);
  state.set_direction_until_ns(7);
  const auto decoded = std::get<motion::MotionState>(Decode(state));
  EXPECT_EQ(decoded.direction, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(decoded.direction_until, Instant::FromNanoseconds(7));
}

// Goal:   stamps beyond what is granted and jumps before the sent clock are refused, each for its
//         reason; the last allowed nanosecond passes.
TEST(Codec, ChecksStamps) {
  const StampRules rules{.latest = Instant::FromNanoseconds(100),
                         .discontinuity_from = Instant::FromNanoseconds(50)};
  v1::AgentState state = State(0, 101, 1);
  EXPECT_EQ(std::get<Refusal>(Decode(state, rules)).reason, v1::REJECTED_FUTURE_STAMP);
  state.set_stamp_ns(100);
  EXPECT_TRUE(std::holds_alternative<motion::MotionState>(Decode(state, rules)));
  state.set_stamp_ns(49);
  EXPECT_TRUE(std::holds_alternative<motion::MotionState>(Decode(state, rules)));
  state.set_discontinuity(true);
  EXPECT_EQ(std::get<Refusal>(Decode(state, rules)).reason, v1::REJECTED_STALE);
  state.set_stamp_ns(50);
  EXPECT_TRUE(std::holds_alternative<motion::MotionState>(Decode(state, rules)));
  const StampRules of_epoch{.earliest = Instant::FromNanoseconds(50)};
  EXPECT_TRUE(std::holds_alternative<motion::MotionState>(Decode(state, of_epoch)));
  state.set_stamp_ns(49);
  EXPECT_EQ(std::get<Refusal>(Decode(state, of_epoch)).reason, v1::REJECTED_STALE);
}

struct DescriptionCase {
  const char* field;
  v1::RejectionReason reason;
  std::function<void(v1::AgentDescription*)> spoil;
};

v1::AgentDescription* MakeFloor(v1::AgentDescription* description) {
  description->set_radius_m(0);
  description->set_acceleration_max_m_s2(0);
  description->mutable_half_space()->mutable_normal()->set_z(1);
  description->mutable_half_space()->set_offset_m(2);
  return description;
}

// Goal:   a half-space is taken as it is told, and higher by its margin.
TEST(Codec, AHalfSpaceIsHigherByItsMargin) {
  v1::AgentDescription description = Description("a", 1);
  MakeFloor(&description);
  const auto plain = std::get<detection::AgentDeclaration>(DecodeDescription(description));
  ASSERT_TRUE(plain.half_space);
  EXPECT_EQ(plain.half_space->normal(), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(plain.half_space->offset(), 2);
  description.set_margin_m(0.25);
  const auto grown = std::get<detection::AgentDeclaration>(DecodeDescription(description));
  EXPECT_GE(grown.half_space->offset(), 2.25);
  EXPECT_LE(grown.half_space->offset(), 2.25 * (1 + 1e-15));
}

TEST(Codec, RefusesBadDescriptionsByField) {
  using D = v1::AgentDescription;
  const auto far = v1::REJECTED_OUT_OF_RANGE, odd = v1::REJECTED_NOT_FINITE;
  const std::vector<DescriptionCase> cases = {
      {"radius_m", far, [](D* d) { d->set_radius_m(-1e-9); }},
      {"radius_m", odd, [](D* d) { d->set_radius_m(kNaN); }},
      {"radius_m", far, [](D* d) { d->set_radius_m(1.001e12); }},
      {"acceleration_max_m_s2", far, [](D* d) { d->set_acceleration_max_m_s2(-1); }},
      {"acceleration_max_m_s2", odd, [](D* d) { d->set_acceleration_max_m_s2(kInf); }},
      {"angular_acceleration_max_rad_s2", odd,
       [](D* d) { d->set_angular_acceleration_max_rad_s2(kNaN); }},
      {"speed_max_m_s", far, [](D* d) { d->set_speed_max_m_s(-1); }},
      {"speed_max_m_s", far, [](D* d) { d->set_speed_max_m_s(1.001e9); }},
      {"speed_max_m_s", odd, [](D* d) { d->set_speed_max_m_s(kNaN); }},
      {"speed_max_m_s", odd, [](D* d) { d->set_speed_max_m_s(kInf); }},
      {"time_step_s", far, [](D* d) { d->set_time_step_s(-1e-3); }},
      {"slot", far, [](D* d) { d->set_slot(wire::kSlotMax + 1); }},
      {"agent_name", far, [](D* d) { d->set_agent_name(std::string(65, 'x')); }},
      {"agent_name", far, [](D* d) { d->set_agent_name("ada\x1b[2J"); }},
      {"assembly", far, [](D* d) { d->set_assembly("two\nlines"); }},
      {"class_name", far, [](D* d) { d->set_class_name("a\x7f"); }},
      {"tags.value", far,
       [](D* d) {
         v1::Tag* tag = d->add_tags();
         tag->set_key("kind");
         tag->set_value(
             "\xc2\x9b"
             "2J");
       }},
      {"margin_m", far, [](D* d) { d->set_margin_m(-1e-9); }},
      {"margin_m", far, [](D* d) { d->set_margin_m(1e-7); }},
      {"margin_m", odd, [](D* d) { d->set_margin_m(kNaN); }},
      {"class_name", far, [](D* d) { d->set_class_name("robot"); }},
      {"assembly", far, [](D* d) { d->set_assembly(std::string(65, 'x')); }},
      {"meets_in_assembly", far, [](D* d) { d->add_meets_in_assembly(""); }},
      {"meets_in_assembly", far, [](D* d) { d->add_meets_in_assembly(std::string(65, 'x')); }},
      {"meets_in_assembly", far,
       [](D* d) {
         for (int i = 0; i < 17; ++i) d->add_meets_in_assembly(std::to_string(i));
       }},
      {"never_meets", far, [](D* d) { d->add_never_meets(d->agent_name()); }},
      {"never_meets", far,
       [](D* d) {
         d->add_never_meets("x");
         d->add_meets_in_assembly("x");
       }},
      {"shape_hash", v1::REJECTED_BAD_SHAPE, [](D* d) { d->set_shape_hash("\x01"); }},
      {"radius_m", far, [](D* d) { MakeFloor(d)->set_radius_m(1); }},
      {"acceleration_max_m_s2", far, [](D* d) { MakeFloor(d)->set_acceleration_max_m_s2(1); }},
      {"jerk_max_m_s3", far, [](D* d) { MakeFloor(d)->set_jerk_max_m_s3(1); }},
      {"half_space", far,
       [](D* d) { MakeFloor(d)->mutable_half_space()->mutable_normal()->set_z(1.00001); }},
      {"half_space", far,
       [](D* d) { MakeFloor(d)->mutable_half_space()->mutable_normal()->set_x(kNaN); }},
      {"half_space", far, [](D* d) { MakeFloor(d)->mutable_half_space()->set_offset_m(1.1e15); }},
      {"shape_hash", v1::REJECTED_BAD_SHAPE,
       [](D* d) { MakeFloor(d)->set_shape_hash(std::string(32, 'h')); }},
  };
  for (const DescriptionCase& bad : cases) {
    v1::AgentDescription description = Description("a", 1);
    bad.spoil(&description);
    const auto decoded = DecodeDescription(description);
    const Refusal* refusal = std::get_if<Refusal>(&decoded);
    ASSERT_NE(refusal, nullptr) << bad.field;
    EXPECT_EQ(refusal->reason, bad.reason) << bad.field;
    EXPECT_EQ(refusal->field, bad.field);
    EXPECT_FALSE(wire::FindControl(refusal->detail)) << "it stands in a log";
  }
}

// A partition and a line of a log have it.
TEST(Codec, TheNameOfASimulatorIsAWord) {
  for (const std::string& name : {std::string("a.b"), std::string("a b"), std::string("*"),
                                  std::string("a\x1b[2J"), std::string(), std::string(65, 'x')}) {
    const auto of_agent = CheckIdentity(Description(name, 1));
    const auto of_clock = CheckIdentity(ClockOf(name, 0));
    for (const auto& refusal : {of_agent, of_clock}) {
      ASSERT_TRUE(refusal) << name;
      EXPECT_EQ(refusal->reason, v1::REJECTED_OUT_OF_RANGE);
      EXPECT_EQ(refusal->field, "simulator_name");
      EXPECT_FALSE(wire::FindControl(refusal->detail)) << "it stands in a log";
    }
  }
}

TEST(Codec, ChecksThatTheIdIsTheNames) {
  v1::AgentDescription description = Description("a", 1);
  EXPECT_FALSE(CheckIdentity(description));
  description.set_simulator_name("b");
  EXPECT_EQ(CheckIdentity(description)->reason, v1::REJECTED_ID_MISMATCH);
  v1::SimulatorClock clock = ClockOf("a", 0);
  EXPECT_FALSE(CheckIdentity(clock));
  clock.set_simulator_id(clock.simulator_id() + 1);
  EXPECT_EQ(CheckIdentity(clock)->reason, v1::REJECTED_ID_MISMATCH);
}

TEST(Codec, ChecksClocks) {
  const ClockRules rules{.earliest = Instant::FromNanoseconds(10),
                         .latest = Instant::FromNanoseconds(20)};
  EXPECT_EQ(std::get<Refusal>(DecodeClock(ClockOf("a", 9), rules)).reason,
            v1::REJECTED_CLOCK_BACKWARD);
  EXPECT_EQ(std::get<Refusal>(DecodeClock(ClockOf("a", 21), rules)).reason,
            v1::REJECTED_CLOCK_BEYOND_GRANT);
  EXPECT_EQ(std::get<Instant>(DecodeClock(ClockOf("a", 10), rules)).nanoseconds(), 10);
  EXPECT_EQ(std::get<Instant>(DecodeClock(ClockOf("a", 20), rules)).nanoseconds(), 20);
}

TEST(Codec, ChecksChunks) {
  v1::AgentStates chunk = Chunk("a");
  for (std::uint32_t i = 0; i < 128; ++i) *chunk.add_states() = State(i / 2, 0, i + 1);
  EXPECT_FALSE(CheckChunk(chunk));
  *chunk.add_states() = State(64, 0, 129);
  EXPECT_EQ(CheckChunk(chunk)->reason, v1::REJECTED_CHUNK_TOO_LARGE);
  EXPECT_EQ(CheckSlot(chunk, State(wire::kSlotMax + 1, 0, 1))->reason, v1::REJECTED_OUT_OF_RANGE);
}

}  // namespace
}  // namespace collision::server
