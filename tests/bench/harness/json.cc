#include "tests/bench/harness/json.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <stdexcept>

namespace collision::bench {
namespace {

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? ' ' : c;
  }
  return quoted + "\"";
}

}  // namespace

std::string Format(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

Field Number(const std::string& name, std::optional<double> value) {
  return {name, value && std::isfinite(*value) ? Format("%.9g", *value) : "null"};
}

Field Text(const std::string& name, const std::string& value) { return {name, Quoted(value)}; }

Field List(const std::string& name, const std::vector<double>& values) {
  std::string json = "[";
  for (const double value : values) {
    if (json.size() > 1) json += ", ";
    json += Format("%.9g", value);
  }
  return {name, json + "]"};
}

std::string Object(const std::vector<Field>& fields) {
  std::string text;
  std::set<std::string> names;
  for (const Field& field : fields) {
    if (!names.insert(field.name).second) throw std::logic_error("two fields: " + field.name);
    text += (text.empty() ? "{" : ", ") + Quoted(field.name) + ": " + field.json;
  }
  return text.empty() ? "{}" : text + "}";
}

std::string Padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

std::string SecondsText(double seconds) {
  if (seconds < 1e-6) return Format("%.3g ns", seconds * 1e9);
  if (seconds < 1e-3) return Format("%.3g us", seconds * 1e6);
  if (seconds < 1) return Format("%.3g ms", seconds * 1e3);
  return Format("%.3g s", seconds);
}

Figures::Figures(const std::vector<std::string>& names) {
  for (const std::string& name : names) figures_.emplace_back(name, std::nullopt);
}

void Figures::Set(const std::string& name, std::optional<double> value) {
  for (auto& [known, of_known] : figures_) {
    if (known == name) of_known = value;
  }
}

std::optional<double> Figures::Get(const std::string& name) const {
  for (const auto& [known, of_known] : figures_) {
    if (known == name) return of_known;
  }
  return std::nullopt;
}

std::string Figures::Table() const {
  std::size_t width = 28;
  for (const auto& [name, value] : figures_) width = std::max(width, name.size() + 1);
  std::string text;
  for (const auto& [name, value] : figures_) {
    text += "  " + Padded(name, width) + (value ? Format("%.4g", *value) : "not measured") + "\n";
  }
  return text;
}

std::string Figures::Json(const std::vector<std::string>& measurements) const {
  std::string text = "{\n  \"figures\": {";
  for (std::size_t i = 0; i < figures_.size(); ++i) {
    const Field field = Number(figures_[i].first, figures_[i].second);
    text += std::string(i == 0 ? "" : ",") + "\n    " + Quoted(field.name) + ": " + field.json;
  }
  text += "\n  },\n  \"measurements\": [";
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    text += std::string(i == 0 ? "" : ",") + "\n    " + measurements[i];
  }
  return text + "\n  ]\n}\n";
}

int WriteJson(const std::string& path, const std::string& json) {
  if (path.empty()) return 0;
  std::ofstream file(path);
  file << json;
  file.close();
  if (file) return 0;
  std::fprintf(stderr, "cannot write %s\n", path.c_str());
  return 74;
}

}  // namespace collision::bench
