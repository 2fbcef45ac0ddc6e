// A mesh with fewer triangles that is as closed as it was.
#pragma once

#include "collision_core/geometry/mesh/triangle_mesh.h"

namespace collision::bench {

/// Collapses edges to their middles, the shortest first, until at most `triangles` are left or no
/// edge may go. An edge may go where the mesh stays a manifold (the ends have just two neighbours
/// in common) and no triangle turns its normal by more than about 80 degrees. Requires a closed
/// manifold of one component with no two vertices in one place. Deterministic.
geometry::TriangleMesh Collapsed(const geometry::TriangleMesh& mesh, std::size_t triangles);

}  // namespace collision::bench
