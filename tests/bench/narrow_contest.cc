// Two bodies of one mesh, posed: yes or no, how far, and within what.
#include <algorithm>

#include "tests/bench/measure.h"
#include "tests/bench/narrow_cell.h"
#include "tests/bench/narrow_ours.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kSeed = 5;

NarrowQueries AllQueries(const BenchMesh& mesh, const std::shared_ptr<const shape::Shape>& shape) {
  NarrowQueries queries = OurQueries(shape, mesh.diameter(), "ours", Who::kOurs);
  const auto append = [&queries](NarrowQueries more) {
    for (NarrowQuery& query : more) queries.push_back(std::move(query));
  };
  append(OurQueries(shape::Shape::Build(mesh.mesh), mesh.diameter(), "ours, octree", Who::kOther));
  append(PeerQueries(PlainOf(mesh.mesh)));
  return queries;
}

}  // namespace

void ContestPart(const NarrowSettings& settings, NarrowReport* report) {
  KeepMemory();
  for (const BenchMesh& mesh : ContestMeshes(settings.data_dir, settings.quick)) {
    const auto shape =
        shape::Shape::Build(mesh.mesh, {.builder = sphere_tree::TreeBuilder::kFitted});
    NarrowQueries queries;
    for (const GapClass& gap : GapClasses()) {
      Cell cell{"", mesh.name, mesh.mesh.triangles.size(), mesh.diameter(), gap};
      const auto is_wanted = [&](const NarrowQuery& query) {
        return Wanted(settings, RowOf(cell, query));
      };
      // Trees of all contestants take time: only where one is wanted.
      if (queries.empty()) queries = AllQueries(mesh, shape);
      NarrowQueries wanted;
      std::copy_if(queries.begin(), queries.end(), std::back_inserter(wanted), is_wanted);
      if (wanted.empty()) continue;
      cell.sample = SamplePoses(shape, mesh.diameter(), gap, settings.poses(), kSeed);
      if (cell.sample.poses.empty()) continue;
      for (const PlainPose& pose : cell.sample.poses) {
        cell.distances.push_back(queries[1].ask(pose));
      }
      Measure(settings, cell, wanted, report);
    }
  }
}

}  // namespace collision::bench
