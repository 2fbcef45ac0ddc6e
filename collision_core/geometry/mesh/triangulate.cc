// Polygons become triangles: ear clipping with exact signs.
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "collision_core/base/check.h"
#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/numeric/exact_sign.h"

namespace collision::geometry {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// One face while it is cut into triangles. Signs are exact in the coordinate plane that the face
/// is most nearly parallel to; for a flat face, dropping a coordinate preserves which points lie
/// inside which triangles.
class EarClipper {
 public:
  EarClipper(const std::vector<Vector3d>& vertices, std::vector<std::uint32_t> corners)
      : corners_(std::move(corners)) {
    const Vector3d normal = Normal(vertices);
    int dropped = 0;
    normal.cwiseAbs().maxCoeff(&dropped);
    for (const std::uint32_t corner : corners_) {
      const Vector3d& p = vertices[corner];
      const double x = p[(dropped + 1) % 3], y = p[(dropped + 2) % 3];
      // Seen from the side on which it turns anticlockwise.
      points_.push_back(normal[dropped] >= 0 ? Vector2d(x, y) : Vector2d(y, x));
    }
  }

  void AppendTo(std::vector<Triangle>* triangles) {
    std::size_t at = 0;
    while (corners_.size() > 3) {
      at = NextEar(at);
      const std::size_t before = Before(at), after = After(at);
      triangles->push_back({corners_[before], corners_[at], corners_[after]});
      corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(at));
      points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(at));
      // `at` is now the next corner; cutting there too would make a fan of slivers.
      at = (at + 1) % corners_.size();
    }
    triangles->push_back({corners_[0], corners_[1], corners_[2]});
  }

 private:
  /// Newell's: the sum of the cross products along the boundary, also for faces not quite flat.
  Vector3d Normal(const std::vector<Vector3d>& vertices) const {
    const Vector3d& origin = vertices[corners_[0]];
    Vector3d normal = Vector3d::Zero();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      normal += (vertices[corners_[i]] - origin).cross(vertices[corners_[After(i)]] - origin);
    }
    return normal;
  }

  std::size_t Before(std::size_t i) const { return (i == 0 ? corners_.size() : i) - 1; }
  std::size_t After(std::size_t i) const { return i + 1 == corners_.size() ? 0 : i + 1; }

  /// The first ear at or after `from`; where there is none (the polygon crosses itself), `from`:
  /// any triangle cut off keeps the boundary of the whole, and so whether the mesh is closed.
  std::size_t NextEar(std::size_t from) const {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const std::size_t at = (from + i) % corners_.size();
      if (IsEar(at)) return at;
    }
    return from;
  }

  bool IsEar(std::size_t at) const {
    const Vector2d &a = points_[Before(at)], &b = points_[at], &c = points_[After(at)];
    if (numeric::OrientationSign(a, b, c) != 1) return false;
    return std::none_of(points_.begin(), points_.end(), [&](const Vector2d& p) {
      return p != a && p != b && p != c && numeric::OrientationSign(a, b, p) != -1 &&
             numeric::OrientationSign(b, c, p) != -1 && numeric::OrientationSign(c, a, p) != -1;
    });
  }

  std::vector<std::uint32_t> corners_;
  std::vector<Vector2d> points_;
};

/// The corners of a face without those at the same position as the one before.
std::vector<std::uint32_t> DistinctCorners(const PolygonMesh& polygons, std::size_t first,
                                           std::size_t size) {
  const auto& vertices = polygons.vertices;
  std::vector<std::uint32_t> corners;
  for (std::size_t i = first; i < first + size; ++i) {
    const std::uint32_t corner = polygons.corners[i];
    if (corners.empty() || vertices[corners.back()] != vertices[corner]) corners.push_back(corner);
  }
  while (corners.size() > 1 && vertices[corners.back()] == vertices[corners.front()])
    corners.pop_back();
  return corners;
}

}  // namespace

TriangleMesh Triangulate(const PolygonMesh& polygons, MeshRepair* repair) {
  CORE_CHECK(!RefusalOf(polygons, std::numeric_limits<std::size_t>::max()),
             "polygons that are cut were not refused", polygons.sizes.size());
  TriangleMesh mesh;
  mesh.vertices = polygons.vertices;
  std::size_t first = 0;
  for (const std::uint32_t size : polygons.sizes) {
    auto corners = DistinctCorners(polygons, first, size);
    first += size;
    if (corners.size() < 3) {
      ++repair->dropped;
      continue;
    }
    if (size > 3) ++repair->split;
    EarClipper(mesh.vertices, std::move(corners)).AppendTo(&mesh.triangles);
  }
  repair->dropped += DropDegenerate(&mesh);
  return mesh;
}

}  // namespace collision::geometry
