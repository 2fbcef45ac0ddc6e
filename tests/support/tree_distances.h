// Proof that the signed distances of a sphere tree's centres are upper bounds, without the code
// that computed them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "collision_core/sphere_tree/sphere_tree.h"
#include "tests/support/truth/exact_triangle.h"

namespace collision {

/// Triangles in boxes, halved by the order of their middles; answers in doubles where they decide
/// by far, else in exact rational numbers.
class DistanceProof {
 public:
  explicit DistanceProof(const geometry::TriangleMesh& mesh)
      : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    for (const geometry::Triangle& t : mesh.triangles) {
      for (const std::uint32_t c : t)
        size_ = std::max(size_, mesh.vertices[c].cwiseAbs().maxCoeff());
    }
    boxes_.resize(2 * order_.size());
    Divide(1, 0, order_.size());
  }

  /// Exactly: does some triangle come within `distance` (or nearer than it, if `strictly`)?
  bool ComesWithin(const Eigen::Vector3d& p, double distance, bool strictly) const {
    return Search({p, distance, strictly}, 1, 0, order_.size());
  }

  /// The winding number of a closed surface about a point off it, by a ray along +z; exact where
  /// signs are not decided by far. Rays through edges are not taken: nullopt.
  std::optional<int> WindingAt(const Eigen::Vector3d& p) const {
    int winding = 0;
    return Ray(p, 1, 0, order_.size(), &winding) ? std::optional(winding) : std::nullopt;
  }

 private:
  struct Box {
    Eigen::Vector3d lower, upper;
  };

  std::array<Eigen::Vector3d, 3> Corners(std::uint32_t triangle) const {
    const geometry::Triangle& t = mesh_.triangles[triangle];
    return {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
  }

  // A heap of boxes: the children of box k are 2 k and 2 k + 1; it may need more places than boxes.
  void Divide(std::size_t box, std::size_t first, std::size_t last) {
    if (box >= boxes_.size()) boxes_.resize(2 * box);
    Box around{Corners(order_[first])[0], Corners(order_[first])[0]};
    for (std::size_t i = first; i < last; ++i) {
      for (const Eigen::Vector3d& p : Corners(order_[i])) {
        around.lower = around.lower.cwiseMin(p);
        around.upper = around.upper.cwiseMax(p);
      }
    }
    boxes_[box] = around;
    if (last - first == 1) return;
    int axis;
    (around.upper - around.lower).maxCoeff(&axis);
    std::sort(order_.begin() + static_cast<std::ptrdiff_t>(first),
              order_.begin() + static_cast<std::ptrdiff_t>(last),
              [&](std::uint32_t i, std::uint32_t j) {
                const auto a = Corners(i), b = Corners(j);
                return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
              });
    Divide(2 * box, first, (first + last) / 2);
    Divide(2 * box + 1, (first + last) / 2, last);
  }

  /// What doubles may be off, generously.
  double Margin(const Eigen::Vector3d& p) const {
    return 1e-12 * (size_ + p.cwiseAbs().maxCoeff());
  }

  /// What ComesWithin() is called with.
  struct Goal {
    const Eigen::Vector3d& p;
    double distance;
    bool strictly;
  };

  bool Search(const Goal& goal, std::size_t box, std::size_t first, std::size_t last) const {
    const auto& [p, distance, strictly] = goal;
    const Box& b = boxes_[box];
    const double away = (b.lower - p).cwiseMax(p - b.upper).cwiseMax(0.0).norm();
    if (away > distance + Margin(p)) return false;
    if (last - first > 1) {
      const std::size_t half = (first + last) / 2;
      return Search(goal, 2 * box, first, half) || Search(goal, 2 * box + 1, half, last);
    }
    const auto corners = Corners(order_[first]);
    if (LowerBound(p, corners) > distance + Margin(p)) return false;
    const Exact square = SquareToTriangle(ExactVector(p), Exactly(corners));
    const Exact limit = Exact(distance) * Exact(distance);
    return strictly ? square < limit : square <= limit;
  }

  /// The plane across the direction from some point of the triangle is a bound wherever the point
  /// is; here the middle, then the corner that is nearest.
  static double LowerBound(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& t) {
    double bound = 0;
    const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const Eigen::Vector3d towards[] = {
        p - (t[0] + t[1] + t[2]) / 3, normal, -normal, p - t[0], p - t[1], p - t[2]};
    for (const Eigen::Vector3d& n : towards) {
      if (!(n.squaredNorm() > 0)) continue;
      double least = n.dot(p - t[0]);
      for (const Eigen::Vector3d& corner : t) least = std::min(least, n.dot(p - corner));
      bound = std::max(bound, least / n.norm());
    }
    return bound;
  }

  static int Side(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& p) {
    const double u = (b.x() - a.x()) * (p.y() - a.y()), v = (b.y() - a.y()) * (p.x() - a.x());
    if (std::abs(u - v) > 1e-14 * (std::abs(u) + std::abs(v))) return u > v ? 1 : -1;
    const Exact exact = (Exact(b.x()) - Exact(a.x())) * (Exact(p.y()) - Exact(a.y())) -
                        (Exact(b.y()) - Exact(a.y())) * (Exact(p.x()) - Exact(a.x()));
    return exact.sign();
  }

  bool Ray(const Eigen::Vector3d& p, std::size_t box, std::size_t first, std::size_t last,
           int* winding) const {
    const Box& b = boxes_[box];
    if (p.x() < b.lower.x() || p.x() > b.upper.x() || p.y() < b.lower.y() || p.y() > b.upper.y() ||
        p.z() > b.upper.z())
      return true;
    if (last - first > 1) {
      const std::size_t half = (first + last) / 2;
      return Ray(p, 2 * box, first, half, winding) && Ray(p, 2 * box + 1, half, last, winding);
    }
    const auto t = Corners(order_[first]);
    const int sides[3] = {Side(t[0], t[1], p), Side(t[1], t[2], p), Side(t[2], t[0], p)};
    const int sum = sides[0] + sides[1] + sides[2];
    const bool left = sides[0] > 0 || sides[1] > 0 || sides[2] > 0;
    const bool right = sides[0] < 0 || sides[1] < 0 || sides[2] < 0;
    if (left && right) return true;
    if (sum != 3 && sum != -3) return false;
    const ExactTriangle e = Exactly(t);
    const Exact above = Dot(Cross(e[1] - e[0], e[2] - e[0]), ExactVector(p) - e[0]);
    if (above.sign() == 0) return false;
    // The plane is ahead where the point is on the side away from the normal's z.
    if (above.sign() * sum < 0) *winding += sum / 3;
    return true;
  }

  const geometry::TriangleMesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Box> boxes_;
  double size_ = 0;
};

/// The number of nodes whose signed distance is not shown to be an upper bound: for one that is
/// negative, no triangle is nearer, and the winding number is not zero; else some triangle is
/// as near.
inline std::size_t UnprovenDistances(const geometry::TriangleMesh& mesh,
                                     const sphere_tree::SphereTree& tree) {
  const DistanceProof proof(mesh);
  // In a ball that no triangle comes into, the winding number is the same everywhere: if the ray
  // from the centre meets an edge, one from beside it may not.
  const Eigen::Vector3d beside[] = {{0, 0, 0},           {0.31, 0.17, 0.05},  {-0.23, 0.29, 0.11},
                                    {0.13, -0.37, 0.07}, {-0.19, -0.11, 0.2}, {0.41, 0.03, -0.3}};
  const auto is_inside = [&](const sphere_tree::SphereNode& node) {
    for (const Eigen::Vector3d& offset : beside) {
      if (const auto w = proof.WindingAt(node.centre - node.signed_distance * offset))
        return *w != 0;
    }
    return false;
  };
  std::size_t unproven = 0;
  for (const sphere_tree::SphereNode& node : tree.nodes) {
    const double s = node.signed_distance;
    const bool is_proven = (s >= 0 && proof.ComesWithin(node.centre, s, false)) ||
                           (s <= 0 && !proof.ComesWithin(node.centre, -s, true) && is_inside(node));
    if (!is_proven) ++unproven;
  }
  return unproven;
}

}  // namespace collision
