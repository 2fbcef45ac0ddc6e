#include "client/programs/foxglove/channels/body.h"

#include <cmath>

#include "client/programs/foxglove/channels/solid_surface.h"

namespace collision::client {
namespace {

using Point = std::array<double, 3>;

constexpr double kPlateThickness = 0.01;

template <class Message>
void Set(const Point& p, Message* to) {
  to->set_x(p[0]);
  to->set_y(p[1]);
  to->set_z(p[2]);
}

/// `q`: w, x, y, z.
void SetPose(const Point& position, const std::array<double, 4>& q, foxglove::Pose* pose) {
  Set(position, pose->mutable_position());
  Set({q[1], q[2], q[3]}, pose->mutable_orientation());
  pose->mutable_orientation()->set_w(q[0]);
}

/// `p` of the solid's frame in the body frame.
Point Placed(const SolidContent& solid, const Point& p) {
  const auto& [w, x, y, z] = solid.orientation;
  // p + 2 w (u × p) + 2 u × (u × p), with u = (x, y, z).
  const Point a{y * p[2] - z * p[1], z * p[0] - x * p[2], x * p[1] - y * p[0]};
  const Point b{y * a[2] - z * a[1], z * a[0] - x * a[2], x * a[1] - y * a[0]};
  Point placed = solid.position;
  for (std::size_t i = 0; i < 3; ++i) placed[i] += p[i] + 2 * (w * a[i] + b[i]);
  return placed;
}

/// Size and color too, which most of Foxglove's forms have.
template <class Form>
void SetForm(const SolidContent& solid, const Point& size, const foxglove::Color& color,
             Form* form) {
  SetPose(solid.position, solid.orientation, form->mutable_pose());
  Set(size, form->mutable_size());
  *form->mutable_color() = color;
}

void AddTriangles(const ShapeContent& shape, const foxglove::Color& color,
                  foxglove::SceneEntity* entity) {
  foxglove::TriangleListPrimitive* list = entity->add_triangles();
  SetPose({}, {1, 0, 0, 0}, list->mutable_pose());
  *list->mutable_color() = color;
  for (const Point& p : shape.vertices) Set(p, list->add_points());
  for (const auto& triangle : shape.triangles) {
    for (const std::uint32_t i : triangle) list->add_indices(i);
  }
}

void AddCylinder(const SolidContent& solid, double top_scale, const foxglove::Color& color,
                 foxglove::SceneEntity* entity) {
  const double r = solid.kind == SolidKind::kCapsule ? solid.rounding : solid.half_extents[0];
  foxglove::CylinderPrimitive* form = entity->add_cylinders();
  SetForm(solid, {2 * r, 2 * r, 2 * solid.half_extents[2]}, color, form);
  form->set_bottom_scale(1);
  form->set_top_scale(top_scale);
}

/// Returns whether Foxglove has such a form.
bool AddForm(const SolidContent& solid, const foxglove::Color& color,
             foxglove::SceneEntity* entity) {
  const Point& h = solid.half_extents;
  const Point size{2 * h[0], 2 * h[1], 2 * h[2]};
  if (solid.kind == SolidKind::kBall) {
    AddBall(solid.position, solid.rounding, color, entity);
    return true;
  }
  if (solid.kind == SolidKind::kCapsule) {
    AddCylinder(solid, 1, color, entity);
    AddBall(Placed(solid, {0, 0, h[2]}), solid.rounding, color, entity);
    AddBall(Placed(solid, {0, 0, -h[2]}), solid.rounding, color, entity);
    return true;
  }
  if (solid.rounding > 0) return false;
  switch (solid.kind) {
    case SolidKind::kBox:
      SetForm(solid, size, color, entity->add_cubes());
      return true;
    case SolidKind::kEllipsoid:
      SetForm(solid, size, color, entity->add_spheres());
      return true;
    case SolidKind::kCylinder:
      AddCylinder(solid, 1, color, entity);
      return true;
    case SolidKind::kCone:
      AddCylinder(solid, 0, color, entity);
      return true;
    default:
      return false;
  }
}

/// Whether it is not too large, and its triangles have vertices.
bool CanBeDrawn(const ShapeContent& shape) {
  std::size_t points = 0;
  for (const SolidContent& solid : shape.solids) points += solid.points.size();
  if (shape.triangles.size() > kDrawnTrianglesMax || shape.solids.size() > kDrawnSolidsMax ||
      points > kDrawnHullPointsMax) {
    return false;
  }
  for (const auto& triangle : shape.triangles) {
    for (const std::uint32_t i : triangle) {
      if (i >= shape.vertices.size()) return false;
    }
  }
  return true;
}

}  // namespace

bool AddShape(const ShapeContent& shape, const foxglove::Color& color,
              foxglove::SceneEntity* entity) {
  if (!CanBeDrawn(shape)) return false;
  if (!shape.triangles.empty()) AddTriangles(shape, color, entity);
  for (const SolidContent& solid : shape.solids) {
    if (AddForm(solid, color, entity)) continue;
    ShapeContent surface = SolidSurface(solid);
    for (Point& p : surface.vertices) p = Placed(solid, p);
    AddTriangles(surface, color, entity);
  }
  return !shape.triangles.empty() || !shape.solids.empty();
}

void AddBall(const Point& center, double radius, const foxglove::Color& color,
             foxglove::SceneEntity* entity) {
  const double size = 2 * radius;
  SetForm({.position = center}, {size, size, size}, color, entity->add_spheres());
}

void AddHalfSpace(const Point& normal, double offset, const foxglove::Color& color,
                  foxglove::SceneEntity* entity) {
  const double depth = offset - kPlateThickness / 2;
  foxglove::CubePrimitive* plate = entity->add_cubes();
  SetForm({.position = {depth * normal[0], depth * normal[1], depth * normal[2]}},
          {kPlateSide, kPlateSide, kPlateThickness}, color, plate);
  *plate->mutable_pose()->mutable_orientation() = TurnOf(2, normal);
}

foxglove::Quaternion TurnOf(int axis, const Point& direction) {
  // Half-way between the two: q = (1 + a . d, a × d), normalized; half a turn if they are opposite.
  const auto i = static_cast<std::size_t>(axis), j = (i + 1) % 3, k = (i + 2) % 3;
  Point cross{};
  cross[j] = -direction[k];
  cross[k] = direction[j];
  double w = 1 + direction[i];
  if (w < 1e-9) {
    w = 0;
    cross = {};
    cross[j] = 1;
  }
  const double length = std::hypot(w, std::hypot(cross[0], cross[1], cross[2]));
  foxglove::Quaternion q;
  Set({cross[0] / length, cross[1] / length, cross[2] / length}, &q);
  q.set_w(w / length);
  return q;
}

}  // namespace collision::client
