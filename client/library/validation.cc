#include "client/library/validation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

#include "collision/shape.h"
#include "collision_core/shape/fixed_half_space.h"
#include "idl/control_character.h"

namespace collision::client {
namespace {

std::string Text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

[[noreturn]] void Refuse(const std::string& field, const std::string& value,
                         const std::string& range) {
  throw std::invalid_argument(field + ": " + value + ", allowed: " + range);
}

/// Written so that what is not a number fails, too.
bool IsWithin(double value, double least, double greatest) {
  return value >= least && value <= greatest;
}

// Every state that is set comes through here: texts are made for what is refused only.
void CheckNumber(const char* field, double value, double least, double greatest) {
  if (IsWithin(value, least, greatest)) return;
  Refuse(field, Text(value), Text(least) + " to " + Text(greatest));
}

/// What is not declared is not checked.
void CheckDeclared(const char* field, const std::optional<double>& value, double least,
                   double greatest) {
  if (value) CheckNumber(field, *value, least, greatest);
}

void RequireNumber(const char* field, const std::optional<double>& value, double greatest,
                   const char* why) {
  if (!value) Refuse(field, "not given", "0 to " + Text(greatest) + why);
  CheckNumber(field, *value, 0, greatest);
}

void CheckVector(const char* field, const Vector3& vector, double greatest) {
  constexpr const char* kAxes[] = {".x", ".y", ".z"};
  for (int i = 0; i < 3; ++i) {
    if (IsWithin(vector[i], -greatest, greatest)) continue;
    CheckNumber((std::string(field) + kAxes[i]).c_str(), vector[i], -greatest, greatest);
  }
}

/// Components are checked first, so that squares neither overflow nor vanish.
void CheckUnit(const char* field, std::span<const double> values, const char* range) {
  double squares = 0;
  for (const double value : values) {
    CheckNumber(field, value, -2, 2);
    squares += value * value;
  }
  const double length = std::sqrt(squares);
  if (std::abs(length - 1) > kUnitTolerance) Refuse(field, "length " + Text(length), range);
}

void CheckInstant(const char* field, std::int64_t instant_ns) {
  if (instant_ns >= -kInstantMax && instant_ns <= kInstantMax) return;
  Refuse(field, std::to_string(instant_ns),
         std::to_string(-kInstantMax) + " to " + std::to_string(kInstantMax));
}

void CheckLater(const char* field, std::int64_t instant_ns) {
  if (instant_ns != kNever) CheckInstant(field, instant_ns);
}

/// The ball of an agent must hold its shape. The numbers are close to each other: all digits show.
void CheckHolds(double radius, const Shape& shape) {
  if (shape.radius_m() <= radius * (1 + kShapeRadiusTolerance)) return;
  char text[96];
  std::snprintf(text, sizeof text, ">= %.17g, the radius of its shape (shape->radius_m())",
                shape.radius_m());
  char value[32];
  std::snprintf(value, sizeof value, "%.17g", radius);
  Refuse("radius_m", value, text);
}

void CheckText(const char* field, const std::string& text, std::size_t least, std::size_t most) {
  if (text.size() < least || text.size() > most) {
    Refuse(field, "\"" + text + "\"",
           std::to_string(least) + " to " + std::to_string(most) + " bytes");
  }
  if (wire::FindControl(text)) Refuse(field, "a control character", "printable characters");
}

void CheckTags(const std::vector<Tag>& tags) {
  if (tags.size() > wire::kTagsMax) {
    Refuse("tags", std::to_string(tags.size()), "0 to " + std::to_string(wire::kTagsMax));
  }
  for (auto tag = tags.begin(); tag != tags.end(); ++tag) {
    CheckText("tags.key", tag->key, 1, wire::kTagKeyMax);
    CheckText("tags.value", tag->value, 0, wire::kTagValueMax);
    const auto same = [&tag](const Tag& other) { return other.key == tag->key; };
    if (std::any_of(tags.begin(), tag, same)) Refuse("tags.key", "\"" + tag->key + "\"", "once");
  }
}

void CheckPartners(const char* field, const std::vector<std::string>& names,
                   const std::string& own_name) {
  if (names.size() > static_cast<std::size_t>(wire::kPartnersListedMax)) {
    Refuse(field, std::to_string(names.size()) + " names",
           "at most " + std::to_string(wire::kPartnersListedMax));
  }
  for (const std::string& name : names) {
    CheckText(field, name, 1, kNameMax);
    if (name == own_name) {
      Refuse(field, "\"" + name + "\"", "names of other agents of this simulator");
    }
  }
}

void CheckPartners(const AgentDescription& description) {
  if (!description.class_name.empty() && !wire::IsName(description.class_name)) {
    Refuse("class_name", "\"" + description.class_name + "\"", "A-Z a-z 0-9 _ -");
  }
  CheckText("class_name", description.class_name, 0, wire::kClassNameMax);
  CheckPartners("meets_in_assembly", description.meets_in_assembly, description.name);
  CheckPartners("never_meets", description.never_meets, description.name);
  for (const std::string& name : description.never_meets) {
    if (std::ranges::count(description.meets_in_assembly, name) == 0) continue;
    Refuse("never_meets", "\"" + name + "\", which meets_in_assembly names too",
           "in one of the two");
  }
}

void RequireIdentifier(const char* field, const std::string& name) {
  if (wire::IsName(name)) return;
  throw std::runtime_error(std::string(field) + ": \"" + name + "\", allowed: " + wire::kNameText);
}

void CheckHalfSpace(const AgentDescription& description) {
  const HalfSpace& half_space = *description.half_space;
  const auto [x, y, z] = half_space.normal;
  if (const auto refusal = shape::RefusalOfHalfSpace({x, y, z}, half_space.offset_m)) {
    throw std::invalid_argument(*refusal);
  }
  const auto none = [](const char* field, double told) {
    if (told != 0) Refuse(field, Text(told), "0, or left out, of a half-space");
  };
  none("radius_m", description.radius_m.value_or(0));
  none("acceleration_max_m_s2", description.acceleration_max_m_s2.value_or(0));
  none("jerk_max_m_s3", description.jerk_max_m_s3);
  if (description.shape) Refuse("shape", "beside half_space", "one of the two");
  if (description.hypothetical) Refuse("hypothetical", "of a half-space", "of what can move");
}

void CheckMotion(const AgentDescription& description) {
  if (description.radius_m || !description.shape) {
    RequireNumber("radius_m", description.radius_m, kRadiusMax,
                  "; beside a shape it may be left out");
  }
  RequireNumber("acceleration_max_m_s2", description.acceleration_max_m_s2, kAccelerationMax,
                "; 0 promises that its velocity never changes");
}

}  // namespace

void Validate(const AgentDescription& description) {
  CheckText("name", description.name, 1, kNameMax);
  CheckText("assembly", description.assembly, 0, kNameMax);
  CheckTags(description.tags);
  if (description.half_space) {
    CheckHalfSpace(description);
  } else {
    CheckMotion(description);
  }
  CheckNumber("margin_m", description.margin_m, 0, kRadiusMax);
  if (description.margin_m > 0 && description.margin_m < wire::kMarginMin) {
    Refuse("margin_m", Text(description.margin_m),
           "0, or " + Text(wire::kMarginMin) + " to " + Text(kRadiusMax));
  }
  CheckNumber("jerk_max_m_s3", description.jerk_max_m_s3, 0, wire::kJerkMax);
  CheckDeclared("angular_acceleration_max_rad_s2", description.angular_acceleration_max_rad_s2, 0,
                kAccelerationMax);
  // On the wire 0 stands for a speed that is not declared.
  CheckDeclared("speed_max_m_s", description.speed_max_m_s,
                std::numeric_limits<double>::denorm_min(), kSpeedMax);
  CheckDeclared("time_step_s", description.time_step_s, 0, kTimeStepMax);
  CheckPartners(description);
  if (description.radius_m && description.shape) {
    CheckHolds(*description.radius_m, *description.shape);
  }
}

void Validate(const State& state) {
  CheckInstant("stamp_ns", state.stamp_ns);
  CheckVector("position_m", state.position_m, kCoordinateMax);
  CheckVector("velocity_m_s", state.velocity_m_s, kSpeedMax);
  CheckVector("acceleration_m_s2", state.acceleration_m_s2, kAccelerationMax);
  CheckUnit("orientation", state.orientation, "length 1 within 0.001");
  CheckVector("angular_velocity_rad_s", state.angular_velocity_rad_s, kAngularSpeedMax);
  CheckNumber("position_error_m", state.position_error_m, 0, kRadiusMax);
  CheckNumber("velocity_error_m_s", state.velocity_error_m_s, 0, kSpeedMax);
  CheckNumber("rotation_error_rad", state.rotation_error_rad, 0, kRotationErrorMax);
  if (state.thrust_direction) {
    CheckUnit("thrust_direction", *state.thrust_direction, "length 1 within 0.001");
  }
  CheckLater("direction_until_ns", state.direction_until_ns);
  if (state.expiry_ns) CheckInstant("expiry_ns", *state.expiry_ns);
}

void ValidateClock(std::int64_t clock_ns) { CheckInstant("clock_ns", clock_ns); }

void Validate(const WorldOptions& options) {
  ValidateWorld(options.world, options.domain);
  RequireIdentifier("simulator", options.simulator);
  if (options.frame.size() > wire::kLabelMax) {
    throw std::runtime_error("frame: " + std::to_string(options.frame.size()) +
                             " bytes, allowed: 0 to " + std::to_string(wire::kLabelMax));
  }
  if (options.chunk_size > kChunkSizeMax) {
    throw std::runtime_error("chunk_size: " + std::to_string(options.chunk_size) +
                             ", allowed: 1 to " + std::to_string(kChunkSizeMax) + ", or 0");
  }
  if (options.lead >= std::chrono::nanoseconds(0) && options.lead <= kLeadMax) return;
  throw std::runtime_error("lead: " + std::to_string(options.lead.count()) +
                           " ns, allowed: 0 to 1 h");
}

void ValidateWorld(const std::string& world, std::uint32_t domain) {
  RequireIdentifier("world", world);
  if (domain <= kDomainMax) return;
  throw std::runtime_error("domain: " + std::to_string(domain) + ", allowed: 0 to " +
                           std::to_string(kDomainMax));
}

}  // namespace collision::client
