#include "tests/bench/narrow_report.h"

#include <cstdio>

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

std::string RowText(const NarrowRow& row) {
  // A case without a gap has a name as long as it needs.
  const std::string what =
      row.gap.empty()
          ? Padded(row.mesh, kMeshWidth + kTrianglesWidth + kGapWidth)
          : Padded(row.mesh, kMeshWidth) +
                Padded(row.triangles > 0 ? std::to_string(row.triangles) : "-", kTrianglesWidth) +
                Padded(row.gap, kGapWidth);
  std::string text = Padded(row.part, kPartWidth) + what + Padded(row.contestant, kNameWidth) +
                     Padded(TimeText(row.warm), kTimeWidth) +
                     Padded(TimeText(row.cold), kTimeWidth) +
                     Padded(row.hash.empty() ? "-" : row.hash, kHashWidth) + row.remark;
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::string RowJson(const NarrowRow& row) {
  std::vector<Field> fields = {Text("part", row.part),
                               Text("mesh", row.mesh),
                               Number("triangles", static_cast<double>(row.triangles)),
                               Text("gap", row.gap),
                               Text("contestant", row.contestant),
                               Number("warm_s", row.warm),
                               Number("cold_s", row.cold)};
  if (!row.hash.empty()) fields.push_back(Text("hash", row.hash));
  if (!row.remark.empty()) fields.push_back(Text("remark", row.remark));
  fields.insert(fields.end(), row.more.begin(), row.more.end());
  return Object(fields);
}

}  // namespace

NarrowReport::NarrowReport() : figures_(kFigures) {}

void NarrowReport::Add(NarrowRow row) {
  std::fprintf(stderr, "bench: %s\n", RowText(row).c_str());
  rows_.push_back(std::move(row));
}

void NarrowReport::FigureLeast(const std::string& name, double value) {
  const auto known = figures_.Get(name);
  figures_.Set(name, known ? std::min(*known, value) : value);
}

void NarrowReport::FigureGreatest(const std::string& name, double value) {
  const auto known = figures_.Get(name);
  figures_.Set(name, known ? std::max(*known, value) : value);
}

std::string NarrowReport::Table() const {
  std::string text = Padded("part", kPartWidth) + Padded("mesh", kMeshWidth) +
                     Padded("tri.", kTrianglesWidth) + Padded("gap", kGapWidth) +
                     Padded("contestant", kNameWidth) + Padded("warm", kTimeWidth) +
                     Padded("cold", kTimeWidth) + "result hash\n";
  for (const NarrowRow& row : rows_) text += RowText(row) + "\n";
  return text +
         "\nfigures (ratios are peer over ours, larger is better; of trees ours over the octree's, "
         "smaller is better)\n" +
         figures_.Table();
}

std::string NarrowReport::Json() const {
  std::vector<std::string> measurements;
  for (const NarrowRow& row : rows_) measurements.push_back(RowJson(row));
  return figures_.Json(measurements);
}

}  // namespace collision::bench
