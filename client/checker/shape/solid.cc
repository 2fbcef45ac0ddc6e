#include "client/checker/shape/solid.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

namespace collision::checker {
namespace {

using Faces = std::vector<std::array<std::uint32_t, 3>>;

// Share of the points' extent within which a point counts as on a plane or line. Far above
// rounding, far below the checker's resolution.
constexpr double kFlat = 1e-12;

double ExtentOf(const std::vector<Vector>& points) {
  double extent = 0;
  for (const Vector& p : points) extent = std::max(extent, Length(p - points[0]));
  return extent;
}

// The points sorted by x, y, z, without near duplicates.
std::vector<Vector> Distinct(std::vector<Vector> points, double tolerance) {
  const auto key = [](const Vector& v) { return std::tuple(v.x, v.y, v.z); };
  std::sort(points.begin(), points.end(),
            [&](const Vector& v, const Vector& w) { return key(v) < key(w); });
  std::vector<Vector> distinct;
  for (const Vector& p : points) {
    const auto same = [&](const Vector& other) { return Length(p - other) <= tolerance; };
    if (std::none_of(distinct.begin(), distinct.end(), same)) distinct.push_back(p);
  }
  return distinct;
}

// Twice its area over its longest side.
double HeightOf(const Vector& p, const Vector& q, const Vector& r) {
  const double longest = std::max({Length(q - p), Length(r - p), Length(r - q)});
  return Length(Cross(q - p, r - p)) / longest;
}

// The corners of the convex polygon around points of one plane, anticlockwise about n, without
// points on its sides. Gift wrapping (Jarvis): all other points lie left of the next edge.
std::vector<std::uint32_t> Polygon(const std::vector<Vector>& points,
                                   const std::vector<std::uint32_t>& plane, const Vector& n,
                                   double tolerance) {
  const auto right_of = [&](std::uint32_t from, std::uint32_t to, std::uint32_t k) {
    const Vector side = points[to] - points[from];
    const double height = Dot(Cross(side, points[k] - points[from]), n) / Length(side);
    const bool on_line = std::fabs(height) <= tolerance;
    return on_line ? Length(points[k] - points[from]) > Length(side) : height < 0;
  };
  // The furthest from any point is a corner.
  const std::uint32_t start =
      *std::max_element(plane.begin(), plane.end(), [&](std::uint32_t i, std::uint32_t k) {
        return Length(points[i] - points[plane[0]]) < Length(points[k] - points[plane[0]]);
      });
  std::vector<std::uint32_t> corners = {start};
  while (corners.size() <= plane.size()) {
    std::uint32_t next = corners.back() == plane[0] ? plane[1] : plane[0];
    for (const std::uint32_t k : plane) {
      if (k != next && k != corners.back() && right_of(corners.back(), next, k)) next = k;
    }
    if (next == corners.front()) break;
    corners.push_back(next);
  }
  return corners;
}

// The points in the plane through i, j, k if all others lie on one side; turns *n outward.
std::vector<std::uint32_t> PlaneThrough(const std::vector<Vector>& points, std::uint32_t i,
                                        double tolerance, Vector* n) {
  bool above = false, below = false;
  std::vector<std::uint32_t> plane;
  for (std::uint32_t m = 0; m < points.size(); ++m) {
    const double height = Dot(*n, points[m] - points[i]);
    above = above || height > tolerance;
    below = below || height < -tolerance;
    if (above && below) return {};
    if (std::fabs(height) <= tolerance) plane.push_back(m);
  }
  if (above) *n = -1.0 * *n;
  return plane;
}

Faces FacesOf(const std::vector<Vector>& points, double tolerance) {
  Faces faces;
  std::set<std::vector<std::uint32_t>> seen;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    for (std::uint32_t j = i + 1; j < points.size(); ++j) {
      for (std::uint32_t k = j + 1; k < points.size(); ++k) {
        if (HeightOf(points[i], points[j], points[k]) <= tolerance) continue;  // In one line.
        Vector n = Cross(points[j] - points[i], points[k] - points[i]);
        n = 1 / Length(n) * n;
        const std::vector<std::uint32_t> plane = PlaneThrough(points, i, tolerance, &n);
        if (plane.size() < 3 || !seen.insert(plane).second) continue;
        const std::vector<std::uint32_t> corners = Polygon(points, plane, n, tolerance);
        for (std::size_t c = 2; c < corners.size(); ++c)
          faces.push_back({corners[0], corners[c - 1], corners[c]});
      }
    }
  }
  return faces;
}

}  // namespace

Mesh HullOf(const std::vector<Vector>& given) {
  if (given.empty() || given.size() > kHullPointsMax)
    throw std::runtime_error("a hull of " + std::to_string(given.size()) +
                             " points; the checker knows 1 to " + std::to_string(kHullPointsMax));
  const double tolerance = kFlat * ExtentOf(given);
  const std::vector<Vector> points = Distinct(given, tolerance);
  const Faces faces = FacesOf(points, tolerance);
  // The points are sorted: on one line, the first and the last are its ends.
  if (faces.empty()) return Mesh::OfSegment(points.front(), points.back());
  Mesh mesh(points, faces);
  if (!mesh.closed()) {
    // All points lie in one plane.
    const Triangle& t = mesh.triangles()[0];
    const Vector n = Cross(t[1] - t[0], t[2] - t[0]);
    for (const Vector& p : points) {
      if (std::fabs(Dot(n, p - t[0])) > 2 * tolerance * Length(n))
        throw std::runtime_error("the faces of a hull of " + std::to_string(points.size()) +
                                 " points do not join: some lie almost in one plane");
    }
  }
  return mesh;
}

std::vector<Vector> BoxCorners(const Vector& half) {
  std::vector<Vector> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i)
    corners.push_back(
        {(i & 1) ? half.x : -half.x, (i & 2) ? half.y : -half.y, (i & 4) ? half.z : -half.z});
  return corners;
}

}  // namespace collision::checker
