// Hubbard's exact comparison, as a baseline beside the libraries.
#include <memory>

#include "tests/baselines/bsp_tree.h"
#include "tests/bench/narrow_query.h"

namespace collision::bench {
namespace {

/// It looks at every face of both: beyond, it would only take the others' time.
constexpr std::size_t kTrianglesMax = 1000;

geometry::TriangleMesh MeshOf(const PlainMesh& plain) {
  geometry::TriangleMesh mesh;
  for (const auto& p : plain.vertices) mesh.vertices.emplace_back(p[0], p[1], p[2]);
  mesh.triangles = plain.triangles;
  return mesh;
}

}  // namespace

NarrowQueries BspQueries(const PlainMesh& mesh) {
  if (mesh.triangles.size() > kTrianglesMax) return {};
  const auto tree = std::make_shared<baselines::BspTree>(MeshOf(mesh));
  const auto ask = [tree](const PlainPose& at) {
    Eigen::Matrix3d rotation;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) rotation(i, j) = at.rotation[i][j];
    }
    const Eigen::Vector3d offset(at.offset[0], at.offset[1], at.offset[2]);
    return Plain(baselines::BspTree::Intersect(*tree, *tree, rotation, offset));
  };
  return {{"BSP trees", Task::kDecision, Who::kBaseline, ask}};
}

}  // namespace collision::bench
