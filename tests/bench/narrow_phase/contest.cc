// Two bodies of one mesh, posed: yes or no, the distance, and a bracket of it.
#include "tests/bench/harness/measure.h"
#include "tests/bench/narrow_phase/cell.h"
#include "tests/bench/pairs/ours.h"
#include "tests/bench/pairs/peers.h"

namespace collision::bench {
namespace {

PairMethods AllMethods(const BenchMesh& mesh, const std::shared_ptr<const shape::Shape>& shape) {
  PairMethods methods = OurMesh(shape, mesh.diameter(), "ours", Origin::kOurs);
  Append(OurMesh(shape::Shape::Build(mesh.mesh), mesh.diameter(), "ours, octree", Origin::kOther),
         &methods);
  Append(MeshPeers(PlainOf(mesh.mesh)), &methods);
  return methods;
}

}  // namespace

void ContestPart(const NarrowSettings& settings, NarrowReport* report) {
  KeepMemory();
  for (const BenchMesh& mesh : ContestMeshes(settings.data_dir, settings.quick)) {
    const auto shape =
        shape::Shape::Build(mesh.mesh, {.builder = sphere_tree::TreeBuilder::kFitted});
    const PairMethods methods = AllMethods(mesh, shape);
    for (const GapClass& gap : GapClasses()) {
      Cell cell{"", mesh.name, mesh.mesh.triangles.size(), mesh.diameter(), gap};
      const PairMethods wanted = WantedOf(settings, cell, methods);
      if (wanted.empty() || !DrawCell(settings, OracleOf(shape), methods[1], &cell)) continue;
      Measure(settings, cell, wanted, report);
    }
  }
}

}  // namespace collision::bench
