// The page of the report, and the plots of it that the page of measurements shows.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "idl/report.pb.h"
#include "tests/report/compare.h"
#include "tests/report/sections.h"

namespace collision::report {

/// The page as one self-contained file: `pictures` (SVG, by the ids of their charts) are part of
/// it. It is laid out for narrow screens and paper as well.
std::string PageOf(const v1::Results& results, const std::vector<Section>& sections,
                   const std::map<std::string, std::string>& pictures,
                   const Comparison* comparison);

/// `page` (Markdown) with the lines between the two marks of the report replaced by the plots in
/// `plots_folder` (as the page names it) and their captions. Throws std::runtime_error if the marks
/// are missing.
std::string WithPlots(const std::string& page, const v1::Results& results,
                      const std::string& plots_folder);

}  // namespace collision::report
