#include "tests/bench/report.h"

#include <algorithm>
#include <cstdio>

namespace collision::bench {
namespace {

/// In the order of the table and the file.
constexpr const char* kFigures[] = {
    "scratch_100k_at_once",     "scratch_100k_half", "scratch_100k_never",
    "scratch_1m_at_once",       "scratch_1m_half",   "scratch_1m_never",
    "incremental_100k",         "incremental_1k",    "turk_total_worst",
    "turk_slowest_frame_worst", "growth_exponent",   "worst_scene_ratio",
    "swarm_message_ratio",      "bytes_per_agent",   "allocations_per_update"};

std::string Format(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? ' ' : c;
  }
  return quoted + "\"";
}

std::string Padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

std::string Object(const std::vector<Field>& fields) {
  std::string text;
  for (const Field& field : fields) {
    text += (text.empty() ? "{" : ", ") + Quoted(field.name) + ": " + field.json;
  }
  return text.empty() ? "{}" : text + "}";
}

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

Field Number(const std::string& name, std::optional<double> value) {
  return {name, value ? Format("%.9g", *value) : "null"};
}

Field Text(const std::string& name, const std::string& value) { return {name, Quoted(value)}; }

std::string TimeText(const Row& row) {
  if (row.failed) return "failed";
  if (!row.seconds) return "> " + Format("%g s", row.cut_off);
  const double s = *row.seconds;
  if (s < 1e-6) return Format("%.3g ns", s * 1e9);
  if (s < 1e-3) return Format("%.3g us", s * 1e6);
  if (s < 1) return Format("%.3g ms", s * 1e3);
  return Format("%.3g s", s);
}

Report::Report() {
  for (const char* name : kFigures) figures_.emplace_back(name, std::nullopt);
}

void Report::Add(Row row) {
  std::fprintf(stderr, "bench: %s\n", RowText(row).c_str());
  rows_.push_back(std::move(row));
}

void Report::Mark(const std::string& remark) {
  std::fprintf(stderr, "bench:   %s\n", remark.c_str());
  rows_.back().remark += (rows_.back().remark.empty() ? "" : "; ") + remark;
}

void Report::Figure(const std::string& name, std::optional<double> value) {
  for (auto& [known, of_known] : figures_) {
    if (known == name) of_known = value;
  }
}

std::string Report::Table() const {
  std::string text = Padded("part", 12) + Padded("scene", 22) + Padded("agents", 9) +
                     Padded("contestant", 26) + Padded("median", 12) + "result hash\n";
  for (const Row& row : rows_) text += RowText(row) + "\n";
  text += "\nfigures (of ratios, larger is better)\n";
  for (const auto& [name, value] : figures_) {
    text += "  " + Padded(name, 28) + (value ? Format("%.4g", *value) : "not measured") + "\n";
  }
  return text;
}

std::string Report::Json() const {
  std::string text = "{\n  \"figures\": {";
  for (std::size_t i = 0; i < figures_.size(); ++i) {
    const Field field = Number(figures_[i].first, figures_[i].second);
    text += std::string(i == 0 ? "" : ",") + "\n    " + Quoted(field.name) + ": " + field.json;
  }
  text += "\n  },\n  \"measurements\": [";
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    text += std::string(i == 0 ? "" : ",") + "\n    " + RowJson(rows_[i]);
  }
  return text + "\n  ]\n}\n";
}

}  // namespace collision::bench
