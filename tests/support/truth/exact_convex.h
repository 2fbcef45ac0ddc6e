// Convex solids in exact arithmetic, from their descriptions and the definitions of distance and
// depth.
#pragma once

#include <vector>

#include "collision_core/shape/convex_solid.h"
#include "tests/support/truth/exact_triangle.h"

namespace collision {

/// A linear map and a shift of exact numbers.
struct ExactPlacement {
  std::array<ExactVector, 3> rows{ExactVector(1, 0, 0), ExactVector(0, 1, 0), ExactVector(0, 0, 1)};
  ExactVector offset{0, 0, 0};

  ExactVector operator()(const ExactVector& x) const {
    return ExactVector(Dot(rows[0], x), Dot(rows[1], x), Dot(rows[2], x)) + offset;
  }
};

/// The rotation q / |q| is rational, whatever q.
inline ExactPlacement PlacementOf(const Eigen::Quaterniond& q, const Eigen::Vector3d& offset) {
  const Exact w = q.w(), x = q.x(), y = q.y(), z = q.z();
  const Exact s = 2 / (w * w + x * x + y * y + z * z);
  ExactPlacement placement;
  placement.rows[0] = {1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)};
  placement.rows[1] = {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)};
  placement.rows[2] = {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)};
  placement.offset = ExactVector(offset);
  return placement;
}

inline ExactPlacement PlacementOf(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& offset) {
  ExactPlacement placement;
  for (int i = 0; i < 3; ++i) placement.rows[i] = ExactVector(Eigen::Vector3d(matrix.row(i)));
  placement.offset = ExactVector(offset);
  return placement;
}

/// The corners of the core in the body frame; not for ellipsoids.
inline std::vector<ExactVector> ExactCorners(const shape::ConvexDescription& d) {
  const ExactPlacement placement = PlacementOf(d.q_BS, d.p_BS);
  std::vector<ExactVector> corners;
  const auto add = [&](const Eigen::Vector3d& x) { corners.push_back(placement(ExactVector(x))); };
  const Eigen::Vector3d& h = d.half;
  if (d.core == geometry::ConvexCore::kPoint) add({0, 0, 0});
  for (const int i : {-1, 1}) {
    if (d.core == geometry::ConvexCore::kSegment) add({0, 0, i * h.z()});
    for (const int j : {-1, 1}) {
      for (const int k : {-1, 1}) {
        if (d.core == geometry::ConvexCore::kBox) add({i * h.x(), j * h.y(), k * h.z()});
      }
    }
  }
  for (const Eigen::Vector3d& p : d.points) add(p);
  return corners;
}

inline std::vector<ExactVector> Placed(std::vector<ExactVector> points,
                                       const ExactPlacement& placement) {
  for (ExactVector& p : points) p = placement(p);
  return points;
}

using ExactPoints = std::vector<ExactVector>;

inline ExactPoints Difference(const ExactPoints& a, const ExactPoints& b) {
  ExactPoints points;
  for (const ExactVector& y : b) {
    for (const ExactVector& x : a) points.push_back(y - x);
  }
  return points;
}

/// The weights, of sum 1, of the point of least length in the flat through the corners; empty where
/// they are not affinely independent.
inline std::vector<Exact> LeastWeights(const ExactPoints& corners) {
  const std::size_t n = corners.size() - 1;
  std::vector<std::vector<Exact>> rows(n, std::vector<Exact>(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    const ExactVector e = corners[i + 1] - corners[0];
    for (std::size_t j = 0; j < n; ++j) rows[i][j] = Dot(e, corners[j + 1] - corners[0]);
    rows[i][n] = -Dot(e, corners[0]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    while (pivot < n && rows[pivot][i] == 0) ++pivot;
    if (pivot == n) return {};
    std::swap(rows[i], rows[pivot]);
    for (std::size_t k = 0; k < n; ++k) {
      if (k == i || rows[k][i] == 0) continue;
      const Exact factor = rows[k][i] / rows[i][i];
      for (std::size_t j = i; j <= n; ++j) rows[k][j] -= factor * rows[i][j];
    }
  }
  std::vector<Exact> weights(n + 1, Exact(0));
  weights[0] = 1;
  for (std::size_t i = 0; i < n; ++i) {
    weights[i + 1] = rows[i][n] / rows[i][i];
    weights[0] -= weights[i + 1];
  }
  return weights;
}

/// The point of least length in the hull of points (Wolfe, "Finding the nearest point in a
/// polytope", 1976). What it returns is proven by its last comparison: no point x of the hull has
/// x·nearest < nearest·nearest.
inline ExactVector NearestToZero(const ExactPoints& points) {
  ExactPoints corners = {points[0]};
  std::vector<Exact> weights = {1};
  ExactVector nearest = points[0];
  for (;;) {
    const ExactVector* least = &points[0];
    Exact along = Dot(points[0], nearest);
    for (const ExactVector& p : points) {
      const Exact of_p = Dot(p, nearest);
      if (of_p < along) along = of_p, least = &p;
    }
    if (along >= Square(nearest)) return nearest;
    corners.push_back(*least);
    weights.push_back(0);
    for (;;) {
      const std::vector<Exact> wanted = LeastWeights(corners);
      Exact step = 1;
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i] < 0) step = std::min(step, Exact(weights[i] / (weights[i] - wanted[i])));
      }
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        weights[i] += step * (wanted[i] - weights[i]);
      }
      if (step == 1) break;
      for (std::size_t i = weights.size(); i-- > 0;) {
        if (weights[i] > 0) continue;
        weights.erase(weights.begin() + i);
        corners.erase(corners.begin() + i);
      }
    }
    nearest = ExactVector(0, 0, 0);
    for (std::size_t i = 0; i < corners.size(); ++i) nearest = nearest + weights[i] * corners[i];
    for (std::size_t i = weights.size(); i-- > 0;) {
      if (weights[i] != 0) continue;
      weights.erase(weights.begin() + i);
      corners.erase(corners.begin() + i);
    }
  }
}

/// All directions that a face of B − A can have: of faces of each, and of pairs of edges.
inline ExactPoints FaceDirections(const ExactPoints& a, const ExactPoints& b) {
  ExactPoints directions, edges[2];
  for (int which = 0; which < 2; ++which) {
    const ExactPoints& points = which ? b : a;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) edges[which].push_back(points[i] - points[j]);
    }
    for (std::size_t i = 0; i < edges[which].size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        directions.push_back(Cross(edges[which][i], edges[which][j]));
      }
    }
  }
  for (const ExactVector& of_a : edges[0]) {
    for (const ExactVector& of_b : edges[1]) directions.push_back(Cross(of_a, of_b));
  }
  return directions;
}

/// The square of the least shift that takes overlapping hulls apart: the faces of B − A decide, and
/// no direction can be less than the least of theirs. All directions are taken both ways.
inline Exact SquareOfDepth(const ExactPoints& a, const ExactPoints& b,
                           const ExactPoints& directions) {
  Exact least = -1;
  for (const ExactVector& n : directions) {
    const Exact square = Square(n);
    if (square == 0) continue;
    Exact low_a = Dot(n, a[0]), high_a = low_a, low_b = Dot(n, b[0]), high_b = low_b;
    for (const ExactVector& x : a) {
      const Exact along = Dot(n, x);
      low_a = std::min(low_a, along), high_a = std::max(high_a, along);
    }
    for (const ExactVector& x : b) {
      const Exact along = Dot(n, x);
      low_b = std::min(low_b, along), high_b = std::max(high_b, along);
    }
    const Exact reach = std::min(Exact(high_b - low_a), Exact(high_a - low_b));
    const Exact depth = reach * reach / square;
    if (least < 0 || depth < least) least = depth;
  }
  return least;
}

/// The three directions of a box's edges, or the one of a segment.
inline ExactPoints EdgeDirections(const shape::ConvexDescription& d, const ExactPlacement& pose) {
  const ExactPlacement placement = PlacementOf(d.q_BS, {0, 0, 0});
  ExactPlacement turn = pose;
  turn.offset = {0, 0, 0};
  ExactPoints edges;
  for (int i = 0; i < 3; ++i) {
    if (d.core == geometry::ConvexCore::kBox ||
        (d.core == geometry::ConvexCore::kSegment && i == 2)) {
      edges.push_back(turn(placement(ExactVector(Eigen::Vector3d(Eigen::Vector3d::Unit(i))))));
    }
  }
  return edges;
}

/// lower <= √square − more?
inline bool IsAtMost(double lower, const Exact& square, const Exact& more) {
  if (std::isinf(lower)) return lower < 0;
  const Exact with = Exact(lower) + more;
  return with <= 0 || with * with <= square;
}

/// √square − more <= upper?
inline bool IsAtLeast(double upper, const Exact& square, const Exact& more) {
  if (std::isinf(upper)) return upper > 0;
  const Exact with = Exact(upper) + more;
  return with >= 0 && with * with >= square;
}

}  // namespace collision
