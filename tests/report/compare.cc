#include "tests/report/compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "tests/report/results.h"
#include "tests/report/rows.h"
#include "tests/report/text.h"

namespace collision::report {
namespace {

/// Deviations from the median that make noise: of normal noise all but three in a thousand.
constexpr double kDeviations = 3 * 1.4826;
/// Fewer rows say nothing of how noisy they are.
constexpr std::size_t kRowsMin = 8;

bool EndsWithAny(const std::string& text, std::initializer_list<const char*> endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](const char* ending) { return text.ends_with(ending); });
}

bool IsCount(const std::string& figure) {
  return EndsWithAny(
      figure,
      {"_units",  "_units_max",   "_units_worst", "_work_max", "_misses",      "_missed",
       "_alarms", "_at_best",     "_bytes",       "_least",    "_count",       "_failed",
       "_cases",  "_checks",      "_broken",      "_differ",   "_truth",       "mutants",
       "killed",  "survived",     "errors",       "corners",   "corners_same", "corners_not_run",
       "scenes",  "fuzz_targets", "fuzz_findings"});
}

/// A field that is a time, whatever it is called.
bool IsTime(const std::string& field) {
  return field == "seconds" || field.ends_with("_s") || field.ends_with("_seconds");
}

/// What tells a row from the others: its texts, without hashes and remarks.
std::string KeyOf(const Row& row) {
  std::map<std::string, std::string> texts;
  for (const auto& [field, value] : row.fields()) {
    const bool told_apart = value.has_string_value() && field != "hash" && field != "remark";
    if (told_apart || field == "agents" || field == "triangles") texts[field] = TextOf(row, field);
  }
  std::string key;
  for (const auto& [field, text] : texts) key += field + "=" + text + ";";
  return key;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How far the times moved against each other, as a share.
double NoiseOfRows(const v1::Experiment& before, const v1::Experiment& after) {
  std::map<std::string, const Row*> old_rows;
  for (const Row& row : before.measurements()) old_rows[KeyOf(row)] = &row;
  std::vector<double> moves;
  for (const Row& row : after.measurements()) {
    const auto old = old_rows.find(KeyOf(row));
    if (old == old_rows.end()) continue;
    for (const auto& [field, value] : row.fields()) {
      if (!IsTime(field)) continue;
      const auto now = NumberOf(row, field), then = NumberOf(*old->second, field);
      if (now && then && *now > 0 && *then > 0) moves.push_back(std::log(*now / *then));
    }
  }
  if (moves.size() < kRowsMin) return 0;
  const double middle = Median(moves);
  for (double& move : moves) move = std::abs(move - middle);
  return std::expm1(kDeviations * Median(moves));
}

Move MoveOf(const std::string& experiment, const std::string& figure,
            const std::optional<double>& before, const std::optional<double>& after, double noise) {
  Move move{experiment, figure, before ? Short(*before) : "", after ? Short(*after) : ""};
  move.noise = IsCount(figure) ? 0 : noise;
  if (!before || !after) {
    move.moved = before.has_value() != after.has_value();
    return move;
  }
  if (*before == *after) return move;
  move.change = *before == 0 ? std::copysign(HUGE_VAL, *after) : *after / *before - 1;
  // Half is as far as twice.
  const double ratio = *after / *before;
  move.factor = ratio > 0 ? std::max(ratio, 1 / ratio) : HUGE_VAL;
  move.moved = move.factor - 1 > move.noise;
  return move;
}

void CompareHashes(const v1::Experiment& before, const v1::Experiment& after,
                   std::vector<std::string>* remarks) {
  std::map<std::string, std::string> old_hashes;
  for (const Row& row : before.measurements()) old_hashes[KeyOf(row)] = TextOf(row, "hash");
  int differ = 0;
  std::string first;
  for (const Row& row : after.measurements()) {
    const auto old = old_hashes.find(KeyOf(row));
    const std::string hash = TextOf(row, "hash");
    if (old == old_hashes.end() || hash.empty() || old->second == hash) continue;
    if (differ++ == 0) first = TextOf(row, {"part", "scene", "mesh", "contestant", "method"});
  }
  if (differ == 0) return;
  remarks->push_back(after.name() + ": other answers in " + std::to_string(differ) +
                     " measurements (their hashes differ), the first: " + first);
}

}  // namespace

Comparison Compare(const v1::Results& before, const v1::Results& after) {
  Comparison comparison;
  if (before.quick() != after.quick()) {
    comparison.remarks.push_back("one of the reports is a quick one: figures of other scenes");
  }
  if (before.machine().processor() != after.machine().processor() ||
      before.machine().processors() != after.machine().processors()) {
    comparison.remarks.push_back("other machine: times are not to be compared, ratios with care");
  }
  const double reference = std::max(NoiseOf(before), NoiseOf(after));
  for (const v1::Experiment& experiment : after.experiments()) {
    const v1::Experiment* old = FindExperiment(before, experiment.name());
    if (old == nullptr) {
      comparison.remarks.push_back(experiment.name() + ": not in the old report");
      continue;
    }
    const double noise = std::max(reference, NoiseOfRows(*old, experiment));
    for (const v1::Figure& figure : experiment.figures()) {
      comparison.moves.push_back(MoveOf(experiment.name(), figure.name(),
                                        FigureOf(before, experiment.name(), figure.name()),
                                        FigureOf(after, experiment.name(), figure.name()), noise));
    }
    CompareHashes(*old, experiment, &comparison.remarks);
  }
  for (const v1::Experiment& old : before.experiments()) {
    if (FindExperiment(after, old.name()) == nullptr) {
      comparison.remarks.push_back(old.name() + ": in the old report only");
    }
  }
  std::stable_sort(comparison.moves.begin(), comparison.moves.end(),
                   [](const Move& a, const Move& b) {
                     return a.moved != b.moved ? a.moved : a.factor > b.factor;
                   });
  return comparison;
}

std::string TextOf(const Comparison& comparison) {
  std::string text;
  for (const std::string& remark : comparison.remarks) text += "  " + remark + "\n";
  std::size_t still = 0;
  for (const Move& move : comparison.moves) {
    if (!move.moved) {
      ++still;
      continue;
    }
    text += "  " + move.experiment + " " + move.figure + ": " +
            (move.before.empty() ? "not measured" : move.before) + " -> " +
            (move.after.empty() ? "not measured" : move.after);
    if (!move.before.empty() && !move.after.empty()) {
      char change[80];
      std::snprintf(change, sizeof change, ", %+.3g %% (noise %.2g %%", 100 * move.change,
                    100 * move.noise);
      text += change;
      if (move.noise > 0) text += ", " + Short(move.OverNoise()) + " times as much";
      text += ")";
    }
    text += "\n";
  }
  return text + "  " + std::to_string(still) + " figures did not move by more than the noise\n";
}

}  // namespace collision::report
