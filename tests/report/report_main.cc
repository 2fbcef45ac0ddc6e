// report-page: the page of ./run report.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/report/compare.h"
#include "tests/report/first_plots.h"
#include "tests/report/page.h"
#include "tests/report/promises.h"
#include "tests/report/results.h"
#include "tests/report/sections.h"
#include "tests/report/text.h"

namespace collision::report {

using chart::Chart;
using chart::Csv;
using chart::Draw;
namespace {

struct Options {
  std::string parts, results, out, compare, measured, plots;
};

// Returns what is broken.
std::vector<std::string> Write(const Options& options) {
  v1::Results results =
      options.results.empty() ? Assemble(options.parts) : FromJson(options.results);
  if (results.version().empty()) results.set_version(COLLISION_VERSION);
  std::optional<Comparison> comparison;
  if (!options.compare.empty()) comparison = Compare(FromJson(options.compare), results);
  std::filesystem::create_directories(options.out);
  WriteFile(options.out + "/results.json", ToJson(results));
  const std::vector<Section> sections = SectionsOf(results);
  std::map<std::string, std::string> pictures;
  const auto draw = [&](const Chart& chart) {
    WriteFile(options.out + "/" + chart.id + ".csv", Csv(chart));
    pictures[chart.id] = Draw(chart, options.out);
  };
  for (const Section& section : sections) {
    for (const Chart& chart : section.charts) draw(chart);
  }
  for (const FirstPlot& plot : FirstPlotsOf(sections)) {
    if (!plot.chart.empty()) draw(plot.chart);
  }
  WriteFile(options.out + "/index.html",
            PageOf(results, sections, pictures, comparison ? &*comparison : nullptr));
  if (comparison) std::printf("%s", TextOf(*comparison).c_str());
  if (options.measured.empty()) return BrokenIn(results);
  std::filesystem::create_directories(options.plots);
  for (const MeasuredPlot& plot : MeasuredPlots()) {
    const auto picture = pictures.find(plot.id);
    if (picture == pictures.end()) {
      throw std::runtime_error("plot " + plot.id + " of the measurements was not measured");
    }
    WriteFile(options.plots + "/" + plot.id + ".svg", picture->second);
  }
  const auto folder = std::filesystem::absolute(options.measured).parent_path();
  const std::string named = std::filesystem::relative(options.plots, folder).string();
  WriteFile(options.measured, WithPlots(ReadFile(options.measured), results, named));
  return BrokenIn(results);
}

}  // namespace
}  // namespace collision::report

int main(int count, char** arguments) {
  using namespace collision::report;
  Options options;
  bool reference = false;
  CLI::App app(
      "Writes the page of ./run report: index.html, results.json, and each plot's SVG and CSV.",
      "report-page");
  app.add_flag("--reference", reference,
               "only time the reference's piece of work, and print it [s]");
  app.add_option("--parts", options.parts, "folder with what the experiments wrote");
  app.add_option("--results", options.results, "results.json of a report, instead of --parts");
  app.add_option("--out", options.out, "folder of the page");
  app.add_option("--compare", options.compare, "results.json of an older report: say what moved");
  app.add_option("--measured", options.measured, "replace the plots between this file's marks");
  app.add_option("--plots", options.plots, "folder of that page's plots");
  CLI11_PARSE(app, count, arguments);
  try {
    if (reference) {
      std::printf("%.9g\n", TimeReference());
    } else if (options.out.empty() || options.parts.empty() == options.results.empty()) {
      std::fprintf(stderr, "report-page: --out, and one of --parts and --results; see --help\n");
      return 2;
    } else {
      const std::vector<std::string> broken = Write(options);
      for (const std::string& line : broken)
        std::fprintf(stderr, "report-page: %s\n", line.c_str());
      return broken.empty() ? 0 : 1;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "report-page: %s\n", error.what());
    return 74;
  }
}
