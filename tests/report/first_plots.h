// The five plots at the top of the page, which tell the story to a reader who knows nothing yet.
#pragma once

#include <string>
#include <vector>

#include "client/programs/chart/chart.h"
#include "tests/report/section.h"

namespace collision::report {

struct FirstPlot {
  std::string title;
  std::string section;  ///< The id of the section that has the rest.
  chart::Chart chart;   ///< Of ours only the usual variant. Empty: not measured.
};

/// Always five, in their order.
std::vector<FirstPlot> FirstPlotsOf(const std::vector<Section>& sections);

}  // namespace collision::report
