#include "client/programs/foxglove/channels/solid_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace collision::client {
namespace {

using Point = std::array<double, 3>;

/// Of an octahedron: 4^4 triangles on each of its faces.
constexpr int kDivisions = 4;

double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point Unit(const Point& a) {
  const double length = std::sqrt(Dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Directions as vertices of length 1.
ShapeContent UnitSphere() {
  ShapeContent sphere;
  sphere.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  sphere.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                      {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < kDivisions; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto next = static_cast<std::uint32_t>(sphere.vertices.size());
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), next);
      if (is_new) {
        const Point p = sphere.vertices[a], q = sphere.vertices[b];
        sphere.vertices.push_back(Unit({p[0] + q[0], p[1] + q[1], p[2] + q[2]}));
      }
      return place->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : sphere.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    sphere.triangles = std::move(finer);
  }
  return sphere;
}

/// Of a disc of `radius` at height `z`; its centre where `d` points along z.
Point FarthestOnDisc(const Point& d, double radius, double z) {
  const double length = std::hypot(d[0], d[1]);
  if (length == 0) return {0, 0, z};
  return {radius * d[0] / length, radius * d[1] / length, z};
}

Point FarthestOfHull(const std::vector<Point>& points, const Point& d) {
  Point best{};
  double farthest = -INFINITY;
  for (const Point& p : points) {
    const double distance = Dot(p, d);
    if (distance <= farthest) continue;
    farthest = distance;
    best = p;
  }
  return best;
}

/// Of the core.
Point Farthest(const SolidContent& solid, const Point& d) {
  const Point& h = solid.half_extents;
  const double z = std::copysign(h[2], d[2]);
  switch (solid.kind) {
    case SolidKind::kBall:
      return {};
    case SolidKind::kCapsule:
      return {0, 0, z};
    case SolidKind::kBox:
      return {std::copysign(h[0], d[0]), std::copysign(h[1], d[1]), z};
    case SolidKind::kEllipsoid: {
      const double scale = std::hypot(h[0] * d[0], h[1] * d[1], h[2] * d[2]);
      if (scale == 0) return {};
      return {h[0] * h[0] * d[0] / scale, h[1] * h[1] * d[1] / scale, h[2] * h[2] * d[2] / scale};
    }
    case SolidKind::kHull:
      return FarthestOfHull(solid.points, d);
    case SolidKind::kCylinder:
      return FarthestOnDisc(d, h[0], z);
    case SolidKind::kCone: {
      const Point base = FarthestOnDisc(d, h[0], -h[2]), apex{0, 0, h[2]};
      return Dot(apex, d) > Dot(base, d) ? apex : base;
    }
  }
  return {};
}

}  // namespace

ShapeContent SolidSurface(const SolidContent& solid) {
  static const ShapeContent sphere = UnitSphere();
  ShapeContent surface;
  std::map<Point, std::uint32_t> known;
  std::vector<std::uint32_t> moved;
  for (const Point& d : sphere.vertices) {
    Point p = Farthest(solid, d);
    for (std::size_t i = 0; i < 3; ++i) p[i] += solid.rounding * d[i];
    const auto next = static_cast<std::uint32_t>(surface.vertices.size());
    const auto [place, is_new] = known.try_emplace(p, next);
    if (is_new) surface.vertices.push_back(p);
    moved.push_back(place->second);
  }
  for (const auto& [a, b, c] : sphere.triangles) {
    if (moved[a] == moved[b] || moved[b] == moved[c] || moved[c] == moved[a]) continue;
    surface.triangles.push_back({moved[a], moved[b], moved[c]});
  }
  return surface;
}

}  // namespace collision::client
