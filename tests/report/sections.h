// What the page shows, in its order: texts, plots and tables of what was measured.
#pragma once

#include <string>
#include <vector>

#include "idl/report.pb.h"
#include "tests/report/chart.h"
#include "tests/report/table.h"

namespace collision::report {

struct Section {
  std::string id;  ///< For links within the page.
  std::string title;
  std::vector<std::string> paragraphs;
  std::vector<Chart> charts;
  std::vector<Table> tables;
};

/// A section whose experiments are all missing says so. Every measurement of every experiment is in
/// a folded table at least.
std::vector<Section> SectionsOf(const v1::Results& results);

/// The plots that MEASURED.md shows, by their ids, and the caption of each.
struct MeasuredPlot {
  std::string id, caption;
};
std::vector<MeasuredPlot> MeasuredPlots();

}  // namespace collision::report
