#include "client/programs/shared/solid_file.h"

#include <utility>

#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/proto_text.h"

namespace collision::client {
namespace {

Vector3 VectorOf(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

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
  if (message.solids().empty())
    throw BadInput(path + ": solids: there are 0; at least 1 is needed");
  std::vector<Solid> solids;
  for (const v1::ConvexSolid& solid : message.solids()) {
    if (solid.core_case() == v1::ConvexSolid::CORE_NOT_SET) {
      throw BadInput(path + ": solids[" + std::to_string(solids.size()) +
                     "]: core is missing; allowed are ball, capsule, box, ellipsoid, "
                     "cylinder, cone and hull");
    }
    solids.push_back(SolidOf(solid));
  }
  return solids;
}

}  // namespace collision::client
