// Facts of a whole mesh: closed or open, the number of its components, its size.
#include <algorithm>
#include <numeric>

#include "collision_core/base/check.h"
#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/numeric/interval.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

bool LexicographicallyLess(const Vector3d& a, const Vector3d& b) {
  for (int i = 0; i < 3; ++i) {
    if (a[i] != b[i]) return a[i] < b[i];
  }
  return false;
}

/// How often an edge is traversed from its lower to its higher end, less the traversals the other
/// way.
struct EdgePass {
  std::uint32_t lower, higher;
  std::int32_t passes;

  bool IsOn(const EdgePass& other) const { return lower == other.lower && higher == other.higher; }
};

bool SumsToZero(std::vector<EdgePass> passes) {
  std::sort(passes.begin(), passes.end(), [](const EdgePass& a, const EdgePass& b) {
    return a.lower != b.lower ? a.lower < b.lower : a.higher < b.higher;
  });
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    sum += passes[i].passes;
    if (i + 1 < passes.size() && passes[i].IsOn(passes[i + 1])) continue;
    if (sum != 0) return false;
  }
  return true;
}

bool IsClosed(const TriangleMesh& mesh, const std::vector<std::uint32_t>& merged) {
  std::vector<EdgePass> passes;
  passes.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = merged[t[i]], to = merged[t[(i + 1) % 3]];
      // An edge from a position to itself counts both ways at once.
      if (from < to) passes.push_back({from, to, 1});
      if (to < from) passes.push_back({to, from, -1});
    }
  }
  return SumsToZero(std::move(passes));
}

/// Disjoint sets of vertices, each named by one of its members.
class Components {
 public:
  Components(const TriangleMesh& mesh, const std::vector<std::uint32_t>& merged) : of_(merged) {
    for (const Triangle& t : mesh.triangles) {
      Unite(t[0], t[1]);
      Unite(t[1], t[2]);
    }
  }

  std::uint32_t Of(std::uint32_t vertex) {
    // Each step also halves the path for later look-ups.
    while (of_[vertex] != of_[of_[vertex]]) vertex = of_[vertex] = of_[of_[vertex]];
    return of_[vertex];
  }

 private:
  void Unite(std::uint32_t a, std::uint32_t b) { of_[Of(a)] = Of(b); }

  std::vector<std::uint32_t> of_;
};

}  // namespace

std::vector<std::uint32_t> MergedVertices(const TriangleMesh& mesh) {
  const auto& vertices = mesh.vertices;
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return vertices[a] != vertices[b] ? LexicographicallyLess(vertices[a], vertices[b]) : a < b;
  });
  std::vector<std::uint32_t> merged(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_new = i == 0 || vertices[order[i]] != vertices[order[i - 1]];
    merged[order[i]] = is_new ? order[i] : merged[order[i - 1]];
  }
  return merged;
}

std::vector<Vector3d> ComponentPoints(const TriangleMesh& mesh) {
  CORE_CHECK(IsWellFormed(mesh), "components are those of a well-formed mesh",
             mesh.triangles.size());
  Components components(mesh, MergedVertices(mesh));
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> place(mesh.vertices.size(), kNone);
  std::vector<Vector3d> points;
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t component = components.Of(t[0]);
    if (place[component] == kNone) {
      place[component] = static_cast<std::uint32_t>(points.size());
      points.push_back(mesh.vertices[t[0]]);
    }
    Vector3d& point = points[place[component]];
    for (const std::uint32_t corner : t) {
      if (LexicographicallyLess(point, mesh.vertices[corner])) point = mesh.vertices[corner];
    }
  }
  return points;
}

MeshFacts FactsOf(const TriangleMesh& mesh) {
  CORE_CHECK(IsWellFormed(mesh), "facts are those of a well-formed mesh", mesh.triangles.size());
  const auto merged = MergedVertices(mesh);
  MeshFacts facts;
  facts.closed = IsClosed(mesh, merged);
  facts.components = ComponentPoints(mesh).size();
  facts.lower = facts.upper = mesh.vertices[mesh.triangles[0][0]];
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) {
      const Vector3d& p = mesh.vertices[corner];
      facts.lower = facts.lower.cwiseMin(p);
      facts.upper = facts.upper.cwiseMax(p);
      facts.radius = std::max(facts.radius, numeric::Norm(numeric::IntervalVector(p)).upper);
    }
  }
  return facts;
}

}  // namespace collision::geometry
