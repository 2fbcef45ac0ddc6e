#include "collision_core/sphere_tree/fitted/fitted_boxes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kFacesPerLeaf = 4;

/// A square of a height is known to so much, unless the point is far aside.
constexpr double kFarther = 1 + 1e-9;

/// The weights s, t of the nearest point a + s u + t v of a triangle, for w = p − a (Ericson,
/// "Real-Time Collision Detection", 2005, section 5.1.5).
struct Weights {
  double s, t;
};
Weights NearestOf(double uu, double uv, double vv, double d1, double d2) {
  if (d1 <= 0 && d2 <= 0) return {0, 0};
  const double d3 = d1 - uu, d4 = d2 - uv;
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {d1 / (d1 - d3), 0};
  const double d5 = d1 - uv, d6 = d2 - vv;
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1 - t, t};
  }
  const double share = 1 / (va + vb + vc);
  return {vb * share, vc * share};
}

}  // namespace

TriangleBoxTree::TriangleBoxTree(const geometry::TriangleMesh& mesh) : mesh_(mesh) {
  faces_.reserve(mesh.triangles.size());
  nodes_.reserve(mesh.triangles.size());
  std::vector<ElementIndex> triangles;
  triangles.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) triangles.emplace_back(i);
  Divide(triangles);
  place_.resize(faces_.size());
  for (std::uint32_t i = 0; i < faces_.size(); ++i) place_[faces_[i].triangle] = i;
}

void TriangleBoxTree::MakeFaces(std::span<const ElementIndex> triangles, Node* leaf) {
  leaf->first = static_cast<std::uint32_t>(faces_.size());
  leaf->count = static_cast<std::uint32_t>(triangles.size());
  for (const ElementIndex triangle : triangles) {
    const auto [a, b, c] = CornersOf(triangle);
    const Vector3d u = b - a, v = c - a;
    const Vector3d across = u.cross(v);
    const double length = across.norm();
    const bool is_known = length > 0 && length <= std::numeric_limits<double>::max();
    const Vector3d normal = is_known ? Vector3d(across / length) : Vector3d(0, 0, 0);
    faces_.push_back({a, u, v, u.squaredNorm(), u.dot(v), v.squaredNorm(), normal, triangle});
  }
}

void TriangleBoxTree::Divide(std::span<ElementIndex> triangles) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  const auto middle_of = [this](ElementIndex triangle) -> Vector3d {
    const auto [a, b, c] = CornersOf(triangle);
    return a + b + c;
  };
  Vector3d lower = CornersOf(triangles[0])[0], upper = lower;
  Vector3d middle_lower = middle_of(triangles[0]), middle_upper = middle_lower;
  for (const ElementIndex triangle : triangles) {
    for (const Vector3d& p : CornersOf(triangle)) {
      lower = lower.cwiseMin(p);
      upper = upper.cwiseMax(p);
    }
    middle_lower = middle_lower.cwiseMin(middle_of(triangle));
    middle_upper = middle_upper.cwiseMax(middle_of(triangle));
  }
  nodes_[at].lower = lower;
  nodes_[at].upper = upper;
  if (triangles.size() <= kFacesPerLeaf) return MakeFaces(triangles, &nodes_[at]);
  int axis;
  (middle_upper - middle_lower).maxCoeff(&axis);
  const std::size_t half = triangles.size() / 2;
  std::nth_element(triangles.begin(), triangles.begin() + half, triangles.end(),
                   [&](ElementIndex i, ElementIndex j) {
                     const double x = middle_of(i)[axis], y = middle_of(j)[axis];
                     return x != y ? x < y : i < j;
                   });
  Divide(triangles.first(half));
  nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
  Divide(triangles.subspan(half));
}

inline void TriangleBoxTree::TryFace(const Face& face, const Vector3d& point, double* best2,
                                     NearPoint* best) {
  const Vector3d &u = face.to_second, &v = face.to_third, w = point - face.corner;
  // The plane alone is farther.
  const double height = face.normal.dot(w);
  if (height * height > kFarther * *best2) return;
  const Weights at = NearestOf(face.uu, face.uv, face.vv, u.dot(w), v.dot(w));
  const double square = (w - at.s * u - at.t * v).squaredNorm();
  if (!(square < *best2)) return;
  *best2 = square;
  best->point = face.corner + at.s * u + at.t * v;
  best->triangle = face.triangle;
}

NearPoint TriangleBoxTree::Nearest(const Vector3d& point, ElementIndex hint, double enough,
                                   double slack) const {
  struct Pending {
    double square;
    std::uint32_t node;
  };
  std::array<Pending, kDepthMax> stack;
  std::size_t size = 0;
  NearPoint best;
  const double enough2 = enough > 0 ? enough * enough : -1;
  double best2 = std::numeric_limits<double>::infinity();
  TryFace(faces_[place_[hint]], point, &best2, &best);
  const auto limit_of = [slack](double square) {
    const double d = std::sqrt(square) - slack;
    return d > 0 ? d * d : 0;
  };
  double limit2 = limit_of(best2);
  std::uint32_t at = 0;
  double here = SquareTo(nodes_[0], point);
  std::uint64_t work = 0;
  while (best2 > enough2) {
    ++work;
    if (here < limit2) {
      const Node& node = nodes_[at];
      if (node.count == 0) {
        Pending near = {SquareTo(nodes_[at + 1], point), at + 1};
        Pending far = {SquareTo(nodes_[node.first], point), node.first};
        if (far.square < near.square) std::swap(near, far);
        if (far.square < limit2) stack[size++] = far;
        at = near.node;
        here = near.square;
        continue;
      }
      const double before = best2;
      work += node.count;
      for (std::uint32_t i = 0; i < node.count; ++i)
        TryFace(faces_[node.first + i], point, &best2, &best);
      if (best2 < before) limit2 = limit_of(best2);
    }
    if (size == 0) break;
    --size;
    at = stack[size].node;
    here = stack[size].square;
  }
  work_ += work;
  best.distance = std::sqrt(best2);
  return best;
}

RayCast TriangleBoxTree::Walk(const Vector3d& from, const Vector3d& direction,
                              ElementIndex start) const {
  std::array<std::uint32_t, kDepthMax> stack;
  std::size_t size = 0;
  RayCast walk{diagonal(), 0};
  const Vector3d inverse = direction.cwiseInverse();
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    work_ += 1 + node.count;
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double x = (node.lower[axis] - from[axis]) * inverse[axis];
      const double y = (node.upper[axis] - from[axis]) * inverse[axis];
      // Where the product is not a number the comparison fails, and the bound stays.
      enter = std::max(enter, std::min(x, y));
      leave = std::min(leave, std::max(x, y));
    }
    if (enter > leave) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = at + 1;
      continue;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const Face& face = faces_[node.first + i];
      if (face.triangle == start) continue;
      const Vector3d across = direction.cross(face.to_third);
      const double volume = face.to_second.dot(across);
      if (volume == 0) continue;
      const Vector3d w = from - face.corner;
      const double s = w.dot(across) / volume;
      const Vector3d side = w.cross(face.to_second);
      const double t = direction.dot(side) / volume;
      const double distance = face.to_third.dot(side) / volume;
      if (!(s >= 0 && t >= 0 && s + t <= 1 && distance > 0)) continue;
      walk.first = std::min(walk.first, distance);
      walk.winding += volume > 0 ? -1 : 1;
    }
  }
  return walk;
}

}  // namespace collision::sphere_tree
