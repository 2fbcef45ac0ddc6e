#include "client/programs/gateway/metrics/metrics_text.h"

#include <charconv>
#include <cmath>

namespace collision::gateway {
namespace {

/// With what the format escapes: \ and line breaks, in values of labels " as well.
std::string Escaped(const std::string& text, bool is_label) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\\\";
    } else if (c == '\n') {
      escaped += "\\n";
    } else if (c == '"' && is_label) {
      escaped += "\\\"";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

/// The shortest number that reads back as this one.
std::string NumberText(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

const char* WordOf(MetricsText::Type type) {
  switch (type) {
    case MetricsText::Type::kCounter:
      return "counter";
    case MetricsText::Type::kGauge:
      return "gauge";
    case MetricsText::Type::kHistogram:
      return "histogram";
  }
  return "untyped";
}

}  // namespace

void MetricsText::Begin(const std::string& name, Type type, const std::string& help) {
  name_ = name;
  text_ += "# HELP " + name + " " + Escaped(help, false) + "\n# TYPE " + name + " " + WordOf(type) +
           "\n";
}

void MetricsText::Add(double value, const Labels& labels) {
  AddLine(name_, labels, NumberText(value));
}

void MetricsText::AddBucket(double end, std::uint64_t count_up_to, const Labels& labels) {
  Labels all = labels;
  all.emplace_back("le", NumberText(end));
  AddLine(name_ + "_bucket", all, std::to_string(count_up_to));
}

void MetricsText::AddCount(std::uint64_t count, const Labels& labels) {
  AddLine(name_ + "_count", labels, std::to_string(count));
}

void MetricsText::AddLine(const std::string& name, const Labels& labels, const std::string& value) {
  std::string list;
  for (const auto& [key, label] : labels) {
    list += (list.empty() ? "{" : ",") + key + "=\"" + Escaped(label, true) + "\"";
  }
  text_ += name + list + (list.empty() ? "" : "}") + " " + value + "\n";
}

}  // namespace collision::gateway
