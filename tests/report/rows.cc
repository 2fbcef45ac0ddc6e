#include "tests/report/rows.h"

#include <algorithm>

#include "tests/report/text.h"

namespace collision::report {
namespace {

const google::protobuf::Value* ValueOf(const Row& row, const std::string& field) {
  const auto found = row.fields().find(field);
  return found == row.fields().end() ? nullptr : &found->second;
}

bool Meets(const Row& row, const Condition& condition) {
  const auto& [field, wanted] = condition;
  const std::string text = TextOf(row, field);
  if (wanted.starts_with('!')) return text != wanted.substr(1);
  if (wanted.ends_with('*')) return text.starts_with(wanted.substr(0, wanted.size() - 1));
  return text == wanted;
}

}  // namespace

std::optional<double> NumberOf(const Row& row, const std::string& field) {
  const auto* value = ValueOf(row, field);
  if (value == nullptr || !value->has_number_value()) return std::nullopt;
  return value->number_value();
}

std::string TextOf(const Row& row, const std::string& field) {
  const auto* value = ValueOf(row, field);
  if (value == nullptr) return "";
  if (value->has_string_value()) return value->string_value();
  if (value->has_bool_value()) return value->bool_value() ? "yes" : "no";
  return value->has_number_value() ? Short(value->number_value()) : "";
}

std::string TextOf(const Row& row, const std::vector<std::string>& fields) {
  std::string text;
  for (const std::string& field : fields) {
    const std::string of_field = TextOf(row, field);
    if (!of_field.empty()) text += (text.empty() ? "" : ", ") + of_field;
  }
  return text;
}

const v1::Experiment* FindExperiment(const v1::Results& results, const std::string& name) {
  for (const v1::Experiment& experiment : results.experiments()) {
    if (experiment.name() == name) return &experiment;
  }
  return nullptr;
}

std::optional<double> FigureOf(const v1::Results& results, const std::string& experiment,
                               const std::string& figure) {
  const v1::Experiment* of_name = FindExperiment(results, experiment);
  if (of_name == nullptr) return std::nullopt;
  for (const v1::Figure& known : of_name->figures()) {
    if (known.name() == figure && known.has_value()) return known.value();
  }
  return std::nullopt;
}

std::vector<const Row*> Select(const v1::Results& results, const std::string& experiment,
                               const std::vector<Condition>& conditions) {
  std::vector<const Row*> rows;
  const v1::Experiment* of_name = FindExperiment(results, experiment);
  if (of_name == nullptr) return rows;
  for (const Row& row : of_name->measurements()) {
    const bool wanted = std::all_of(conditions.begin(), conditions.end(),
                                    [&](const Condition& c) { return Meets(row, c); });
    if (wanted) rows.push_back(&row);
  }
  return rows;
}

std::vector<std::string> TextsOf(const std::vector<const Row*>& rows, const std::string& field) {
  std::vector<std::string> texts;
  for (const Row* row : rows) {
    const std::string text = TextOf(*row, field);
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
  }
  return texts;
}

}  // namespace collision::report
