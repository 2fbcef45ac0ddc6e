// A mesh as shaded cells, so that its picture is small for any number of triangles.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"

namespace collision::client {

/// Positions in the picture, in cells: to the right, down, and towards the viewer.
struct View {
  Eigen::Matrix3d axes;    ///< Rows: right, down, towards, in the body frame; unit vectors.
  Eigen::Vector2d corner;  ///< Of the body frame along the first two, at the top left [m].
  double cells_per_metre = 1;
  int columns = 1, rows = 1;

  Eigen::Vector3d Cell(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = axes * p;
    return {(q.x() - corner.x()) * cells_per_metre, (q.y() - corner.y()) * cells_per_metre,
            q.z() * cells_per_metre};
  }
};

inline constexpr int kTones = 12;

/// The tone of each cell, row by row: 0 for an empty one, else 1 (dark) to kTones (light).
std::vector<std::uint8_t> Shaded(const geometry::TriangleMesh& mesh, const View& view);

}  // namespace collision::client
