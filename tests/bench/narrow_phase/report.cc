#include "tests/bench/narrow_phase/report.h"

namespace collision::bench {
namespace {

/// In the order of the table and the file.
const std::vector<std::string> kFigures = {"decision_worst",
                                           "decision_gap_0_1pct_worst",
                                           "decision_gap_50pct_worst",
                                           "distance_worst",
                                           "bracket_1pct_vs_fcl_distance_worst",
                                           "decision_cold_worst",
                                           "decision_gap_0_1pct_cold_worst",
                                           "decision_gap_50pct_cold_worst",
                                           "distance_cold_worst",
                                           "bracket_1pct_vs_fcl_distance_cold_worst",
                                           "convex_decision_worst",
                                           "convex_decision_gap_0_1pct_worst",
                                           "convex_decision_gap_50pct_worst",
                                           "convex_distance_worst",
                                           "convex_decision_cold_worst",
                                           "convex_decision_gap_0_1pct_cold_worst",
                                           "convex_decision_gap_50pct_cold_worst",
                                           "convex_distance_cold_worst",
                                           "tree_mean_overshoot_vs_octree_worst",
                                           "tree_max_overshoot_vs_octree_worst",
                                           "tree_mean_overshoot_vs_circumscribed_octree_worst",
                                           "tree_max_overshoot_vs_circumscribed_octree_worst",
                                           "tree_coverage_least",
                                           "overrun_units_max",
                                           "build_vs_fcl_bvh_worst",
                                           "contact_vs_fcl_ca_worst",
                                           "contact_work_max"};

constexpr std::size_t kPartWidth = 17, kMeshWidth = 16, kTrianglesWidth = 8, kGapWidth = 15,
                      kNameWidth = 20, kTimeWidth = 10, kHashWidth = 18;

std::string TimeText(const std::optional<double>& seconds) {
  return seconds ? SecondsText(*seconds) : "-";
}

}  // namespace

NarrowReport::NarrowReport()
    : RowReport(kFigures,
                Padded("part", kPartWidth) + Padded("mesh", kMeshWidth) +
                    Padded("tri.", kTrianglesWidth) + Padded("gap", kGapWidth) +
                    Padded("contestant", kNameWidth) + Padded("warm", kTimeWidth) +
                    Padded("cold", kTimeWidth) + "result hash",
                "figures (ratios are peer over ours, larger is better; of trees ours over the "
                "octree's, smaller is better)") {}

NarrowRow RowOf(const std::string& part, const BenchMesh& mesh, const std::string& contestant) {
  NarrowRow row;
  row.part = part;
  row.mesh = mesh.name;
  row.triangles = mesh.mesh.triangles.size();
  row.contestant = contestant;
  return row;
}

std::string NarrowRow::Line() const {
  // A case without a gap has a name as long as it needs.
  const std::string what =
      gap.empty() ? Padded(mesh, kMeshWidth + kTrianglesWidth + kGapWidth)
                  : Padded(mesh, kMeshWidth) +
                        Padded(triangles > 0 ? std::to_string(triangles) : "-", kTrianglesWidth) +
                        Padded(gap, kGapWidth);
  std::string text = Padded(part, kPartWidth) + what + Padded(contestant, kNameWidth) +
                     Padded(TimeText(warm), kTimeWidth) + Padded(TimeText(cold), kTimeWidth) +
                     Padded(hash.empty() ? "-" : hash, kHashWidth) + remark;
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::string NarrowRow::Json() const {
  std::vector<Field> fields = {Text("part", part),
                               Text("mesh", mesh),
                               Number("triangles", static_cast<double>(triangles)),
                               Text("gap", gap),
                               Text("contestant", contestant),
                               Number("warm_s", warm),
                               Number("cold_s", cold)};
  if (!hash.empty()) fields.push_back(Text("hash", hash));
  if (!remark.empty()) fields.push_back(Text("remark", remark));
  fields.insert(fields.end(), more.begin(), more.end());
  return Object(fields);
}

}  // namespace collision::bench
