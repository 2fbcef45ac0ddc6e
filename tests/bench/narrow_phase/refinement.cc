// Many pairs that share a budget: level by level, as in the paper, beside the largest contribution
// first.
#include "collision_core/narrow_phase/separation/refinement.h"

#include <algorithm>
#include <cmath>

#include "tests/bench/harness/measure.h"
#include "tests/bench/narrow_phase/parts.h"
#include "tests/bench/pairs/pose.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kSeed = 11;
constexpr std::size_t kPosesEach = 10;
constexpr narrow_phase::BracketTolerance kNarrow = {0, 1e-6};
/// Units for each pair.
constexpr std::uint64_t kBudgets[] = {4, 16, 64, 256, 1024, 4096};

/// Bodies of one shape at poses of all gap classes.
struct Scene {
  explicit Scene(const BenchMesh& mesh)
      : body(
            BodyOf(shape::Shape::Build(mesh.mesh, {.builder = sphere_tree::TreeBuilder::kFitted}))),
        surface(body) {
    const PairOracle oracle = OracleOf(body.shape);
    for (const GapClass& gap : GapClasses()) {
      const auto sample = SamplePoses(oracle, mesh.diameter(), gap, kPosesEach, kSeed);
      for (const PlainPose& pose : sample.poses) poses.push_back(PoseOf(pose));
    }
  }

  const narrow_phase::BodySegment body;
  const narrow_phase::BodyTree surface;
  std::vector<narrow_phase::RelativePose> poses;
};

struct Shared {
  double total = 0, widest = 0;  ///< Of the brackets [m].
  std::uint64_t coarse = 0;      ///< Pairs left so.
  std::uint64_t spent = 0;
  double seconds = 0;
};

Shared Refine(const Scene& scene, narrow_phase::RefinementOrder order, std::uint64_t units,
              NumberHash* hash) {
  narrow_phase::Refinement refinement(order);
  WorkBudget work(units * scene.poses.size());
  for (const narrow_phase::RelativePose& pose : scene.poses) {
    refinement.Add({scene.surface, scene.surface, pose}, 1, narrow_phase::Goal::kDecision, kNarrow,
                   &work);
  }
  const double start = CpuNow();
  refinement.Refine(&work);
  Shared shared;
  shared.seconds = CpuNow() - start;
  shared.total = refinement.TotalWidth();
  shared.coarse = refinement.Coarse().size();
  shared.spent = work.spent();
  for (std::size_t pair = 0; pair < refinement.size(); ++pair) {
    const narrow_phase::RefinedPair at = refinement.At(pair);
    hash->Add(at.lower), hash->Add(at.upper);
    if (!at.done) shared.widest = std::max(shared.widest, at.upper - at.lower);
  }
  return shared;
}

}  // namespace

void RefinementPart(const NarrowSettings& settings, NarrowReport* report) {
  for (const BenchMesh& mesh : ContestMeshes(settings.data_dir, true)) {
    const NarrowRow row = RowOf("refinement", mesh, "ours");
    if (!settings.Wants(row.path())) continue;
    const Scene scene(mesh);
    for (const std::uint64_t units : kBudgets) {
      NumberHash hash;
      const Shared level =
          Refine(scene, narrow_phase::RefinementOrder::kLevelByLevel, units, &hash);
      const Shared largest =
          Refine(scene, narrow_phase::RefinementOrder::kLargestFirst, units, &hash);
      NarrowRow of_budget = row;
      of_budget.gap = std::to_string(units) + " units";
      of_budget.warm = largest.seconds;
      of_budget.hash = hash.text();
      of_budget.remark = "a pair; widths in all, by level " + Format("%.3g m", level.total) +
                         ", largest first " + Format("%.3g m", largest.total) + "; left coarse " +
                         std::to_string(level.coarse) + " and " + std::to_string(largest.coarse) +
                         " of " + std::to_string(scene.poses.size());
      of_budget.more = {Number("level_total_m", level.total),
                        Number("largest_total_m", largest.total),
                        Number("level_widest_m", level.widest),
                        Number("largest_widest_m", largest.widest),
                        Number("level_spent", static_cast<double>(level.spent)),
                        Number("largest_spent", static_cast<double>(largest.spent))};
      report->Add(std::move(of_budget));
      if (level.total > 0) {
        report->FigureGreatest("refinement_largest_vs_level_total_worst",
                               largest.total / level.total);
      }
    }
  }
}

}  // namespace collision::bench
