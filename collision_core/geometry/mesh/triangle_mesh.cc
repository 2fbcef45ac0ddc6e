#include "collision_core/geometry/mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "collision_core/base/number_text.h"
#include "collision_core/numeric/exact_sign.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;
using Refusal = std::optional<std::string>;

std::string Text(double x) { return NumberText(x); }

std::string Text(std::size_t n) { return std::to_string(n); }

Refusal RefusalOfCount(std::size_t triangles, std::size_t triangles_max) {
  if (triangles == 0) return "mesh.triangles: there are none; at least 1 is needed";
  if (triangles <= triangles_max) return std::nullopt;
  return "mesh.triangles: " + Text(triangles) + " of them; at most " + Text(triangles_max) +
         " are allowed";
}

Refusal RefusalOfCoordinate(std::size_t vertex, int axis, double x) {
  if (std::isfinite(x) && std::abs(x) <= kMeshReachMax) return std::nullopt;
  return "mesh.vertices[" + Text(vertex) + "]." + "xyz"[axis] + " is " + Text(x) +
         "; allowed are finite values within ±" + Text(kMeshReachMax) + " m";
}

Refusal RefusalOfVertices(std::span<const Vector3d> vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (auto refusal = RefusalOfCoordinate(i, axis, vertices[i][axis])) return refusal;
    }
  }
  return std::nullopt;
}

Refusal RefusalOfIndex(const char* list, std::size_t at, std::uint32_t index,
                       std::size_t vertices) {
  if (index < vertices) return std::nullopt;
  return std::string("mesh.") + list + "[" + Text(at) + "] names vertex " +
         Text(std::size_t{index}) + "; allowed are 0 to " +
         (vertices == 0 ? "none: there are no vertices" : Text(vertices - 1));
}

/// The box of the vertices that a face uses: others are not part of the surface.
class Extent {
 public:
  void Add(const Vector3d& p) {
    lower_ = lower_.cwiseMin(p);
    upper_ = upper_.cwiseMax(p);
  }

  Refusal refusal() const {
    const double size = (upper_ - lower_).norm();
    if (size >= kMeshSizeMin && size <= kMeshSizeMax) return std::nullopt;
    return "mesh.vertices: the diagonal of their box is " + Text(size) + " m; allowed are " +
           Text(kMeshSizeMin) + " to " + Text(kMeshSizeMax) +
           " m (most likely the unit is not the one meant)";
  }

 private:
  Vector3d lower_ = Vector3d::Constant(HUGE_VAL), upper_ = Vector3d::Constant(-HUGE_VAL);
};

/// Checks that the sizes of the faces add up to the list of corners, and that no face has too many.
Refusal RefusalOfFaces(const PolygonMesh& mesh, std::size_t triangles_max) {
  std::size_t corners = 0, triangles = 0;
  for (std::size_t i = 0; i < mesh.sizes.size(); ++i) {
    const std::size_t size = mesh.sizes[i];
    if (size > kPolygonCornersMax) {
      return "mesh.sizes[" + Text(i) + "] is " + Text(size) + "; a face has at most " +
             Text(kPolygonCornersMax) + " corners";
    }
    corners += size;
    triangles += size < 3 ? 0 : size - 2;
  }
  if (corners != mesh.corners.size()) {
    return "mesh.sizes add up to " + Text(corners) + " corners, mesh.corners has " +
           Text(mesh.corners.size()) + "; both must be the same";
  }
  return RefusalOfCount(triangles, triangles_max);
}

bool HasArea(const TriangleMesh& mesh, const Triangle& t) {
  return !numeric::IsCertainlyCollinear(mesh.vertices[t[0]], mesh.vertices[t[1]],
                                        mesh.vertices[t[2]]);
}

}  // namespace

Refusal RefusalOf(const TriangleMesh& mesh, std::size_t triangles_max) {
  if (auto refusal = RefusalOfCount(mesh.triangles.size(), triangles_max)) return refusal;
  if (auto refusal = RefusalOfVertices(mesh.vertices)) return refusal;
  Extent extent;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t index : mesh.triangles[i]) {
      if (auto refusal = RefusalOfIndex("triangles", i, index, mesh.vertices.size()))
        return refusal;
      extent.Add(mesh.vertices[index]);
    }
  }
  return extent.refusal();
}

bool IsWellFormed(const TriangleMesh& mesh) {
  return !mesh.triangles.empty() &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& triangle) {
           return *std::max_element(triangle.begin(), triangle.end()) < mesh.vertices.size();
         });
}

Refusal RefusalOf(const PolygonMesh& mesh, std::size_t triangles_max) {
  if (auto refusal = RefusalOfFaces(mesh, triangles_max)) return refusal;
  if (auto refusal = RefusalOfVertices(mesh.vertices)) return refusal;
  Extent extent;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const std::uint32_t index = mesh.corners[i];
    if (auto refusal = RefusalOfIndex("corners", i, index, mesh.vertices.size())) return refusal;
    extent.Add(mesh.vertices[index]);
  }
  return extent.refusal();
}

std::size_t DropDegenerate(TriangleMesh* mesh) {
  const auto is_degenerate = [&](const Triangle& t) { return !HasArea(*mesh, t); };
  return std::erase_if(mesh->triangles, is_degenerate);
}

}  // namespace collision::geometry
