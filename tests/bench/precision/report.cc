#include "tests/bench/precision/report.h"

#include <algorithm>
#include <map>

namespace collision::bench {
namespace {

const std::vector<std::string> kFigures = {"ours_misses",
                                           "ours_false_alarms",
                                           "ours_brackets_without_the_truth",
                                           "peers_misses_at_best",
                                           "peers_false_alarms_at_best",
                                           "peer_over_ours_at_equal_error_translation",
                                           "peer_over_ours_at_equal_error_rotation",
                                           "peer_over_ours_at_equal_error_grazing",
                                           "ours_width_in_peers_time_translation",
                                           "ours_width_in_peers_time_rotation",
                                           "ours_width_in_peers_time_grazing",
                                           "contact_ours_misses",
                                           "contact_ours_false_alarms",
                                           "contact_ours_brackets_without_the_truth",
                                           "contact_peers_misses_at_best",
                                           "contact_peers_false_alarms_at_best",
                                           "contact_naive_misses",
                                           "contact_peer_over_ours_at_equal_error"};

/// Errors below this are taken for it: what rounding the pose leaves open [m].
constexpr double kRounding = 1e-13;
/// A time of contact is asked for no narrower than this [s].
constexpr double kTimeRounding = 1e-11;

constexpr std::size_t kPartWidth = 10, kMotionWidth = 12, kMeshWidth = 24, kMethodWidth = 29,
                      kSettingWidth = 22, kNumberWidth = 10;

std::string ShortNumber(const std::optional<double>& value) {
  return value ? Format("%.3g", *value) : "-";
}

Field Truth(const std::string& name, bool value) { return {name, value ? "true" : "false"}; }

/// Every peer's point that is right about yes and no, beside ours.
void Compare(const PrecisionRow& peer, const std::vector<const PrecisionRow*>& ours,
             PrecisionReport* report) {
  const bool contact = peer.part == "contact";
  const double error = std::max(*peer.error, contact ? kTimeRounding : kRounding);
  std::optional<double> seconds, width;
  for (const PrecisionRow* own : ours) {
    if (*own->width <= error) seconds = std::min(seconds.value_or(*own->seconds), *own->seconds);
    if (*own->seconds <= *peer.seconds) width = std::min(width.value_or(*own->width), *own->width);
  }
  if (seconds) {
    report->FigureLeast(contact ? "contact_peer_over_ours_at_equal_error"
                                : "peer_over_ours_at_equal_error_" + peer.motion,
                        *peer.seconds / *seconds);
  }
  if (width && !contact) {
    report->FigureGreatest("ours_width_in_peers_time_" + peer.motion, *width);
  }
}

/// Counts for each peer the setting that is wrong least often.
void SumAtTheirBest(PrecisionReport* report) {
  std::map<std::string, const PrecisionRow*> best;
  for (const PrecisionRow& row : report->rows()) {
    if (row.who != "peer") continue;
    const PrecisionRow*& known = best[row.part + row.motion + row.mesh + row.method];
    const auto wrong = [](const PrecisionRow& of) { return of.misses + of.false_alarms; };
    if (!known || wrong(row) < wrong(*known)) known = &row;
  }
  for (const auto& [name, row] : best) {
    const std::string start = row->part == "contact" ? "contact_" : "";
    report->FigureSum(start + "peers_misses_at_best", static_cast<double>(row->misses));
    report->FigureSum(start + "peers_false_alarms_at_best", static_cast<double>(row->false_alarms));
  }
}

}  // namespace

PrecisionReport::PrecisionReport()
    : RowReport(
          kFigures,
          Padded("part", kPartWidth) + Padded("motion", kMotionWidth) + Padded("mesh", kMeshWidth) +
              Padded("method", kMethodWidth) + Padded("setting", kSettingWidth) +
              Padded("median", kNumberWidth) + Padded("width", kNumberWidth) +
              Padded("error", kNumberWidth) + "queries, result hash",
          "figures (peer over ours: larger is better; widths in m; the worst of all cells)") {}

std::string PrecisionRow::Line() const {
  std::string text =
      Padded(part, kPartWidth) + Padded(motion, kMotionWidth) + Padded(mesh, kMeshWidth) +
      Padded(method, kMethodWidth) + Padded(setting, kSettingWidth) +
      Padded(seconds ? SecondsText(*seconds) : "-", kNumberWidth) +
      Padded(ShortNumber(width), kNumberWidth) + Padded(ShortNumber(error), kNumberWidth) +
      std::to_string(queries) + " " + hash;
  if (misses > 0) text += "  MISSES " + std::to_string(misses);
  if (false_alarms > 0) text += "  false alarms " + std::to_string(false_alarms);
  return text;
}

std::string PrecisionRow::Json() const {
  std::vector<Field> fields = {Text("part", part),
                               Text("motion", motion),
                               Text("mesh", mesh),
                               Text("method", method),
                               Text("who", who),
                               Text("setting", setting),
                               Number("seconds", seconds),
                               Number("width", width),
                               Number("error", error),
                               Number("queries", static_cast<double>(queries)),
                               Number("misses", static_cast<double>(misses)),
                               Number("false_alarms", static_cast<double>(false_alarms)),
                               Truth("certified", certified),
                               Text("limited_by", limited_by),
                               Text("hash", hash)};
  fields.insert(fields.end(), more.begin(), more.end());
  return Object(fields);
}

void SetFigures(PrecisionReport* report) {
  SumAtTheirBest(report);
  std::map<std::string, std::vector<const PrecisionRow*>> ours;
  const auto cell = [](const PrecisionRow& row) {
    return row.part + "/" + row.motion + "/" + row.mesh;
  };
  for (const PrecisionRow& row : report->rows()) {
    if (row.who == "ours" && row.width && row.seconds) ours[cell(row)].push_back(&row);
  }
  for (const PrecisionRow& row : report->rows()) {
    const std::string start = row.part == "contact" ? "contact_" : "";
    const std::string who = row.who == "ours" ? "ours" : row.who == "naive" ? "naive" : "peers";
    report->FigureSum(start + who + "_misses", static_cast<double>(row.misses));
    report->FigureSum(start + who + "_false_alarms", static_cast<double>(row.false_alarms));
    const bool counts =
        row.who == "peer" && row.error && row.seconds && row.misses == 0 && row.false_alarms == 0;
    if (counts) Compare(row, ours[cell(row)], report);
  }
}

}  // namespace collision::bench
