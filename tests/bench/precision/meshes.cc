// Two bodies of one mesh, and pairs of convex solids: every method over its settings.
#include "tests/bench/harness/measure.h"
#include "tests/bench/pairs/bench_mesh.h"
#include "tests/bench/pairs/ours.h"
#include "tests/bench/pairs/peers.h"
#include "tests/bench/precision/cell.h"
#include "tests/support/truth/exact_surfaces.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kSeed = 21;

/// 500 and 5,856 triangles; in full 20,088 too.
std::vector<BenchMesh> Meshes(const PrecisionSettings& settings) {
  std::vector<BenchMesh> meshes = ContestMeshes(settings.data_dir, settings.quick);
  while (!meshes.empty() && meshes.back().mesh.triangles.size() > 30'000) meshes.pop_back();
  return meshes;
}

}  // namespace

void MeshesPart(const PrecisionSettings& settings, PrecisionReport* report) {
  KeepMemory();
  for (const BenchMesh& mesh : Meshes(settings)) {
    const auto fitted =
        shape::Shape::Build(mesh.mesh, {.builder = sphere_tree::TreeBuilder::kFitted});
    PairMethods methods = OurMeshCurves({fitted, shape::Shape::Build(mesh.mesh)});
    Append(MeshPeerCurves(PlainOf(mesh.mesh)), &methods);
    const MeshTruth truth(mesh.mesh);
    for (const Motion motion : kMotions) {
      if (!WantsAny(settings, motion, mesh.name, methods)) continue;
      PrecisionCell cell{motion, mesh.name, mesh.diameter(), {}};
      cell.poses = DrawPoses(
          OracleOf(fitted),
          [&truth](const PlainPose& pose, double upper) {
            return truth.DistanceAt(RotationOf(pose), OffsetOf(pose), upper);
          },
          mesh.diameter(), motion, settings.poses(), kSeed);
      MeasureCell(settings, cell, methods, report);
    }
  }
}

void ConvexesPart(const PrecisionSettings& settings, PrecisionReport* report) {
  const std::vector<PlainConvex> all = Convexes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = i; k < all.size(); ++k) {
      const PlainConvex &a = all[i], &b = all[k];
      const std::string name = a.name + " and " + b.name;
      const geometry::ConvexPair pair{SolidOf(a), SolidOf(b)};
      PairMethods methods = OurConvexCurves(pair);
      Append(ConvexPeerCurves(a, b), &methods);
      for (const Motion motion : kMotions) {
        if (!WantsAny(settings, motion, name, methods)) continue;
        PrecisionCell cell{motion, name, 2, {}};
        cell.poses = DrawPoses(
            OracleOf(pair),
            [&](const PlainPose& pose, double) {
              return ConvexDistanceAt(DescriptionOf(a), DescriptionOf(b),
                                      PlacementOf(RotationOf(pose), OffsetOf(pose)));
            },
            2, motion, settings.poses(), kSeed);
        MeasureCell(settings, cell, methods, report);
      }
    }
  }
}

}  // namespace collision::bench
