#include "tests/report/page.h"

#include <stdexcept>

#include "tests/report/promises.h"
#include "tests/report/results.h"
#include "tests/report/text.h"

namespace collision::report {
namespace {

constexpr char kStyle[] = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; margin: 0 auto;
       padding: 0 1rem 4rem; max-width: 62rem; }
h1 { margin-bottom: 0; } h2 { margin-top: 3rem; border-top: 1px solid #ccc; padding-top: 1rem; }
nav a { display: inline-block; margin-right: 1rem; }
.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(26rem, 100%), 1fr));
          gap: 1.5rem; }
figure { margin: 0; } figure img { width: 100%; height: auto; }
figcaption { font-size: 0.9rem; } figcaption ul { margin: 0.3rem 0 0; padding-left: 1.2rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.85rem; margin: 0.5rem 0; }
th, td { text-align: left; vertical-align: top; padding: 0.15rem 0.6rem 0.15rem 0;
         border-bottom: 1px solid #eee; font-variant-numeric: tabular-nums; }
.bad { color: #b00020; font-weight: 600; } .small { font-size: 0.85rem; color: #555; }
summary { cursor: pointer; }
@media print { nav { display: none; } h2 { break-after: avoid; } figure { break-inside: avoid; }
               .wide { overflow: visible; } body { max-width: none; font-size: 11px; } }
)";

constexpr char kBegin[] = "<!-- report: begin -->\n";
constexpr char kEnd[] = "<!-- report: end -->";

std::string Paragraph(const std::string& text) { return "<p>" + EscapeHtml(text) + "</p>\n"; }

std::string TableHtml(const Table& table) {
  std::string html = "<div class=\"wide\"><table><thead><tr>";
  for (const std::string& column : table.columns) html += "<th>" + EscapeHtml(column) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (const std::string& cell : row) {
      const bool bad = cell == "NO" || cell == "SURVIVES" || cell == "ERROR" ||
                       cell.starts_with("ANSWERS DIFFER");
      html += (bad ? "<td class=\"bad\">" : "<td>") + EscapeHtml(cell) + "</td>";
    }
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  if (table.folded) {
    return "<details><summary>" + EscapeHtml(table.title) + "</summary>\n" + html + "</details>\n";
  }
  return (table.title.empty() ? "" : "<h4>" + EscapeHtml(table.title) + "</h4>\n") + html;
}

std::string ChartHtml(const Chart& chart, const std::string& svg) {
  std::string html = "<figure id=\"" + chart.id + "\"><h4>" + EscapeHtml(chart.title) + "</h4>\n";
  html += "<img alt=\"" + EscapeHtml(chart.title) + "\" src=\"data:image/svg+xml;base64," +
          Base64(svg) + "\">\n<figcaption>" + EscapeHtml(chart.caption);
  std::string limits;
  for (const Series& series : chart.series) {
    if (series.limited_by.empty()) continue;
    limits += "<li>" + EscapeHtml(series.name) + ": " + EscapeHtml(series.limited_by) + "</li>";
  }
  if (!limits.empty()) {
    html += "<details><summary>What limits each curve</summary><ul>" + limits + "</ul></details>";
  }
  return html + " <span class=\"small\">(" + chart.id + ".csv)</span></figcaption></figure>\n";
}

std::string MachineHtml(const v1::Results& results) {
  const v1::Machine& machine = results.machine();
  Table table{"The machine and the programs", {"", ""}, {}, true};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) table.rows.push_back({name, value});
  };
  add("finished", results.finished());
  add("version", results.version());
  add("commit", results.commit());
  add("processor", machine.processor() + ", " + std::to_string(machine.processors()) + " cores");
  add("memory", Short(machine.memory_gib()) + " GiB");
  add("system", machine.system());
  add("compiler", machine.compiler());
  add("build", machine.build());
  for (const v1::Library& library : machine.libraries()) {
    add(library.name().c_str(), library.version());
  }
  for (const v1::Experiment& experiment : results.experiments()) {
    std::string seeds;
    for (const std::uint64_t seed : experiment.seeds()) seeds += " " + std::to_string(seed);
    add(experiment.name().c_str(), experiment.command() + " (" + Duration(experiment.seconds()) +
                                       (seeds.empty() ? "" : ", seeds" + seeds) + ")");
  }
  return TableHtml(table);
}

std::string PromisesHtml(const v1::Results& results) {
  Table table{"", {"promise", "experiment", "measured", "at most", "kept"}, {}, true};
  std::size_t kept = 0;
  for (const PromiseLine& line : PromisesOf(results)) {
    table.rows.push_back({line.words, line.experiment, line.measured, Short(line.at_most),
                          line.kept ? "yes" : "NO"});
    kept += line.kept;
  }
  table.title = "Promises: " + std::to_string(kept) + " of " + std::to_string(table.rows.size()) +
                " kept, beside those of the stiff and extreme cases";
  return table.rows.empty() ? "" : TableHtml(table);
}

std::string ComparisonHtml(const Comparison& comparison) {
  std::string html = "<h2 id=\"compare\">What moved</h2>\n";
  for (const std::string& remark : comparison.remarks) html += Paragraph(remark);
  Table table{"", {"experiment", "figure", "before", "after", "change", "noise", "over noise"}, {}};
  Table still = table;
  still.title = "What did not move by more than the noise", still.folded = true;
  for (const Move& move : comparison.moves) {
    std::vector<std::string> row = {
        move.experiment, move.figure, move.before, move.after, "", "", ""};
    if (!move.before.empty() && !move.after.empty()) {
      row[4] = Short(100 * move.change) + " %";
      row[5] = Short(100 * move.noise) + " %";
      if (move.noise > 0) row[6] = Short(move.OverNoise());
    }
    (move.moved ? table : still).rows.push_back(row);
  }
  return html + (table.rows.empty() ? Paragraph("Nothing.") : TableHtml(table)) + TableHtml(still);
}

}  // namespace

std::string PageOf(const v1::Results& results, const std::vector<Section>& sections,
                   const std::map<std::string, std::string>& pictures,
                   const Comparison* comparison) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>collisiond: error against run time</title>\n<style>" +
      std::string(kStyle) + "</style></head><body>\n<h1>collisiond: error against run time</h1>\n";
  html += "<p class=\"small\">" + EscapeHtml(results.finished()) +
          (results.quick() ? ", a quick run: fewer cells and repetitions" : "") + "; " +
          EscapeHtml(results.machine().processor()) + "; equal work took times that differ by " +
          Short(100 * NoiseOf(results)) +
          " % during the run. No absolute time is a result.</p>\n<nav>";
  for (const Section& section : sections) {
    html += "<a href=\"#" + section.id + "\">" + EscapeHtml(section.title) + "</a>";
  }
  html += "</nav>\n";
  for (const std::string& broken : BrokenIn(results)) {
    html += "<p class=\"bad\">" + EscapeHtml(broken) + "</p>\n";
  }
  html += PromisesHtml(results);
  if (comparison != nullptr) html += ComparisonHtml(*comparison);
  for (const Section& section : sections) {
    html += "<h2 id=\"" + section.id + "\">" + EscapeHtml(section.title) + "</h2>\n";
    for (const std::string& text : section.paragraphs) html += Paragraph(text);
    html += "<div class=\"charts\">\n";
    for (const Chart& chart : section.charts) html += ChartHtml(chart, pictures.at(chart.id));
    html += "</div>\n";
    for (const Table& table : section.tables) html += TableHtml(table);
  }
  return html + "<h2 id=\"machine\">Where and how</h2>\n" + MachineHtml(results) +
         "</body></html>\n";
}

std::string WithPlots(const std::string& page, const v1::Results& results,
                      const std::string& plots_folder) {
  const std::size_t begin = page.find(kBegin), end = page.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw std::runtime_error(std::string("the page has no '") + kEnd + "' after '" + kBegin + "'");
  }
  std::string lines;
  for (const MeasuredPlot& plot : MeasuredPlots()) {
    lines += "![" + plot.caption + "](" + plots_folder + "/" + plot.id + ".svg)\n\n" +
             plot.caption + "\n\n";
  }
  lines += "From `./run report" + std::string(results.quick() ? " --quick" : "") + "` of " +
           results.finished().substr(0, 10) + " on " + results.machine().processor() + ", " +
           std::to_string(results.machine().processors()) + " cores.\n";
  return page.substr(0, begin + sizeof kBegin - 1) + lines + page.substr(end);
}

}  // namespace collision::report
