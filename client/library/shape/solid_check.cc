#include "client/library/shape/solid_check.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "client/library/validation.h"
#include "collision_core/shape/convex_solid.h"

namespace collision::client {

static_assert(kSolidLengthMax == shape::kConvexSizeMax);

namespace {

Eigen::Vector3d VectorOf(const Vector3& v) { return {v[0], v[1], v[2]}; }

/// A value outside the enum becomes a triangle, which is refused.
geometry::ConvexCore CoreOf(Solid::Kind kind) {
  switch (kind) {
    case Solid::Kind::kBall:
      return geometry::ConvexCore::kPoint;
    case Solid::Kind::kCapsule:
      return geometry::ConvexCore::kSegment;
    case Solid::Kind::kBox:
      return geometry::ConvexCore::kBox;
    case Solid::Kind::kEllipsoid:
      return geometry::ConvexCore::kEllipsoid;
    case Solid::Kind::kHull:
      return geometry::ConvexCore::kHull;
    case Solid::Kind::kCylinder:
      return geometry::ConvexCore::kCylinder;
    case Solid::Kind::kCone:
      return geometry::ConvexCore::kCone;
  }
  return geometry::ConvexCore::kTriangle;
}

SolidKind KindOf(Solid::Kind kind) {
  switch (kind) {
    case Solid::Kind::kBall:
      return SolidKind::kBall;
    case Solid::Kind::kCapsule:
      return SolidKind::kCapsule;
    case Solid::Kind::kBox:
      return SolidKind::kBox;
    case Solid::Kind::kEllipsoid:
      return SolidKind::kEllipsoid;
    case Solid::Kind::kCylinder:
      return SolidKind::kCylinder;
    case Solid::Kind::kCone:
      return SolidKind::kCone;
    case Solid::Kind::kHull:
      break;
  }
  return SolidKind::kHull;
}

shape::ConvexDescription DescriptionOf(const Solid& solid) {
  shape::ConvexDescription description;
  description.core = CoreOf(solid.kind);
  description.half = VectorOf(solid.half_extents_m);
  description.points.reserve(solid.points_m.size());
  for (const Vector3& point : solid.points_m) description.points.push_back(VectorOf(point));
  description.rounding = solid.rounding_m;
  const auto& [w, x, y, z] = solid.orientation;
  description.q_BS = Eigen::Quaterniond(w, x, y, z);
  description.p_BS = VectorOf(solid.position_m);
  return description;
}

std::string ShortText(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

template <std::size_t kNumbers>
void DropSigns(std::array<double, kNumbers>* numbers) {
  for (double& x : *numbers) x += 0.0;  // −0 becomes 0.
}

void MakeCanonical(Solid* solid) {
  for (Vector3& point : solid->points_m) DropSigns(&point);
  DropSigns(&solid->half_extents_m);
  DropSigns(&solid->position_m);
  DropSigns(&solid->orientation);
  solid->rounding_m += 0.0;
}

/// Which half extents have a meaning.
std::array<bool, 3> UsedHalfExtents(Solid::Kind kind) {
  const bool all =
      kind != Solid::Kind::kBall && kind != Solid::Kind::kCapsule && kind != Solid::Kind::kHull;
  return {all, all, all || kind == Solid::Kind::kCapsule};
}

/// A number without a meaning is most likely a mistake: a ball whose radius is given as a half
/// extent would be a ball without a radius.
std::optional<std::string> RefusalOfUnused(const Solid& solid) {
  const std::string kind = Name(solid.kind);
  const auto used = UsedHalfExtents(solid.kind);
  for (std::size_t i = 0; i < 3; ++i) {
    if (used[i] || solid.half_extents_m[i] == 0) continue;
    const char axis = "xyz"[i];
    return std::string("half_extents_m.") + axis + ": " + ShortText(solid.half_extents_m[i]) +
           ", allowed: 0, since a " + kind + " has none along " + axis;
  }
  if (solid.kind == Solid::Kind::kHull || solid.points_m.empty()) return std::nullopt;
  return "points_m: " + std::to_string(solid.points_m.size()) + ", allowed: 0, since a " + kind +
         " has none";
}

/// Replaces the core's name of a field by the caller's, and says the rest as all refusals of the
/// library: "field: value, allowed: range".
std::string InCallersWords(std::string text) {
  constexpr std::array<std::pair<const char*, const char*>, 7> kWords = {
      {{"convex.core", "kind"},
       {"convex.half", "half_extents_m"},
       {"convex.points", "points_m"},
       {"convex.rounding", "rounding_m"},
       {"convex.q_BS", "orientation"},
       {"convex.p_BS", "position_m"},
       {"convex: its size", "its diameter"}}};
  for (const auto& [ours, theirs] : kWords) {
    if (!text.starts_with(ours)) continue;
    text.replace(0, std::string_view(ours).size(), theirs);
    break;
  }
  constexpr std::array<std::pair<std::string_view, const char*>, 5> kStyle = {
      {{" has the length ", ": length "},
       {": there are ", ": "},
       {" is ", ": "},
       {"; allowed are ", ", allowed: "},
       {"; allowed is ", ", allowed: "}}};
  for (const auto& [ours, theirs] : kStyle) {
    const std::size_t at = text.find(ours);
    // What stands behind the range is a remark.
    if (at < text.find(", allowed: ")) text.replace(at, ours.size(), theirs);
  }
  return text;
}

void RequireFitSolid(const Solid& solid, std::size_t number) {
  auto refusal = RefusalOfUnused(solid);
  if (!refusal) refusal = RefusalOf(DescriptionOf(solid));
  if (!refusal) return;
  throw std::invalid_argument("solids[" + std::to_string(number) + "] (" + Name(solid.kind) +
                              "): " + InCallersWords(*refusal));
}

}  // namespace

std::vector<Solid> Canonical(std::vector<Solid> solids) {
  if (solids.size() > kShapeSolidsMax) {
    throw std::invalid_argument("solids: " + std::to_string(solids.size()) + ", allowed: 0 to " +
                                std::to_string(kShapeSolidsMax));
  }
  std::size_t points = 0;
  for (const Solid& solid : solids) points += solid.points_m.size();
  if (points > kShapeHullPointsMax) {
    throw std::invalid_argument("solids: their hulls have " + std::to_string(points) +
                                " points, allowed: 0 to " + std::to_string(kShapeHullPointsMax));
  }
  for (std::size_t i = 0; i < solids.size(); ++i) {
    MakeCanonical(&solids[i]);
    RequireFitSolid(solids[i], i);
  }
  return solids;
}

double RadiusOf(const std::vector<Solid>& solids) {
  double radius = 0;
  for (const Solid& solid : solids) {
    radius = std::max(radius, shape::ConvexSolid::Build(DescriptionOf(solid)).facts().radius);
  }
  return radius;
}

std::vector<SolidContent> ContentOf(const std::vector<Solid>& solids) {
  std::vector<SolidContent> content;
  content.reserve(solids.size());
  for (const Solid& solid : solids) {
    content.push_back({KindOf(solid.kind), solid.position_m, solid.orientation,
                       solid.half_extents_m, solid.rounding_m, solid.points_m});
  }
  return content;
}

}  // namespace collision::client
