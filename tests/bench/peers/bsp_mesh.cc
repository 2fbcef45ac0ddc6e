// Hubbard's exact comparison, as a baseline beside the libraries.
#include <memory>

#include "tests/baselines/bsp_tree.h"
#include "tests/bench/pairs/peers.h"
#include "tests/bench/pairs/pose.h"

namespace collision::bench {
namespace {

/// It visits every face of both: larger meshes would take most of the run.
constexpr std::size_t kTrianglesMax = 1000;

geometry::TriangleMesh MeshOf(const PlainMesh& plain) {
  geometry::TriangleMesh mesh;
  for (const auto& p : plain.vertices) mesh.vertices.emplace_back(p[0], p[1], p[2]);
  mesh.triangles = plain.triangles;
  return mesh;
}

}  // namespace

PairMethods BspMesh(const PlainMesh& mesh) {
  if (mesh.triangles.size() > kTrianglesMax) return {};
  const auto tree = std::make_shared<baselines::BspTree>(MeshOf(mesh));
  const auto ask = [tree](const PlainPose& at) {
    return Plain(baselines::BspTree::Intersect(*tree, *tree, RotationOf(at), OffsetOf(at)));
  };
  return {{.name = "BSP trees",
           .task = Task::kDecision,
           .origin = Origin::kBaseline,
           .limited_by = "plain doubles with a tolerance of 1e-12 of the size",
           .ask = ask}};
}

}  // namespace collision::bench
