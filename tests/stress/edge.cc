// What lies beyond the limits is refused at the edge, with the field's name; what lies within
// passes.
#include <cmath>
#include <limits>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/shape/convex_solid.h"
#include "idl/limits.h"
#include "server/codec/codec.h"
#include "tests/server/messages.h"
#include "tests/stress/case.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace collision::stress {
namespace {

using server::Chunk;
using server::Description;
using server::State;

using SetNumber = void (*)(v1::AgentDescription*, v1::AgentState*, double);

struct NumberField {
  const char* name;
  double least, greatest;
  bool of_description;
  SetNumber set;
};

const NumberField kFields[] = {
    {"radius_m", 0, wire::kRadiusMax, true, [](auto* d, auto*, double x) { d->set_radius_m(x); }},
    {"acceleration_max_m_s2", 0, wire::kAccelerationMax, true,
     [](auto* d, auto*, double x) { d->set_acceleration_max_m_s2(x); }},
    {"speed_max_m_s", 0, wire::kSpeedMax, true,
     [](auto* d, auto*, double x) { d->set_speed_max_m_s(x); }},
    {"time_step_s", 0, wire::kTimeStepMax, true,
     [](auto* d, auto*, double x) { d->set_time_step_s(x); }},
    {"position_m", -wire::kCoordinateMax, wire::kCoordinateMax, false,
     [](auto*, auto* s, double x) { s->mutable_position_m()->set_y(x); }},
    {"velocity_m_s", -wire::kSpeedMax, wire::kSpeedMax, false,
     [](auto*, auto* s, double x) { s->mutable_velocity_m_s()->set_z(x); }},
    {"angular_velocity_rad_s", -wire::kAngularSpeedMax, wire::kAngularSpeedMax, false,
     [](auto*, auto* s, double x) { s->mutable_angular_velocity_rad_s()->set_x(x); }},
    {"position_error_m", 0, wire::kRadiusMax, false,
     [](auto*, auto* s, double x) { s->set_position_error_m(x); }},
    {"velocity_error_m_s", 0, wire::kSpeedMax, false,
     [](auto*, auto* s, double x) { s->set_velocity_error_m_s(x); }},
    {"rotation_error_rad", 0, wire::kRotationErrorMax, false,
     [](auto*, auto* s, double x) { s->set_rotation_error_rad(x); }}};

std::optional<server::Refusal> RefusalOf(const v1::AgentDescription& description,
                                         const v1::AgentState& state) {
  const auto agent = server::DecodeDescription(description);
  if (const auto* refusal = std::get_if<server::Refusal>(&agent)) return *refusal;
  const auto decoded = server::DecodeState(Chunk("alpha"), state, {});
  if (const auto* refusal = std::get_if<server::Refusal>(&decoded)) return *refusal;
  return std::nullopt;
}

std::optional<server::Refusal> RefusalWith(const NumberField& field, double value) {
  v1::AgentDescription description = Description("alpha", 0);
  v1::AgentState state = State(0, 0, 1);
  field.set(&description, &state, value);
  return RefusalOf(description, state);
}

void Numbers(Outcome* outcome) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const NumberField& field : kFields) {
    for (const double within : {field.least, field.greatest, 0.0, 0x1p-1074, 1e-300}) {
      outcome->Expect(!RefusalWith(field, within),
                      std::string(field.name) + " " + Show(within) + " is refused");
      outcome->Add("accepted", 1);
    }
    for (const double beyond :
         {std::nextafter(field.least, -kInf), std::nextafter(field.greatest, kInf), -kInf, kInf,
          std::numeric_limits<double>::quiet_NaN()}) {
      const auto refusal = RefusalWith(field, beyond);
      outcome->Expect(refusal && refusal->field.starts_with(field.name) && !refusal->detail.empty(),
                      std::string(field.name) + " " + Show(beyond) + " is not refused by name");
      outcome->Add("refused", 1);
    }
  }
}

void Stamps(Outcome* outcome) {
  for (const std::int64_t stamp : {-wire::kInstantMax, wire::kInstantMax}) {
    outcome->Expect(!RefusalOf(Description("alpha", 0), State(0, stamp, 1)),
                    "a stamp of 146 years is refused");
    const std::int64_t beyond = stamp + (stamp < 0 ? -1 : 1);
    outcome->Expect(RefusalOf(Description("alpha", 0), State(0, beyond, 1)).has_value(),
                    "a stamp beyond is not refused");
    outcome->Add("refused", 1);
  }
}

void Meshes(Outcome* outcome) {
  for (const double size : {1e-12, 1e-9, 1e-6, 1.0, 1e6, 1e9, 1e12}) {
    const geometry::TriangleMesh mesh = Cube(size / 2);
    const double diagonal = size * std::sqrt(3);
    const bool allowed = diagonal >= geometry::kMeshSizeMin && diagonal <= geometry::kMeshSizeMax;
    outcome->Expect(allowed != geometry::RefusalOf(mesh, 100).has_value(),
                    "a mesh of " + Show(size) + " m");
    shape::ConvexDescription box;
    box.core = geometry::ConvexCore::kBox;
    box.half = Eigen::Vector3d::Constant(size / 2);
    const bool box_allowed = diagonal >= shape::kConvexSizeMin && diagonal <= shape::kConvexSizeMax;
    outcome->Expect(box_allowed != shape::RefusalOf(box).has_value(),
                    "a box of " + Show(size) + " m");
    outcome->Add(allowed ? "accepted" : "refused", 2);
  }
}

void Limits(const Setting&, Outcome* outcome) {
  Numbers(outcome);
  Stamps(outcome);
  Meshes(outcome);
  outcome->Say(Show(outcome->Get("accepted")) + " at the limits accepted, " +
               Show(outcome->Get("refused")) + " beyond refused with the field's name");
}

/// The angle between two rotations, in long double: 2 asin |vector part of p⁻¹ q|.
long double AngleBetween(const Eigen::Quaternion<long double>& p,
                         const Eigen::Quaternion<long double>& q) {
  const auto between = p.conjugate() * q;
  return 2 * std::atan2(between.vec().norm(), std::fabs(between.w()));
}

// A quaternion that is nearly of unit length: the one that is taken differs from any that was meant
// by no more than the rotation error that is added.
void HairOffUnit(const Setting& setting, Outcome* outcome) {
  Random random(401);
  double widest = 0;
  for (int i = 0; i < setting.Many(20'000, 1'000'000); ++i) {
    const Eigen::Vector3d axis = random.UnitVector();
    const long double half = random.Uniform(-3.2, 3.2);
    const Eigen::Vector3d turned = axis;
    Eigen::Quaternion<long double> meant(std::cos(half), 0, 0, 0);
    meant.vec() = std::sin(half) * turned.cast<long double>().normalized();
    const double off = random.LogUniform(1e-17, wire::kUnitTolerance * 0.999);
    Eigen::Vector4d noise;
    for (int k = 0; k < 4; ++k) noise[k] = random.Uniform(-1, 1);
    noise *= off / noise.norm();
    v1::AgentState state = State(0, 0, 1);
    auto* wire = state.mutable_orientation();
    wire->set_w(static_cast<double>(meant.w()) * (1 + off));
    wire->set_x(static_cast<double>(meant.x()) * (1 + off));
    wire->set_y(static_cast<double>(meant.y()) * (1 + off));
    wire->set_z(static_cast<double>(meant.z()) * (1 + off));
    const bool scaled = random.Chance(0.5);
    if (!scaled) {
      wire->set_w(static_cast<double>(meant.w()) + noise[0]);
      wire->set_x(static_cast<double>(meant.x()) + noise[1]);
      wire->set_y(static_cast<double>(meant.y()) + noise[2]);
      wire->set_z(static_cast<double>(meant.z()) + noise[3]);
    }
    const auto decoded = server::DecodeState(Chunk("alpha"), state, {});
    const auto* taken = std::get_if<motion::MotionState>(&decoded);
    if (!outcome->Expect(taken != nullptr, "a hair off unit is refused")) continue;
    const double length = taken->q_WB.norm();
    outcome->Expect(std::abs(length - 1) <= 0x1p-50, "not of unit length");
    const double error = taken->rotation_error;
    outcome->Expect(error >= 0 && error <= 2.1 * off + 1e-15, "a wide rotation error");
    if (!scaled) continue;
    const long double angle = AngleBetween(meant, taken->q_WB.cast<long double>());
    widest = std::max(widest, static_cast<double>(angle));
    outcome->Expect(angle <= error + 8 * 0x1p-52L, "turned by more than the error says");
  }
  outcome->Set("turned_by_at_most_rad", widest);
  outcome->Say("lengths off by 1e-17 to 1e-3: the same rotation within " + Show(widest) +
               " rad, rotation error 2.1 times what the length is off at most");
}

}  // namespace

std::vector<Case> EdgeCases() {
  return {
      {"extreme", "limits",
       "what lies within the limits passes, what lies a unit in the last place beyond, infinite "
       "or not a number is refused at the edge, with the field's name",
       Limits},
      {"extreme", "quaternions",
       "a quaternion off unit length by up to 1e-3 is normalised; the rotation error grows by "
       "2.1 times that at most, and covers how far the rotation moved",
       HairOffUnit}};
}

}  // namespace collision::stress
