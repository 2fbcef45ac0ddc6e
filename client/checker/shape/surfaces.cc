#include "client/checker/shape/surfaces.h"

#include <utility>

namespace collision::checker {
namespace {

using Node = Mesh::Node;

// The half extents, along the axes of A, of a box given along those of B.
Vector HalfSeen(const Pose& pose, const Vector& half) {
  const auto along = [&](const Vector& row) {
    return std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z;
  };
  return {along(pose.R_AB[0]), along(pose.R_AB[1]), along(pose.R_AB[2])};
}

// The squared distance of two boxes along the same axes, from their centres' difference.
double SquaredGap(const Vector& d, const Vector& half_a, const Vector& half_b) {
  const double x = std::max(0.0, std::fabs(d.x) - half_a.x - half_b.x);
  const double y = std::max(0.0, std::fabs(d.y) - half_a.y - half_b.y);
  const double z = std::max(0.0, std::fabs(d.z) - half_a.z - half_b.z);
  return x * x + y * y + z * z;
}

double SquaredGap(const Triangle& a, const Triangle& b) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [a0, a1] = std::minmax({a[0][axis], a[1][axis], a[2][axis]});
    const auto [b0, b1] = std::minmax({b[0][axis], b[1][axis], b[2][axis]});
    const double gap = std::max({0.0, a0 - b1, b0 - a1});
    sum += gap * gap;
  }
  return sum;
}

Triangle Seen(const Pose& pose, const Triangle& t) { return {pose(t[0]), pose(t[1]), pose(t[2])}; }

// Boxes are compared with an allowance for rounding.
constexpr double kBoxSpare = 1e-13;

// Visits the pairs of leaves whose boxes are nearer than `reach`, nearer pairs first.
template <typename Reach, typename Visit>
void ForNearLeaves(const Mesh& a, const Mesh& b, const Pose& pose, const Reach& reach,
                   const Visit& visit) {
  struct Entry {
    std::uint32_t a, b;
    double squared;
  };
  const auto entry = [&](std::uint32_t i, std::uint32_t k) {
    const Node& node_a = a.nodes()[i];
    const Node& node_b = b.nodes()[k];
    return Entry{
        i, k,
        SquaredGap(pose(node_b.centre) - node_a.centre, node_a.half, HalfSeen(pose, node_b.half))};
  };
  std::vector<Entry> open = {entry(0, 0)};
  while (!open.empty()) {
    const Entry next = open.back();
    open.pop_back();
    const double limit = reach() + kBoxSpare;
    if (next.squared > limit * limit) continue;
    const Node& node_a = a.nodes()[next.a];
    const Node& node_b = b.nodes()[next.b];
    if (node_a.triangles > 0 && node_b.triangles > 0) {
      if (!visit(node_a, node_b)) return;
      continue;
    }
    const bool divide_a = node_b.triangles > 0 ||
                          (node_a.triangles == 0 && Squared(node_a.half) >= Squared(node_b.half));
    Entry first = divide_a ? entry(node_a.child, next.b) : entry(next.a, node_b.child);
    Entry second = divide_a ? entry(node_a.child + 1, next.b) : entry(next.a, node_b.child + 1);
    if (first.squared < second.squared) std::swap(first, second);
    open.push_back(first);
    open.push_back(second);
  }
}

}  // namespace

double SurfaceDistance(const Mesh& a, const Mesh& b, const Pose& pose, double limit, Hint* hint) {
  double best = limit;
  if (hint->a < a.triangles().size() && hint->b < b.triangles().size())
    best = std::min(best, Distance(a.triangles()[hint->a], Seen(pose, b.triangles()[hint->b])));
  if (best <= kTouching) return best;
  ForNearLeaves(
      a, b, pose, [&] { return best; },
      [&](const Node& node_a, const Node& node_b) {
        for (std::uint32_t k = node_b.first; k < node_b.first + node_b.triangles; ++k) {
          const Triangle seen = Seen(pose, b.triangles()[k]);
          for (std::uint32_t i = node_a.first; i < node_a.first + node_a.triangles; ++i) {
            if (SquaredGap(a.triangles()[i], seen) > best * best) continue;
            const double distance = Distance(a.triangles()[i], seen);
            if (distance >= best) continue;
            best = distance;
            *hint = {i, k};
            if (best <= kTouching) return false;
          }
        }
        return true;
      });
  return best;
}

double BestCrossing(const Mesh& a, const Mesh& b, const Pose& pose) {
  double best = 0;
  ForNearLeaves(
      a, b, pose, [] { return 0.0; },
      [&](const Node& node_a, const Node& node_b) {
        for (std::uint32_t k = node_b.first; k < node_b.first + node_b.triangles; ++k) {
          const Triangle seen = Seen(pose, b.triangles()[k]);
          for (std::uint32_t i = node_a.first; i < node_a.first + node_a.triangles; ++i) {
            if (SquaredGap(a.triangles()[i], seen) == 0)
              best = std::max(best, CrossingMargin(a.triangles()[i], seen));
          }
        }
        return true;
      });
  return best;
}

double SurfaceDistance(const Mesh& mesh, const Vector& point) {
  double best = INFINITY;
  std::vector<std::uint32_t> open = {0};
  const auto gap = [&](std::uint32_t i) {
    return SquaredGap(point - mesh.nodes()[i].centre, mesh.nodes()[i].half, {});
  };
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    open.pop_back();
    const Node& node = mesh.nodes()[i];
    if (gap(i) > (best + kBoxSpare) * (best + kBoxSpare)) continue;
    if (node.triangles == 0) {
      const bool second_nearer = gap(node.child + 1) < gap(node.child);
      open.push_back(second_nearer ? node.child : node.child + 1);
      open.push_back(second_nearer ? node.child + 1 : node.child);
      continue;
    }
    for (std::uint32_t t = node.first; t < node.first + node.triangles; ++t)
      best = std::min(best, Length(NearestPoint(point, mesh.triangles()[t]) - point));
  }
  return best;
}

std::vector<std::uint32_t> TrianglesNear(const Mesh& mesh, const Vector& point, double reach) {
  std::vector<std::uint32_t> found, open = {0};
  const double limit = reach + kBoxSpare;
  while (!open.empty()) {
    const Node& node = mesh.nodes()[open.back()];
    open.pop_back();
    if (SquaredGap(point - node.centre, node.half, {}) > limit * limit) continue;
    for (std::uint32_t t = node.first; t < node.first + node.triangles; ++t) found.push_back(t);
    if (node.triangles == 0) open.insert(open.end(), {node.child, node.child + 1});
  }
  return found;
}

double LeastAlong(const Mesh& mesh, const Vector& d) {
  double least = INFINITY;
  std::vector<std::uint32_t> open = {0};
  const auto bound = [&](std::uint32_t i) {
    const Node& node = mesh.nodes()[i];
    const Vector& half = node.half;
    return Dot(d, node.centre) - std::fabs(d.x) * half.x - std::fabs(d.y) * half.y -
           std::fabs(d.z) * half.z;
  };
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    open.pop_back();
    if (bound(i) > least + kBoxSpare) continue;
    const Node& node = mesh.nodes()[i];
    for (std::uint32_t t = node.first; t < node.first + node.triangles; ++t) {
      for (const Vector& v : mesh.triangles()[t]) least = std::min(least, Dot(d, v));
    }
    if (node.triangles > 0) continue;
    const bool second_lower = bound(node.child + 1) < bound(node.child);
    open.push_back(second_lower ? node.child : node.child + 1);
    open.push_back(second_lower ? node.child + 1 : node.child);
  }
  return least;
}

bool Contained(const Mesh& a, const Mesh& b, const Pose& pose) {
  const auto& of_a = a.part_points();
  const auto& of_b = b.part_points();
  return std::any_of(of_b.begin(), of_b.end(),
                     [&](const Vector& p) { return a.Contains(pose(p)); }) ||
         std::any_of(of_a.begin(), of_a.end(),
                     [&](const Vector& p) { return b.Contains(pose.Back(p)); });
}

}  // namespace collision::checker
