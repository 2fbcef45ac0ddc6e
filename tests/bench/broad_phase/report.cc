#include "tests/bench/broad_phase/report.h"

namespace collision::bench {
namespace {

/// In the order of the table and the file.
const std::vector<std::string> kFigures = {
    "scratch_100k_at_once",     "scratch_100k_half", "scratch_100k_never",
    "scratch_1m_at_once",       "scratch_1m_half",   "scratch_1m_never",
    "incremental_100k",         "incremental_1k",    "turk_total_worst",
    "turk_slowest_frame_worst", "growth_exponent",   "worst_scene_ratio",
    "swarm_message_ratio",      "bytes_per_agent",   "allocations_per_update"};

}  // namespace

std::string TimeText(const Row& row) {
  if (row.failed) return "failed";
  if (!row.seconds) return "> " + Format("%g s", row.cut_off);
  return SecondsText(*row.seconds);
}

Report::Report()
    : RowReport(kFigures,
                Padded("part", 12) + Padded("scene", 22) + Padded("agents", 9) +
                    Padded("contestant", 26) + Padded("median", 12) + "result hash",
                "figures (of ratios, larger is better)") {}

std::string Row::Line() const {
  std::string text = Padded(part, 12) + Padded(scene, 22) + Padded(std::to_string(agents), 9) +
                     Padded(contestant, 26) + Padded(TimeText(*this), 12) +
                     Padded(answer ? Hash(*answer) : "-", 18) + remark;
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::string Row::Json() const {
  std::vector<Field> fields = {Text("part", part),
                               Text("scene", scene),
                               Number("agents", static_cast<double>(agents)),
                               Text("contestant", contestant),
                               Number("seconds", seconds),
                               Number("cut_off_s", cut_off)};
  if (failed) fields.push_back({"failed", "true"});
  if (answer) {
    fields.push_back(Text("hash", Hash(*answer)));
    fields.push_back({"found", answer->found ? "true" : "false"});
    if (answer->found) {
      fields.push_back(Number("lower", answer->lower));
      fields.push_back(Number("higher", answer->higher));
      fields.push_back({"time_ns", std::to_string(answer->time_ns)});
    }
  }
  if (!remark.empty()) fields.push_back(Text("remark", remark));
  fields.insert(fields.end(), more.begin(), more.end());
  return Object(fields);
}

}  // namespace collision::bench
