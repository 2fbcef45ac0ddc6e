#include "tests/baselines/bsp_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>

namespace collision::baselines {
namespace {

constexpr std::int32_t kInside = -1, kOutside = -2;

/// A share of the mesh's largest coordinate.
constexpr double kToleranceShare = 1e-12;

/// Faces tried for a cut, and what a split face costs beside one too many on one side.
constexpr std::size_t kCandidates = 12;
constexpr std::size_t kSplitCost = 6;

}  // namespace

BspTree::BspTree(const geometry::TriangleMesh& mesh) {
  double largest = 0;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  tolerance_ = kToleranceShare * largest;
  std::vector<Face> faces;
  for (const geometry::Triangle& t : mesh.triangles) {
    Face face;
    for (const std::uint32_t v : t) face.polygon.push_back(mesh.vertices[v]);
    const auto& p = face.polygon;
    face.plane.normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    face.plane.offset = face.plane.normal.dot(p[0]);
    faces_.push_back(p);
    faces.push_back(std::move(face));
  }
  root_ = Build(std::move(faces), kOutside);
}

BspTree::Side BspTree::SideOf(const Polygon& polygon, const Plane& plane) const {
  bool front = false, back = false;
  for (const Eigen::Vector3d& p : polygon) {
    const double height = plane.HeightOf(p);
    front = front || height > tolerance_;
    back = back || height < -tolerance_;
  }
  if (front) return back ? Side::kBoth : Side::kFront;
  return back ? Side::kBack : Side::kOn;
}

void BspTree::Split(const Polygon& polygon, const Plane& plane, Polygon* front, Polygon* back) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double of_p = plane.HeightOf(p), of_q = plane.HeightOf(q);
    if (of_p >= 0) front->push_back(p);
    if (of_p <= 0) back->push_back(p);
    if ((of_p > 0 && of_q < 0) || (of_p < 0 && of_q > 0)) {
      const Eigen::Vector3d cut = p + of_p / (of_p - of_q) * (q - p);
      front->push_back(cut);
      back->push_back(cut);
    }
  }
}

std::size_t BspTree::BestCut(const std::vector<Face>& faces) const {
  const std::size_t step = std::max<std::size_t>(1, faces.size() / kCandidates);
  std::size_t best = 0, least = static_cast<std::size_t>(-1);
  for (std::size_t candidate = step / 2; candidate < faces.size(); candidate += step) {
    std::ptrdiff_t balance = 0;
    std::size_t splits = 0;
    for (const Face& face : faces) {
      const Side side = SideOf(face.polygon, faces[candidate].plane);
      splits += side == Side::kBoth;
      balance += (side == Side::kFront) - (side == Side::kBack);
    }
    const std::size_t cost = kSplitCost * splits + static_cast<std::size_t>(std::abs(balance));
    if (cost < least) least = cost, best = candidate;
  }
  return best;
}

std::int32_t BspTree::Build(std::vector<Face> faces, std::int32_t if_empty) {
  if (faces.empty()) return if_empty;
  const Plane plane = faces[BestCut(faces)].plane;
  std::vector<Face> front, back;
  for (Face& face : faces) {
    switch (SideOf(face.polygon, plane)) {
      case Side::kOn:
        break;  // The cells on either side end there anyway.
      case Side::kFront:
        front.push_back(std::move(face));
        break;
      case Side::kBack:
        back.push_back(std::move(face));
        break;
      case Side::kBoth: {
        Face of_front{{}, face.plane}, of_back{{}, face.plane};
        Split(face.polygon, plane, &of_front.polygon, &of_back.polygon);
        front.push_back(std::move(of_front));
        back.push_back(std::move(of_back));
      }
    }
  }
  faces.clear();
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({plane, kOutside, kInside});
  const std::int32_t of_front = Build(std::move(front), kOutside);
  nodes_[index].front = of_front;
  const std::int32_t of_back = Build(std::move(back), kInside);
  nodes_[index].back = of_back;
  return index;
}

bool BspTree::ArrivesInside(Polygon polygon, std::int32_t node) const {
  while (node >= 0) {
    const Node& at = nodes_[node];
    switch (SideOf(polygon, at.plane)) {
      case Side::kFront:
        node = at.front;
        break;
      case Side::kBack:
        node = at.back;
        break;
      case Side::kOn:  // It touches both cells.
        if (ArrivesInside(polygon, at.front)) return true;
        node = at.back;
        break;
      case Side::kBoth: {
        Polygon front, back;
        Split(polygon, at.plane, &front, &back);
        if (ArrivesInside(std::move(front), at.front)) return true;
        polygon = std::move(back);
        node = at.back;
      }
    }
  }
  return node == kInside;
}

bool BspTree::Intersect(const BspTree& a, const BspTree& b, const Eigen::Matrix3d& rotation,
                        const Eigen::Vector3d& offset) {
  for (Polygon face : b.faces_) {
    for (Eigen::Vector3d& p : face) p = rotation * p + offset;
    if (a.ArrivesInside(std::move(face), a.root_)) return true;
  }
  for (Polygon face : a.faces_) {
    for (Eigen::Vector3d& p : face) p = rotation.transpose() * (p - offset);
    if (b.ArrivesInside(std::move(face), b.root_)) return true;
  }
  return false;
}

}  // namespace collision::baselines
