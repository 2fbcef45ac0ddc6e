#include "tests/report/section.h"

#include <cctype>
#include <utility>

#include "tests/report/chart_rows.h"
#include "tests/report/contestants.h"
#include "tests/report/rows.h"
#include "tests/report/text.h"

namespace collision::report {

using chart::Chart;

std::string IdOf(const std::string& text) {
  std::string id;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain || (!id.empty() && id.back() != '-')) id += plain ? c : '-';
  }
  return id;
}

void AddChart(Chart chart, Section* section) {
  if (chart.empty()) return;
  DrawByContestant(&chart);
  section->charts.push_back(std::move(chart));
}

void AddTable(Table table, Section* section) {
  if (!table.rows.empty()) section->tables.push_back(std::move(table));
}

void AddWhole(const v1::Results& results, const std::string& name, Section* section) {
  const v1::Experiment* experiment = FindExperiment(results, name);
  if (experiment == nullptr) {
    section->paragraphs.push_back(name + ": not in this report.");
    return;
  }
  Table figures{experiment->title() + ": figures", {"figure", "value"}, {}, true};
  for (const v1::Figure& figure : experiment->figures()) {
    figures.rows.push_back(
        {figure.name(), figure.has_value() ? Short(figure.value()) : "not measured"});
  }
  AddTable(figures, section);
  AddTable(WholeTable(experiment->title() + ": every measurement", Select(results, name, {})),
           section);
}

}  // namespace collision::report
