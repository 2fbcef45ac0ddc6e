#include "client/programs/shared/solid_file.h"

#include <google/protobuf/descriptor.h>

#include <cstdio>
#include <utility>

#include "client/library/shape/solid_check.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/proto_text.h"

namespace collision::client {
namespace {

Vector3 VectorOf(const auto& v) { return {v.x(), v.y(), v.z()}; }

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

[[noreturn]] void Refuse(const std::string& field, const std::string& value) {
  char greatest[32];
  std::snprintf(greatest, sizeof greatest, "%g", kSolidLengthMax);
  throw BadInput(field + ": " + value + ", allowed: 0 to " + greatest + " m");
}

/// Throws BadInput for a length that is missing or out of range; `prefix` stands before its name.
void RequireLength(const Message& message, const FieldDescriptor& field,
                   const std::string& prefix) {
  const std::string name = prefix + std::string(field.name());
  if (!message.GetReflection()->HasField(message, &field)) Refuse(name, "missing");
  const double value = message.GetReflection()->GetDouble(message, &field);
  if (value >= 0 && value <= kSolidLengthMax) return;
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  Refuse(name, text);
}

/// Throws BadInput for the first length of a core that is missing or out of range. The library
/// would name its own fields.
void RequireLengths(const Message& core, const std::string& prefix) {
  const auto& type = *core.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (field.is_repeated()) continue;  // Points of a hull.
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      RequireLengths(core.GetReflection()->GetMessage(core, &field),
                     prefix + std::string(field.name()) + ".");
    } else {
      RequireLength(core, field, prefix);
    }
  }
}

void RequireSolid(const v1::ConvexSolid& solid, const std::string& place) {
  if (solid.core_case() == v1::ConvexSolid::CORE_NOT_SET) {
    throw BadInput(place +
                   ": core: missing, allowed: ball, capsule, box, ellipsoid, cylinder, cone or "
                   "hull");
  }
  const FieldDescriptor& core =
      *solid.GetDescriptor()->FindFieldByNumber(static_cast<int>(solid.core_case()));
  const std::string prefix = place + " (" + std::string(core.name()) + "): ";
  RequireLengths(solid.GetReflection()->GetMessage(solid, &core), prefix);
  if (!(solid.rounding_m() >= 0)) Refuse(prefix + "rounding_m", std::to_string(solid.rounding_m()));
}

/// In the solid's own frame.
Solid CoreOf(const v1::ConvexSolid& message) {
  switch (message.core_case()) {
    case v1::ConvexSolid::kBall:
      return Solid::Ball(message.ball().radius_m());
    case v1::ConvexSolid::kCapsule:
      return Solid::Capsule(message.capsule().radius_m(), message.capsule().half_length_m());
    case v1::ConvexSolid::kBox:
      return Solid::Box(VectorOf(message.box().half_extents_m()));
    case v1::ConvexSolid::kEllipsoid:
      return Solid::Ellipsoid(VectorOf(message.ellipsoid().half_axes_m()));
    case v1::ConvexSolid::kCylinder:
      return Solid::Cylinder(message.cylinder().radius_m(), message.cylinder().half_length_m());
    case v1::ConvexSolid::kCone:
      return Solid::Cone(message.cone().radius_m(), message.cone().half_length_m());
    case v1::ConvexSolid::kHull: {
      std::vector<Vector3> points;
      for (const v1::Vector3& point : message.hull().points_m()) points.push_back(VectorOf(point));
      return Solid::Hull(std::move(points));
    }
    case v1::ConvexSolid::CORE_NOT_SET:
      break;
  }
  return {};
}

}  // namespace

Solid SolidOf(const v1::ConvexSolid& message) {
  const Solid core = CoreOf(message);
  const v1::Quaternion& q = message.orientation();
  Quaternion turned{1, 0, 0, 0};
  if (message.has_orientation()) turned = {q.w(), q.x(), q.y(), q.z()};
  return core.Rounded(message.rounding_m()).At(VectorOf(message.position_m()), turned);
}

std::vector<Solid> ReadSolids(const std::string& path) {
  v1::SolidFile message;
  try {
    ReadProtoText(path, &message);
  } catch (const std::runtime_error& error) {
    throw BadInput(error.what());
  }
  if (message.solids().empty()) throw BadInput(path + ": solids: 0, allowed: 1 or more");
  std::vector<Solid> solids;
  for (const v1::ConvexSolid& solid : message.solids()) {
    RequireSolid(solid, path + ": solids[" + std::to_string(solids.size()) + "]");
    solids.push_back(SolidOf(solid));
  }
  return solids;
}

}  // namespace collision::client
