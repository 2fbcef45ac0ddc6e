#include "client/checker/shape/mesh.h"

#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace collision::checker {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;

Vector Centroid(const Triangle& t) { return (1.0 / 3) * (t[0] + t[1] + t[2]); }

// The connected part that each vertex belongs to; edges join parts.
class ConnectedParts {
 public:
  explicit ConnectedParts(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::uint32_t Of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::uint32_t i, std::uint32_t k) { parent_[Of(i)] = Of(k); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

Mesh::Mesh(std::vector<Vector> vertices, const std::vector<std::array<std::uint32_t, 3>>& indices)
    : vertices_(std::move(vertices)) {
  for (const Vector& v : vertices_) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
      throw std::runtime_error("a coordinate is not finite");
  }
  std::vector<std::array<std::uint32_t, 3>> kept;
  for (const auto& face : indices) {
    for (const std::uint32_t i : face) {
      if (i < vertices_.size()) continue;
      throw std::runtime_error("index " + std::to_string(i) + " is not below the " +
                               std::to_string(vertices_.size()) + " vertices");
    }
    const Triangle t = {vertices_[face[0]], vertices_[face[1]], vertices_[face[2]]};
    if (Squared(Cross(t[1] - t[0], t[2] - t[0])) == 0) continue;
    kept.push_back(face);
    triangles_.push_back(t);
    for (const Vector& v : t) radius_m_ = std::max(radius_m_, Length(v));
  }
  if (triangles_.empty()) throw std::runtime_error("no triangle has an area");
  FindEdges(kept);
  nodes_.resize(1);
  Build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

Mesh Mesh::OfSegment(const Vector& from, const Vector& to) {
  Mesh mesh;
  mesh.vertices_ = {from, to};
  mesh.triangles_ = {{from, to, to}};
  mesh.part_points_ = {from};
  mesh.radius_m_ = std::max(Length(from), Length(to));
  mesh.nodes_.resize(1);
  mesh.Build(0, 0, 1);
  return mesh;
}

void Mesh::FindEdges(const std::vector<std::array<std::uint32_t, 3>>& indices) {
  std::map<std::tuple<double, double, double>, std::uint32_t> places;
  std::vector<std::uint32_t> place(vertices_.size());
  for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
    const Vector& v = vertices_[i];
    place[i] = places.try_emplace({v.x, v.y, v.z}, i).first->second;
  }
  ConnectedParts parts(vertices_.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passes;
  for (const auto& face : indices) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = place[face[k]], to = place[face[(k + 1) % 3]];
      parts.Join(from, to);
      passes[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  closed_ = std::all_of(passes.begin(), passes.end(), [](const auto& e) { return e.second == 0; });
  std::map<std::uint32_t, Vector> points;
  for (const auto& face : indices) points.try_emplace(parts.Of(place[face[0]]), vertices_[face[0]]);
  for (const auto& [part, point] : points) part_points_.push_back(point);
}

void Mesh::Build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  const auto begin = triangles_.begin() + first;
  Vector lower = (*begin)[0], upper = lower;
  for (auto t = begin; t != begin + count; ++t) {
    for (const Vector& v : *t) {
      lower = LeastOf(lower, v);
      upper = GreatestOf(upper, v);
    }
  }
  nodes_[node].centre = 0.5 * (lower + upper);
  nodes_[node].half = 0.5 * (upper - lower);
  if (count <= kLeafTriangles) {
    nodes_[node].first = first;
    nodes_[node].triangles = count;
    return;
  }
  const Vector size = upper - lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](const Triangle& s, const Triangle& t) {
    return Centroid(s)[axis] < Centroid(t)[axis];
  });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].child = child;
  nodes_.resize(nodes_.size() + 2);
  Build(child, first, half);
  Build(child + 1, first + half, count - half);
}

int Mesh::WindingNumber(const Vector& point) const {
  double angle = 0;
  for (const Triangle& t : triangles_) {
    const Vector a = t[0] - point, b = t[1] - point, c = t[2] - point;
    const double la = Length(a), lb = Length(b), lc = Length(c);
    angle += 2 * std::atan2(Dot(a, Cross(b, c)),
                            la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb);
  }
  return static_cast<int>(std::lround(angle / (4 * std::numbers::pi)));
}

bool Mesh::Contains(const Vector& point) const {
  if (!closed_) return false;
  const Node& root = nodes_[0];
  const Vector d = point - root.centre;
  if (std::fabs(d.x) > root.half.x || std::fabs(d.y) > root.half.y || std::fabs(d.z) > root.half.z)
    return false;
  return WindingNumber(point) != 0;
}

}  // namespace collision::checker
