#include "tests/bench/report.h"

#include <algorithm>
#include <cstdio>

namespace collision::bench {
namespace {

/// In the order of the table and the file.
const std::vector<std::string> kFigures = {
    "scratch_100k_at_once",     "scratch_100k_half", "scratch_100k_never",
    "scratch_1m_at_once",       "scratch_1m_half",   "scratch_1m_never",
    "incremental_100k",         "incremental_1k",    "turk_total_worst",
    "turk_slowest_frame_worst", "growth_exponent",   "worst_scene_ratio",
    "swarm_message_ratio",      "bytes_per_agent",   "allocations_per_update"};

std::string RowJson(const Row& row) {
  std::vector<Field> fields = {Text("part", row.part),
                               Text("scene", row.scene),
                               Number("agents", static_cast<double>(row.agents)),
                               Text("contestant", row.contestant),
                               Number("seconds", row.seconds),
                               Number("cut_off_s", row.cut_off)};
  if (row.failed) fields.push_back({"failed", "true"});
  if (row.answer) {
    fields.push_back(Text("hash", Hash(*row.answer)));
    fields.push_back({"found", row.answer->found ? "true" : "false"});
    if (row.answer->found) {
      fields.push_back(Number("lower", row.answer->lower));
      fields.push_back(Number("higher", row.answer->higher));
      fields.push_back({"time_ns", std::to_string(row.answer->time_ns)});
    }
  }
  if (!row.remark.empty()) fields.push_back(Text("remark", row.remark));
  fields.insert(fields.end(), row.more.begin(), row.more.end());
  return Object(fields);
}

std::string RowText(const Row& row) {
  std::string text = Padded(row.part, 12) + Padded(row.scene, 22) +
                     Padded(std::to_string(row.agents), 9) + Padded(row.contestant, 26) +
                     Padded(TimeText(row), 12) + Padded(row.answer ? Hash(*row.answer) : "-", 18) +
                     row.remark;
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

}  // namespace

std::string TimeText(const Row& row) {
  if (row.failed) return "failed";
  if (!row.seconds) return "> " + Format("%g s", row.cut_off);
  return SecondsText(*row.seconds);
}

Report::Report() : figures_(kFigures) {}

void Report::Add(Row row) {
  std::fprintf(stderr, "bench: %s\n", RowText(row).c_str());
  rows_.push_back(std::move(row));
}

void Report::Mark(const std::string& remark) {
  std::fprintf(stderr, "bench:   %s\n", remark.c_str());
  rows_.back().remark += (rows_.back().remark.empty() ? "" : "; ") + remark;
}

void Report::Figure(const std::string& name, std::optional<double> value) {
  figures_.Set(name, value);
}

std::string Report::Table() const {
  std::string text = Padded("part", 12) + Padded("scene", 22) + Padded("agents", 9) +
                     Padded("contestant", 26) + Padded("median", 12) + "result hash\n";
  for (const Row& row : rows_) text += RowText(row) + "\n";
  return text + "\nfigures (of ratios, larger is better)\n" + figures_.Table();
}

std::string Report::Json() const {
  std::vector<std::string> measurements;
  for (const Row& row : rows_) measurements.push_back(RowJson(row));
  return figures_.Json(measurements);
}

}  // namespace collision::bench
