// A part of the page, and the pieces that it is made of.
#pragma once

#include <string>
#include <vector>

#include "client/programs/chart/chart.h"
#include "idl/report.pb.h"
#include "tests/report/table.h"

namespace collision::report {

struct Section {
  std::string id;  ///< For links within the page.
  std::string title;
  std::vector<std::string> paragraphs;
  std::vector<chart::Chart> charts;
  std::vector<Table> tables;
};

/// What a file may be called, made of the text's letters.
std::string IdOf(const std::string& text);

/// Adds the chart if anything was measured for it. Each contestant looks the same in all charts.
void AddChart(chart::Chart chart, Section* section);

/// Adds the table if it has rows.
void AddTable(Table table, Section* section);

/// Every measurement and figure of an experiment, folded; or that it is missing.
void AddWhole(const v1::Results& results, const std::string& name, Section* section);

}  // namespace collision::report
