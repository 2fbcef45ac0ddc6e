#include "tests/report/chart_rows.h"

#include <algorithm>
#include <cmath>

#include "tests/report/text.h"

namespace collision::report {

using chart::Chart;
using chart::Point;
using chart::Series;
namespace {

bool IsDuration(const std::string& field) {
  return field == "seconds" || field.ends_with("_s") || field.ends_with("_seconds");
}

/// "> 5 s", where the row was given up; else empty.
std::string GivenUp(const Row& row) {
  const auto cut_off = NumberOf(row, "cut_off_s");
  if (NumberOf(row, "seconds") || !cut_off) return "";
  return "> " + Short(*cut_off) + " s";
}

std::string WrongAnswers(const Row& row) {
  std::string text;
  const auto add = [&](const char* field, const char* words) {
    const double count = NumberOf(row, field).value_or(0);
    if (count > 0) text += (text.empty() ? "" : ", ") + Short(count) + " " + words;
  };
  add("misses", "missed");
  add("false_alarms", "false alarms");
  const auto queries = NumberOf(row, "queries");
  if (!text.empty() && queries) text += " of " + Short(*queries);
  return text;
}

std::string CellOf(const Row& row, const std::string& field) {
  const auto number = NumberOf(row, field);
  if (field == "seconds" && !number) return GivenUp(row);
  if (number && IsDuration(field)) return Duration(*number);
  return TextOf(row, field);
}

Series* SeriesOf(const std::string& name, const ChartFields& fields, Chart* chart) {
  for (Series& series : chart->series) {
    if (series.name == name) return &series;
  }
  Series series;
  series.name = name;
  series.thick = std::any_of(fields.ours.begin(), fields.ours.end(),
                             [&](const std::string& begin) { return name.starts_with(begin); });
  chart->series.push_back(series);
  return &chart->series.back();
}

}  // namespace

Chart ChartOf(Chart chart, const std::vector<const Row*>& rows, const ChartFields& fields) {
  for (const Row* row : rows) {
    const auto x = NumberOf(*row, fields.x);
    auto y = NumberOf(*row, fields.y);
    if (!y) y = NumberOf(*row, fields.y_else);
    const std::string wrong = WrongAnswers(*row), given_up = GivenUp(*row);
    if (!x || (!y && wrong.empty() && given_up.empty())) continue;
    const bool ours = TextOf(*row, "who") == "ours";
    std::string name = TextOf(*row, fields.series);
    if (ours && !name.starts_with("ours")) name = "ours: " + name;
    Series* series = SeriesOf(name, fields, &chart);
    series->thick |= ours;
    if (series->note.empty()) series->note = TextOf(*row, "limited_by");
    Point point{*x * fields.x_factor, std::nullopt, wrong.empty() ? given_up : wrong};
    if (y && wrong.empty()) point.y = *y * fields.y_factor;
    series->points.push_back(point);
  }
  for (Series& series : chart.series) {
    std::stable_sort(series.points.begin(), series.points.end(),
                     [](const Point& a, const Point& b) { return a.x < b.x; });
  }
  return chart;
}

std::vector<Row> Renamed(const std::vector<const Row*>& rows, const std::string& field,
                         const std::function<std::string(const std::string&)>& name) {
  std::vector<Row> renamed;
  for (const Row* row : rows) {
    renamed.push_back(*row);
    (*renamed.back().mutable_fields())[field].set_string_value(name(TextOf(*row, field)));
  }
  return renamed;
}

std::vector<const Row*> Pointers(const std::vector<Row>& rows) {
  std::vector<const Row*> pointers;
  for (const Row& row : rows) pointers.push_back(&row);
  return pointers;
}

Table TableOf(const std::string& title, const std::vector<const Row*>& rows,
              const std::vector<Column>& columns) {
  Table table;
  table.title = title;
  for (const Column& column : columns) table.columns.push_back(column.title);
  for (const Row* row : rows) {
    std::vector<std::string> cells;
    for (const Column& column : columns) cells.push_back(CellOf(*row, column.field));
    table.rows.push_back(cells);
  }
  return table;
}

Table WholeTable(const std::string& title, const std::vector<const Row*>& rows) {
  std::vector<Column> columns;
  const auto known = [&](const std::string& field) {
    return std::any_of(columns.begin(), columns.end(),
                       [&](const Column& column) { return column.field == field; });
  };
  // The fields of a row come in no order; these are looked for first.
  for (const char* field : {"part", "scene", "motion", "mesh", "gap", "group", "name", "module",
                            "agents", "method", "contestant", "setting", "seconds", "warm_s"}) {
    const bool used = std::any_of(rows.begin(), rows.end(),
                                  [&](const Row* row) { return row->fields().contains(field); });
    if (used) columns.push_back({field, field});
  }
  std::vector<std::string> rest;
  for (const Row* row : rows) {
    for (const auto& [field, value] : row->fields()) {
      if (!known(field) && std::find(rest.begin(), rest.end(), field) == rest.end()) {
        rest.push_back(field);
      }
    }
  }
  std::sort(rest.begin(), rest.end());
  for (const std::string& field : rest) columns.push_back({field, field});
  Table table = TableOf(title, rows, columns);
  table.folded = true;
  return table;
}

}  // namespace collision::report
