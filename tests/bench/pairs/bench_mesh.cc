#include "tests/bench/pairs/bench_mesh.h"

#include <cstdio>

#include "tests/bench/pairs/edge_collapse.h"
#include "tests/collision_core/sphere_tree/meshes.h"
#include "tests/support/obj.h"

namespace collision::bench {
namespace {

constexpr std::size_t kFew = 500;

void Normalise(geometry::TriangleMesh* mesh) {
  const geometry::MeshFacts facts = FactsOf(*mesh);
  const Eigen::Vector3d middle = 0.5 * (facts.lower + facts.upper);
  for (Eigen::Vector3d& p : mesh->vertices) p -= middle;
  const double radius = FactsOf(*mesh).radius;
  for (Eigen::Vector3d& p : mesh->vertices) p /= radius;
}

/// Only vertices that a triangle has, each position once: some libraries need that.
geometry::TriangleMesh Compact(const geometry::TriangleMesh& mesh) {
  constexpr auto kNone = static_cast<std::uint32_t>(-1);
  const auto merged = MergedVertices(mesh);
  std::vector<std::uint32_t> index(mesh.vertices.size(), kNone);
  geometry::TriangleMesh compact;
  for (geometry::Triangle t : mesh.triangles) {
    for (std::uint32_t& v : t) {
      std::uint32_t& known = index[merged[v]];
      if (known == kNone) {
        known = static_cast<std::uint32_t>(compact.vertices.size());
        compact.vertices.push_back(mesh.vertices[merged[v]]);
      }
      v = known;
    }
    compact.triangles.push_back(t);
  }
  return compact;
}

BenchMesh Made(const std::string& name, geometry::TriangleMesh mesh) {
  mesh = Compact(mesh);
  Normalise(&mesh);
  return {name, std::move(mesh)};
}

}  // namespace

PlainMesh PlainOf(const geometry::TriangleMesh& mesh) {
  PlainMesh plain;
  for (const Eigen::Vector3d& p : mesh.vertices) plain.vertices.push_back({p.x(), p.y(), p.z()});
  plain.triangles = mesh.triangles;
  return plain;
}

std::optional<BenchMesh> ReadBenchMesh(const std::string& data_dir, const std::string& name) {
  const geometry::PolygonMesh polygons = ReadObj(data_dir + "/meshes/" + name + ".obj");
  if (polygons.sizes.empty()) return std::nullopt;
  geometry::MeshRepair repair;
  return Made(name, Triangulate(polygons, &repair));
}

std::vector<BenchMesh> ContestMeshes(const std::string& data_dir, bool quick) {
  std::vector<BenchMesh> meshes;
  if (const auto homer = ReadBenchMesh(data_dir, "homer")) {
    meshes.push_back(Made("homer-500", Collapsed(homer->mesh, kFew)));
  }
  if (const auto spot = ReadBenchMesh(data_dir, "spot")) meshes.push_back(*spot);
  const auto rocker = ReadBenchMesh(data_dir, "rocker-arm");
  if (rocker && !quick) meshes.push_back(*rocker);
  if (rocker) meshes.push_back(Made("rocker-arm-80k", Subdivided(rocker->mesh, 1)));
  return meshes;
}

bool HasContestMeshes(const std::string& data_dir) {
  if (!ContestMeshes(data_dir, true).empty()) return true;
  std::fprintf(stderr, "bench: no meshes in '%s/meshes': homer, spot and rocker-arm are wanted\n",
               data_dir.c_str());
  return false;
}

std::vector<BenchMesh> ClosedMeshes(const std::string& data_dir) {
  std::vector<BenchMesh> closed;
  for (const char* name : {"cow", "fandisk", "homer", "rocker-arm", "spot"}) {
    auto mesh = ReadBenchMesh(data_dir, name);
    if (mesh && FactsOf(mesh->mesh).closed) closed.push_back(std::move(*mesh));
  }
  return closed;
}

}  // namespace collision::bench
