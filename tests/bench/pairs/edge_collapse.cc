#include "tests/bench/pairs/edge_collapse.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <queue>
#include <set>

namespace collision::bench {
namespace {

/// The normal before and after: their cosine is at least this.
constexpr double kTurnCosineMin = 0.17;

struct Edge {
  double length;
  std::uint32_t a, b;  ///< a < b.
  std::uint32_t stamps[2];

  bool operator<(const Edge& other) const {
    if (length != other.length) return length > other.length;
    return std::pair(a, b) > std::pair(other.a, other.b);
  }
};

class Collapse {
 public:
  explicit Collapse(const geometry::TriangleMesh& mesh)
      : mesh_(mesh), around_(mesh.vertices.size()), stamps_(mesh.vertices.size()) {
    left_ = mesh_.triangles.size();
    gone_.resize(left_);
    for (std::uint32_t t = 0; t < left_; ++t) {
      for (const std::uint32_t v : mesh_.triangles[t]) around_[v].insert(t);
    }
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) OfferEdges(v, true);
  }

  geometry::TriangleMesh Down(std::size_t triangles) {
    while (left_ > triangles && !edges_.empty()) {
      const Edge edge = edges_.top();
      edges_.pop();
      if (edge.stamps[0] != stamps_[edge.a] || edge.stamps[1] != stamps_[edge.b]) continue;
      if (MayGo(edge)) Merge(edge);
    }
    geometry::TriangleMesh result{mesh_.vertices, {}};
    for (std::size_t t = 0; t < gone_.size(); ++t) {
      if (!gone_[t]) result.triangles.push_back(mesh_.triangles[t]);
    }
    return result;
  }

 private:
  std::set<std::uint32_t> Neighbours(std::uint32_t v) const {
    std::set<std::uint32_t> neighbours;
    for (const std::uint32_t t : around_[v]) {
      neighbours.insert(mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    }
    neighbours.erase(v);
    return neighbours;
  }

  void OfferEdges(std::uint32_t v, bool upwards_only) {
    for (const std::uint32_t w : Neighbours(v)) {
      if (upwards_only && w < v) continue;
      const auto [a, b] = std::minmax(v, w);
      edges_.push({(mesh_.vertices[a] - mesh_.vertices[b]).norm(), a, b, {stamps_[a], stamps_[b]}});
    }
  }

  Eigen::Vector3d NormalWith(std::uint32_t t, const Edge* edge,
                             const Eigen::Vector3d& middle) const {
    Eigen::Vector3d corners[3];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh_.triangles[t][k];
      corners[k] = edge && (v == edge->a || v == edge->b) ? middle : mesh_.vertices[v];
    }
    return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  }

  bool MayGo(const Edge& edge) const {
    const auto of_a = Neighbours(edge.a), of_b = Neighbours(edge.b);
    std::vector<std::uint32_t> both;
    std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                          std::back_inserter(both));
    if (both.size() != 2) return false;
    const Eigen::Vector3d middle = 0.5 * (mesh_.vertices[edge.a] + mesh_.vertices[edge.b]);
    for (const std::uint32_t end : {edge.a, edge.b}) {
      for (const std::uint32_t t : around_[end]) {
        if (around_[edge.a].count(t) && around_[edge.b].count(t)) continue;
        const auto before = NormalWith(t, nullptr, middle), after = NormalWith(t, &edge, middle);
        if (!(before.dot(after) >= kTurnCosineMin)) return false;
      }
    }
    return true;
  }

  void Merge(const Edge& edge) {
    mesh_.vertices[edge.a] = 0.5 * (mesh_.vertices[edge.a] + mesh_.vertices[edge.b]);
    for (const std::uint32_t t : std::set<std::uint32_t>(around_[edge.b])) {
      geometry::Triangle& triangle = mesh_.triangles[t];
      if (around_[edge.a].count(t)) {
        for (const std::uint32_t v : triangle) around_[v].erase(t);
        gone_[t] = true, --left_;
        continue;
      }
      std::replace(triangle.begin(), triangle.end(), edge.b, edge.a);
      around_[edge.a].insert(t);
    }
    around_[edge.b].clear();
    ++stamps_[edge.a], ++stamps_[edge.b];
    OfferEdges(edge.a, false);
  }

  geometry::TriangleMesh mesh_;
  std::vector<std::set<std::uint32_t>> around_;  ///< Triangles of a vertex.
  std::vector<std::uint32_t> stamps_;            ///< Of a vertex: an edge of an older one is stale.
  std::vector<bool> gone_;
  std::size_t left_ = 0;
  std::priority_queue<Edge> edges_;
};

}  // namespace

geometry::TriangleMesh Collapsed(const geometry::TriangleMesh& mesh, std::size_t triangles) {
  return Collapse(mesh).Down(triangles);
}

}  // namespace collision::bench
