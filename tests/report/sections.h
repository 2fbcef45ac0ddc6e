// What the page shows, in its order: texts, plots and tables of what was measured.
#pragma once

#include <string>
#include <vector>

#include "idl/report.pb.h"
#include "tests/report/section.h"

namespace collision::report {

/// A section whose experiments are all missing says so. Every measurement of every experiment is in
/// a folded table at least.
std::vector<Section> SectionsOf(const v1::Results& results);

/// The plots that MEASURED.md shows, by their ids, and the caption of each.
struct MeasuredPlot {
  std::string id, caption;
};
std::vector<MeasuredPlot> MeasuredPlots();

}  // namespace collision::report
