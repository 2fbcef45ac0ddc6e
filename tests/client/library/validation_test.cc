// Goal:   what the service would refuse never leaves the simulator, and the message says which
//         field, which value and what is allowed; what the service takes passes.
// Method: every field at its limits, beyond them, and not a number.
#include "client/library/validation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "idl/limits.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename Value>
std::string Complaint(const Value& value) {
  try {
    Validate(value);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// Refuses NaN, infinities and values just outside [least, greatest], naming the field; accepts the
/// limits.
template <typename Value>
void CheckLimits(const Value& good, const std::string& field, double least, double greatest,
                 const std::function<void(Value*, double)>& set) {
  for (const double number : {least, greatest}) {
    Value value = good;
    set(&value, number);
    EXPECT_EQ(Complaint(value), "") << field;
  }
  for (const double number : {kNaN, kInfinity, -kInfinity, std::nextafter(least, -kInfinity),
                              std::nextafter(greatest, kInfinity)}) {
    Value value = good;
    set(&value, number);
    EXPECT_EQ(Complaint(value).rfind(field + ": ", 0), 0u) << field << " " << Complaint(value);
  }
}

TEST(Validation, AssemblyAndTagsAreShortAndKeysDiffer) {
  AgentDescription good = Point();
  good.assembly = std::string(kNameMax, 'x');
  good.tags.push_back({std::string(wire::kTagKeyMax, 'k'), std::string(64, 'v')});
  EXPECT_EQ(Complaint(good), "");
  const auto complaint = [&good](const std::function<void(AgentDescription*)>& spoil) {
    AgentDescription bad = good;
    spoil(&bad);
    return Complaint(bad).substr(0, Complaint(bad).find(':'));
  };
  using D = AgentDescription;
  EXPECT_EQ(complaint([](D* d) { d->assembly += 'x'; }), "assembly");
  EXPECT_EQ(complaint([](D* d) { d->assembly = "a\nb"; }), "assembly");
  EXPECT_EQ(complaint([](D* d) { d->tags[0].key += 'k'; }), "tags.key");
  EXPECT_EQ(complaint([](D* d) { d->tags[0].key.clear(); }), "tags.key");
  EXPECT_EQ(complaint([](D* d) { d->tags[0].value += 'v'; }), "tags.value");
  EXPECT_EQ(complaint([](D* d) { d->tags.push_back(d->tags[0]); }), "tags.key");
  EXPECT_EQ(complaint([](D* d) {
              for (int i = 0; i < wire::kTagsMax; ++i) d->tags.push_back({std::to_string(i), ""});
            }),
            "tags");
}

TEST(Validation, DescriptionsAreLimited) {
  using D = AgentDescription;
  const D good = Point();
  CheckLimits<D>(good, "radius_m", 0, kRadiusMax, [](D* d, double x) { d->radius_m = x; });
  CheckLimits<D>(good, "acceleration_max_m_s2", 0, kAccelerationMax,
                 [](D* d, double x) { d->acceleration_max_m_s2 = x; });
  CheckLimits<D>(good, "angular_acceleration_max_rad_s2", 0, kAccelerationMax,
                 [](D* d, double x) { d->angular_acceleration_max_rad_s2 = x; });
  CheckLimits<D>(good, "speed_max_m_s", std::numeric_limits<double>::denorm_min(), kSpeedMax,
                 [](D* d, double x) { d->speed_max_m_s = x; });
  CheckLimits<D>(good, "time_step_s", 0, kTimeStepMax, [](D* d, double x) { d->time_step_s = x; });
}

TEST(Validation, MarginsAreNoneOrNotTooSmall) {
  const auto complaint = [](double margin) {
    AgentDescription description = Point();
    description.margin_m = margin;
    return Complaint(description);
  };
  for (const double margin : {0.0, 1e-6, kRadiusMax}) EXPECT_EQ(complaint(margin), "") << margin;
  EXPECT_EQ(complaint(1e-7), "margin_m: 1e-07, allowed: 0, or 1e-06 to 1e+12");
  for (const double margin : {-1e-6, kNaN, kInfinity}) {
    EXPECT_EQ(complaint(margin).rfind("margin_m: ", 0), 0u) << margin;
  }
}

TEST(Validation, PartnersAreLimited) {
  const auto complaint = [](const std::function<void(AgentDescription*)>& set) {
    AgentDescription description = Point();
    description.name = "link";
    set(&description);
    return Complaint(description);
  };
  using D = AgentDescription;
  EXPECT_EQ(complaint([](D* d) { d->class_name = std::string(33, 'a'); }).rfind("class_name: ", 0),
            0u);
  EXPECT_EQ(complaint([](D* d) { d->class_name = "a b"; }),
            "class_name: \"a b\", allowed: A-Z a-z 0-9 _ -");
  EXPECT_EQ(complaint([](D* d) { d->assembly = std::string(65, 'a'); }).rfind("assembly: ", 0), 0u);
  EXPECT_EQ(complaint([](D* d) { d->assembly = "a\n"; }),
            "assembly: a control character, allowed: printable characters");
  const std::string others = ", allowed: names of other agents of this simulator";
  EXPECT_EQ(complaint([](D* d) { d->meets_in_assembly = {"link"}; }),
            "meets_in_assembly: \"link\"" + others);
  EXPECT_EQ(complaint([](D* d) { d->never_meets = {""}; }),
            "never_meets: \"\", allowed: 1 to 64 bytes");
  EXPECT_EQ(complaint([](D* d) { d->never_meets.assign(17, "a"); }),
            "never_meets: 17 names, allowed: at most 16");
  EXPECT_EQ(complaint([](D* d) { d->never_meets = d->meets_in_assembly = {"a"}; }),
            "never_meets: \"a\", which meets_in_assembly names too, allowed: in one of the two");
  EXPECT_EQ(complaint([](D* d) {
              d->class_name = std::string(32, 'a');
              d->assembly = std::string(64, 'b');
              d->meets_in_assembly.assign(16, "c");
              d->never_meets.assign(16, std::string(64, 'd'));
            }),
            "");
}

TEST(Validation, StatesAreLimited) {
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    CheckLimits<State>({}, "position_m." + axis, -kCoordinateMax, kCoordinateMax,
                       [i](State* s, double x) { s->position_m[i] = x; });
    CheckLimits<State>({}, "velocity_m_s." + axis, -kSpeedMax, kSpeedMax,
                       [i](State* s, double x) { s->velocity_m_s[i] = x; });
    CheckLimits<State>({}, "angular_velocity_rad_s." + axis, -kAngularSpeedMax, kAngularSpeedMax,
                       [i](State* s, double x) { s->angular_velocity_rad_s[i] = x; });
  }
  CheckLimits<State>({}, "position_error_m", 0, kRadiusMax,
                     [](State* s, double x) { s->position_error_m = x; });
  CheckLimits<State>({}, "velocity_error_m_s", 0, kSpeedMax,
                     [](State* s, double x) { s->velocity_error_m_s = x; });
  CheckLimits<State>({}, "rotation_error_rad", 0, kRotationErrorMax,
                     [](State* s, double x) { s->rotation_error_rad = x; });
}

TEST(Validation, QuaternionsAndDirectionsAreUnit) {
  EXPECT_EQ(Complaint(State{.orientation = {0.6, 0, 0.8, 0}}), "");
  EXPECT_EQ(Complaint(State{.orientation = {1.0009, 0, 0, 0}}), "");
  EXPECT_EQ(Complaint(State{.orientation = {0, 0, 0, 0}}),
            "orientation: length 0, allowed: length 1 within 0.001");
  EXPECT_NE(Complaint(State{.orientation = {1.0011, 0, 0, 0}}), "");
  EXPECT_NE(Complaint(State{.orientation = {0.9989, 0, 0, 0}}), "");
  EXPECT_NE(Complaint(State{.orientation = {1, kNaN, 0, 0}}), "");
  EXPECT_EQ(Complaint(State{.thrust_direction = {{0, -0.6, 0.8}}}), "");
  EXPECT_NE(Complaint(State{.thrust_direction = {{0, 0, 0}}}), "");
  EXPECT_NE(Complaint(State{.thrust_direction = {{0, 0, 1e-9}}}), "");
  EXPECT_NE(Complaint(State{.thrust_direction = {{0, kNaN, 0}}}), "");
}

TEST(Validation, InstantsAreBounded) {
  EXPECT_EQ(Complaint(State{.stamp_ns = kInstantMax, .direction_until_ns = -kInstantMax}), "");
  EXPECT_NE(Complaint(State{.stamp_ns = kNever}), "");
  EXPECT_NE(Complaint(State{.expiry_ns = kNever - 1}), "");
  EXPECT_NE(Complaint(State{.direction_until_ns = -kInstantMax - 1}), "");
}

TEST(Validation, NamesHaveALength) {
  EXPECT_EQ(Complaint(Point(std::string(64, 'x'))), "");
  for (const std::string& name : {std::string(65, 'x'), std::string(), std::string("two\nlines")}) {
    EXPECT_EQ(Complaint(Point(name)).rfind("name: ", 0), 0u) << Complaint(Point(name));
  }
}

TEST(Validation, WhatIsRequiredMustBeGiven) {
  EXPECT_EQ(Complaint(AgentDescription{.name = "ball", .radius_m = 1}),
            "acceleration_max_m_s2: not given, allowed: 0 to 1e+18; 0 promises that its velocity "
            "never changes");
  EXPECT_EQ(Complaint(AgentDescription{.name = "ball", .acceleration_max_m_s2 = 1}),
            "radius_m: not given, allowed: 0 to 1e+12; beside a shape it may be left out");
}

TEST(Validation, TheMessageNamesFieldValueAndRange) {
  EXPECT_EQ(Complaint(AgentDescription{.name = "ball", .radius_m = -0.5}),
            "radius_m: -0.5, allowed: 0 to 1e+12");
}

// The other limits are the same constants as the service's; these two count in another way.
TEST(Validation, LimitsAreThoseOfTheWire) {
  EXPECT_EQ(kAgentsMax, wire::kSlotMax + 1);
  EXPECT_EQ(kChunkSizeMax, static_cast<std::uint32_t>(wire::kStatesPerChunkMax));
}

TEST(Validation, ARefusedValueChangesNothing) {
  const auto network = std::make_shared<FakeNetwork>();
  World world = ConnectTo(network);
  EXPECT_THROW(world.AddAgent({.name = "ball", .radius_m = kNaN}, {}), std::invalid_argument);
  EXPECT_THROW(world.AddAgent(Point(), {.expiry_ns = kNever - 1}), std::invalid_argument);
  EXPECT_TRUE(network->written.empty());
  Agent ball = world.AddAgent(Point(), {.stamp_ns = 5});
  EXPECT_EQ(ball.id().slot, 0u);
  world.Publish(5);
  network->written.clear();
  EXPECT_THROW(ball.SetState({.stamp_ns = 4}), std::invalid_argument);
  EXPECT_THROW(ball.SetState({.stamp_ns = 6, .position_m = {kInfinity, 0, 0}}),
               std::invalid_argument);
  AgentDescription changed = Point();
  changed.time_step_s = -1;
  EXPECT_THROW(ball.SetDescription(changed), std::invalid_argument);
  world.Publish(5);
  EXPECT_TRUE(network->written.empty());
}

}  // namespace
}  // namespace collision::client
