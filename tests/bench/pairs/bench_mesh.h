// The closed meshes that the narrow phase is measured on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "tests/bench/pairs/method.h"

namespace collision::bench {

/// The middle of its box is the reference point; its radius about that is 1 m.
struct BenchMesh {
  std::string name;
  geometry::TriangleMesh mesh;

  double diameter() const { return 2; }  ///< Of the bounding ball [m].
};

PlainMesh PlainOf(const geometry::TriangleMesh& mesh);

/// One file of the data folder, merged at equal positions, centred and scaled; nullopt: not there.
std::optional<BenchMesh> ReadBenchMesh(const std::string& data_dir, const std::string& name);

/// The contest's: about 500 triangles (homer, edges collapsed), 5k (spot), 20k (rocker-arm) and 80k
/// (rocker-arm, each triangle in four); those that the folder has.
std::vector<BenchMesh> ContestMeshes(const std::string& data_dir, bool quick);

/// False: none of them is there, which is printed as an error.
bool HasContestMeshes(const std::string& data_dir);

/// Every closed mesh of the folder, as it is.
std::vector<BenchMesh> ClosedMeshes(const std::string& data_dir);

}  // namespace collision::bench
