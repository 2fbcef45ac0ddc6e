// Two bodies of one mesh, and pairs of convex solids: every method over its settings.
#include <cstdio>

#include "tests/bench/measure.h"
#include "tests/bench/narrow_mesh.h"
#include "tests/bench/precision_cell.h"
#include "tests/bench/precision_convex.h"
#include "tests/bench/precision_ours.h"
#include "tests/bench/precision_truth.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kSeed = 21;
constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;

/// 500 and 5,856 triangles; in full 20,088 too.
std::vector<BenchMesh> Meshes(const PrecisionSettings& settings) {
  std::vector<BenchMesh> meshes = ContestMeshes(settings.data_dir, settings.quick);
  while (!meshes.empty() && meshes.back().mesh.triangles.size() > 30'000) meshes.pop_back();
  return meshes;
}

PairOracle OracleOf(const narrow_phase::BodySegment& body) {
  return {[body](const narrow_phase::RelativePose& pose) {
            WorkBudget work(kUnlimited);
            return narrow_phase::DecideAt(
                       {narrow_phase::BodyTree(body), narrow_phase::BodyTree(body), pose}, &work)
                .verdict;
          },
          [body](const narrow_phase::RelativePose& pose, double width) {
            WorkBudget work(kUnlimited);
            const narrow_phase::SeparationBracket look = narrow_phase::BracketSeparation(
                {narrow_phase::BodyTree(body), narrow_phase::BodyTree(body), pose}, {width, 0},
                &work);
            return numeric::Interval(look.lower, look.upper);
          }};
}

}  // namespace

void MeshesPart(const PrecisionSettings& settings, PrecisionReport* report) {
  KeepMemory();
  for (const BenchMesh& mesh : Meshes(settings)) {
    PrecisionRow any;
    any.part = "precision", any.mesh = mesh.name;
    const auto fitted =
        shape::Shape::Build(mesh.mesh, {.builder = sphere_tree::TreeBuilder::kFitted});
    PrecisionMethods methods = OurMeshMethods({fitted, shape::Shape::Build(mesh.mesh)});
    Append(MeshPeers(PlainOf(mesh.mesh)), &methods);
    const MeshTruth truth(mesh.mesh);
    for (const Motion motion : kMotions) {
      if (!WantsAny(settings, motion, mesh.name, methods)) continue;
      PrecisionCell cell{motion, mesh.name, mesh.diameter(), {}};
      cell.poses = DrawPoses(
          OracleOf(BodyOf(fitted)),
          [&truth](const PlainPose& pose, double upper) { return truth.DistanceAt(pose, upper); },
          mesh.diameter(), motion, settings.poses(), kSeed);
      MeasureCell(settings, cell, methods, report);
    }
  }
}

PrecisionMethods ConvexPeers([[maybe_unused]] const PlainConvex& a,
                             [[maybe_unused]] const PlainConvex& b) {
  PrecisionMethods methods;
#ifdef COLLISION_HAS_FCL
  Append(FclConvexMethods(a, b), &methods);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletConvexMethods(a, b), &methods);
#endif
  return methods;
}

void ConvexesPart(const PrecisionSettings& settings, PrecisionReport* report) {
  const std::vector<PlainConvex> all = Convexes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = i; k < all.size(); ++k) {
      const PlainConvex &a = all[i], &b = all[k];
      const std::string name = a.name + " and " + b.name;
      const geometry::ConvexPair pair{SolidOf(a), SolidOf(b)};
      PrecisionMethods methods = OurConvexMethods(pair);
      Append(ConvexPeers(a, b), &methods);
      for (const Motion motion : kMotions) {
        if (!WantsAny(settings, motion, name, methods)) continue;
        PrecisionCell cell{motion, name, 2, {}};
        cell.poses = DrawPoses(
            OracleOf(pair),
            [&](const PlainPose& pose, double) { return ConvexTruthAt(a, b, pose); }, 2, motion,
            settings.poses(), kSeed);
        MeasureCell(settings, cell, methods, report);
      }
    }
  }
}

}  // namespace collision::bench
