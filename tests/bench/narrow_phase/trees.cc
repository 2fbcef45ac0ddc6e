// The trees themselves: how well their balls fit, how long they take to build, and whether a budget
// is kept.
#include <algorithm>

#include "collision_core/narrow_phase/separation/separation.h"
#include "collision_core/sphere_tree/octree/octree_builder.h"
#include "collision_core/sphere_tree/tree_cut.h"
#include "tests/bench/harness/measure.h"
#include "tests/bench/narrow_phase/parts.h"
#include "tests/bench/pairs/peers.h"
#include "tests/bench/pairs/pose.h"
#include "tests/support/tree_coverage.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr std::size_t kCutMax = 700;
/// Of an octree: the next ones have more balls than that on any closed mesh of some size.
constexpr std::uint32_t kLevelsMax = 6;
/// The proof of one tree's coverage may take so long [s].
constexpr double kProofCutOff = 60;
constexpr sphere_tree::ShapeOptions kFitted{.builder = sphere_tree::TreeBuilder::kFitted};

/// The octree of the paper: each ball circumscribes its octant. Ours keeps the smaller of that
/// one and one about what the octant holds. Signed distances as deep as cuts are compared.
sphere_tree::SphereTree CircumscribedOctree(const BenchMesh& mesh, const shape::Shape& shape) {
  sphere_tree::SphereTree tree = sphere_tree::BuildCircumscribedOctree(mesh.mesh, {});
  for (sphere_tree::SphereNode& node : tree.nodes) {
    if (node.level > kLevelsMax) break;
    const numeric::Interval distance = shape.DistanceTo(node.centre);
    const bool inside = shape.WindingNumberAt(node.centre).value_or(0) != 0;
    node.signed_distance = inside ? -distance.lower : distance.upper;
  }
  return tree;
}

void CompareCuts(const BenchMesh& mesh, const sphere_tree::SphereTree& octree,
                 const sphere_tree::SphereTree& fitted, const std::string& reference_name,
                 const std::string& figure, NarrowReport* report) {
  for (std::uint32_t level = 1; level < std::min(octree.levels, kLevelsMax + 1); ++level) {
    const auto reference_cut = octree.Cut(level);
    if (reference_cut.size() > kCutMax) break;
    const sphere_tree::Overshoot reference = OvershootOf(octree, reference_cut);
    const auto cut = CutOfCount(fitted, reference_cut.size());
    const sphere_tree::Overshoot ours = OvershootOf(fitted, cut);
    const double mean = ours.mean / reference.mean, max = ours.max / reference.max;
    NarrowRow row = RowOf("trees", mesh, "ours");
    row.gap = "level " + std::to_string(level);
    row.remark = std::to_string(cut.size()) + " balls; " + reference_name + "'s " +
                 std::to_string(reference_cut.size()) +
                 Format(" overshoot: %.3g of the mean", mean) +
                 Format(", %.3g of the maximum", max);
    row.more = {Text("reference", reference_name),
                Number("reference_balls", static_cast<double>(reference_cut.size())),
                Number("balls", static_cast<double>(cut.size())),
                Number("reference_mean_m", reference.mean),
                Number("reference_max_m", reference.max),
                Number("mean_m", ours.mean),
                Number("max_m", ours.max)};
    report->Add(std::move(row));
    report->FigureGreatest("tree_mean_overshoot_vs_" + figure + "_worst", mean);
    report->FigureGreatest("tree_max_overshoot_vs_" + figure + "_worst", max);
  }
}

/// Exact, and so in a process of its own: another library may count with the same numbers.
void AddCoverage(const BenchMesh& mesh, const sphere_tree::SphereTree& tree, NarrowReport* report) {
  const ApartResult proof = RunApart(kProofCutOff, [&] {
    DyadicPool::Install();
    return std::vector<double>{TreeCoverage(mesh.mesh, tree).ProvenShare()};
  });
  NarrowRow row = RowOf("trees", mesh, "ours");
  row.gap = "coverage";
  if (proof.status == ApartStatus::kDone) {
    row.remark = Format("proven, by area: %.9g of the surface", proof.values[0]);
    report->FigureLeast("tree_coverage_least", proof.values[0]);
  } else {
    row.remark = Format("not proven within %g s", kProofCutOff);
  }
  report->Add(std::move(row));
}

}  // namespace

void TreesPart(const NarrowSettings& settings, NarrowReport* report) {
  for (const BenchMesh& mesh : ClosedMeshes(settings.data_dir)) {
    if (!settings.Wants(RowOf("trees", mesh, "ours").path())) continue;
    const auto octree = shape::Shape::Build(mesh.mesh),
               fitted = shape::Shape::Build(mesh.mesh, kFitted);
    CompareCuts(mesh, octree->tree(), fitted->tree(), "octree", "octree", report);
    CompareCuts(mesh, CircumscribedOctree(mesh, *octree), fitted->tree(), "circumscribed octree",
                "circumscribed_octree", report);
    AddCoverage(mesh, fitted->tree(), report);
  }
}

void BuildPart(const NarrowSettings& settings, NarrowReport* report) {
  for (const BenchMesh& mesh : ContestMeshes(settings.data_dir, settings.quick)) {
    if (!settings.Wants(RowOf("build", mesh, "ours").path())) continue;
    const PlainMesh plain = PlainOf(mesh.mesh);
    std::shared_ptr<const shape::Shape> shape;
    NarrowRow ours = RowOf("build", mesh, "ours");
    ours.warm = LeastCpuSeconds(3, [&] { shape = shape::Shape::Build(mesh.mesh, kFitted); });
    const auto nodes = static_cast<double>(shape->tree().nodes.size());
    ours.remark = Format("%g nodes", nodes) +
                  Format(", %.3g bytes a node", static_cast<double>(shape->tree().bytes()) / nodes);
    ours.more = {Number("nodes", nodes),
                 Number("tree_bytes", static_cast<double>(shape->tree().bytes())),
                 Number("shape_bytes", static_cast<double>(shape->bytes()))};
    NarrowRow octree = RowOf("build", mesh, "ours, octree");
    octree.warm = LeastCpuSeconds(3, [&] { shape = shape::Shape::Build(mesh.mesh); });
    const double ours_seconds = *ours.warm;
    report->Add(std::move(ours));
    report->Add(std::move(octree));
    const auto fcl_seconds = FclBuildSeconds(plain);
    if (!fcl_seconds) continue;
    NarrowRow fcl = RowOf("build", mesh, "FCL OBBRSS");
    fcl.warm = fcl_seconds;
    report->Add(std::move(fcl));
    report->FigureLeast("build_vs_fcl_bvh_worst", *fcl_seconds / ours_seconds);
  }
}

void BudgetPart(const NarrowSettings& settings, NarrowReport* report) {
  for (const BenchMesh& mesh : ContestMeshes(settings.data_dir, true)) {
    NarrowRow row = RowOf("budget", mesh, "ours");
    if (!settings.Wants(row.path())) continue;
    const narrow_phase::BodySegment body = BodyOf(shape::Shape::Build(mesh.mesh, kFitted));
    const narrow_phase::BodyTree surface(body);
    const PairOracle oracle = OracleOf(body.shape);
    std::uint64_t overrun = 0;
    std::size_t looks = 0;
    NumberHash hash;
    for (const GapClass& gap : GapClasses()) {
      const auto sample = SamplePoses(oracle, mesh.diameter(), gap, 10, kSeed);
      for (const PlainPose& pose : sample.poses) {
        for (std::uint64_t budget = 1; budget <= 100'000; budget = budget * 3 / 2 + 1) {
          WorkBudget work(budget);
          const narrow_phase::SeparationBracket look =
              narrow_phase::BracketSeparation({surface, surface, PoseOf(pose)}, {0, 0}, &work);
          hash.Add(look.lower), hash.Add(look.upper), ++looks;
          if (work.spent() > budget) overrun = std::max(overrun, work.spent() - budget);
        }
      }
    }
    row.hash = hash.text();
    row.remark = "at most " + std::to_string(overrun) + " units over, of " + std::to_string(looks) +
                 " looks with budgets from 1 to 100000 units";
    report->Add(std::move(row));
    report->FigureGreatest("overrun_units_max", static_cast<double>(overrun));
  }
}

}  // namespace collision::bench
