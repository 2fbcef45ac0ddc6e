// The page that people look at, and the lines about it in the README.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "idl/report.pb.h"
#include "tests/report/compare.h"
#include "tests/report/sections.h"

namespace collision::report {

/// One file without any other: pictures (SVG, by the ids of their charts) are in it. Narrow screens
/// and paper are thought of.
std::string PageOf(const v1::Results& results, const std::vector<Section>& sections,
                   const std::map<std::string, std::string>& pictures,
                   const Comparison* comparison);

/// `readme` with the lines between the two marks of the report replaced by the plots in
/// `plots_folder` (as the README names it) and what they show. Throws std::runtime_error where the
/// marks are missing.
std::string WithPlots(const std::string& readme, const v1::Results& results,
                      const std::string& plots_folder);

}  // namespace collision::report
