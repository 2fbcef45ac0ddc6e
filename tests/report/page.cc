#include "tests/report/page.h"

#include <algorithm>
#include <stdexcept>

#include "client/programs/shared/web_text.h"
#include "tests/report/first_plots.h"
#include "tests/report/page_frame.h"
#include "tests/report/promises.h"
#include "tests/report/results.h"
#include "tests/report/text.h"
#include "tests/report/verdict.h"

namespace collision::report {

using client::EscapeHtml;

using chart::Chart;
using chart::Series;
namespace {

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

/// `heading` stands above the plot, `more` behind its caption.
std::string ChartHtml(const Chart& chart, const std::string& svg, const std::string& heading,
                      const std::string& more = "") {
  std::string html = "<figure id=\"" + chart.id + "\">" + heading;
  html += "<img alt=\"" + EscapeHtml(chart.title) + "\" src=\"data:image/svg+xml;base64," +
          client::Base64(svg) + "\">\n<figcaption>" + EscapeHtml(chart.caption) + more;
  std::string limits;
  for (const Series& series : chart.series) {
    if (series.note.empty()) continue;
    limits += "<li>" + EscapeHtml(series.name) + ": " + EscapeHtml(series.note) + "</li>";
  }
  if (!limits.empty()) {
    html += "<details><summary>What limits each curve</summary><ul>" + limits + "</ul></details>";
  }
  return html + " <span class=\"small\">(" + chart.id + ".csv)</span></figcaption></figure>\n";
}

std::string MachineHtml(const v1::Results& results) {
  const v1::Machine& machine = results.machine();
  Table table{"", {"", ""}, {}};
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
  Table table{"", {"promise", "experiment", "measured", "at most", "kept"}, {}};
  for (const PromiseLine& line : PromisesOf(results)) {
    table.rows.push_back({line.words, line.experiment, line.measured, Short(line.at_most),
                          line.kept ? "yes" : "NO"});
  }
  return table.rows.empty() ? "" : TableHtml(table);
}

std::string PromisesTitle(const v1::Results& results) {
  const std::vector<PromiseLine> lines = PromisesOf(results);
  const auto kept = std::count_if(lines.begin(), lines.end(), [](const auto& l) { return l.kept; });
  return "Counts that must hold on any machine: " + std::to_string(kept) + " of " +
         std::to_string(lines.size()) + " kept";
}

std::string ComparisonHtml(const Comparison& comparison) {
  std::string html;
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

/// One line of the verdict; on a narrow screen each cell stands below the one before, with the
/// column's title.
std::string VerdictRow(const VerdictLine& line) {
  const char* kind = line.verdict == Verdict::kKept     ? "kept"
                     : line.verdict == Verdict::kMissed ? "missed"
                                                        : "unknown";
  const auto cell = [](const char* title, const std::string& text) {
    return std::string("<td data-title=\"") + title + "\">" + EscapeHtml(text) + "</td>";
  };
  return std::string("<tr class=\"") + kind + "\"><th scope=\"row\">" + EscapeHtml(line.asked) +
         "</th>" + cell("asked", line.bound) + cell("measured", line.measured) +
         cell("verdict", line.words) + cell("beaten by", line.beaten_by) + "</tr>\n";
}

std::string VerdictHtml(const v1::Results& results) {
  const std::vector<VerdictLine> lines = VerdictsOf(results);
  std::string html = "<h2 id=\"verdict\">Verdict: " + EscapeHtml(SummaryOf(lines)) +
                     "</h2>\n<table class=\"verdict\"><thead><tr><th>question</th><th>asked"
                     "</th><th>measured</th><th>verdict</th><th>beaten by</th></tr></thead>\n";
  std::string group;
  for (const VerdictLine& line : lines) {
    if (line.group != group) {
      html += (group.empty() ? "<tbody>" : "</tbody><tbody>") +
              std::string("<tr><th class=\"group\" colspan=\"5\" scope=\"rowgroup\">") +
              EscapeHtml(line.group) + "</th></tr>\n";
      group = line.group;
    }
    html += VerdictRow(line);
  }
  return html + "</tbody></table>\n";
}

std::string FirstPlotsHtml(const std::vector<FirstPlot>& plots,
                           const std::map<std::string, std::string>& pictures) {
  std::string html = "<h2 id=\"plots\">Five plots</h2>\n<div class=\"charts\">\n";
  for (const FirstPlot& plot : plots) {
    const std::string heading = "<h3>" + EscapeHtml(plot.title) + "</h3>\n";
    if (plot.chart.empty()) {
      html += "<figure>" + heading + "<p class=\"small\">Not measured in this run.</p></figure>\n";
      continue;
    }
    html += ChartHtml(plot.chart, pictures.at(plot.chart.id), heading,
                      " <a href=\"#" + plot.section + "\">More of it.</a>");
  }
  return html + "</div>\n";
}

/// What unfolds under its title; links to `id` unfold it.
std::string Folded(const std::string& id, const std::string& title, const std::string& html) {
  return "<details class=\"part\" id=\"" + id + "\"><summary>" + EscapeHtml(title) +
         "</summary>\n" + html + "</details>\n";
}

std::string SectionHtml(const Section& section,
                        const std::map<std::string, std::string>& pictures) {
  std::string html;
  for (const std::string& text : section.paragraphs) html += Paragraph(text);
  html += "<div class=\"charts\">\n";
  for (const Chart& chart : section.charts) {
    html += ChartHtml(chart, pictures.at(chart.id), "<h4>" + EscapeHtml(chart.title) + "</h4>\n");
  }
  html += "</div>\n";
  for (const Table& table : section.tables) html += TableHtml(table);
  return html;
}

/// "Error against run time: 12 plots, 3 tables"
std::string TitleOf(const Section& section) {
  const auto counted = [](std::size_t count, const char* what) {
    return count == 0 ? "" : ", " + std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  };
  if (section.charts.empty() && section.tables.empty()) return section.title + ", not measured";
  return section.title + counted(section.charts.size(), "plot") +
         counted(section.tables.size(), "table");
}

std::string Intro(const v1::Results& results) {
  std::string html =
      "<h1>collisiond, measured</h1>\n<p>collisiond tells simulators in advance which of their "
      "agents could touch, and afterwards which did. This page says what was asked of it, what was "
      "measured, and which other program does better.</p>\n<p class=\"small\">" +
      EscapeHtml(results.finished()) +
      (results.quick() ? ", a quick run: fewer cells and repetitions" : "") + "; " +
      EscapeHtml(results.machine().processor()) + "; equal work took times that differ by " +
      Rounded(100 * NoiseOf(results)) +
      " % during the run. Compare times of one page only: they depend on the machine.</p>\n";
  for (const std::string& broken : BrokenIn(results)) {
    html += "<p class=\"bad\">" + EscapeHtml(broken) + "</p>\n";
  }
  return html;
}

}  // namespace

std::string PageOf(const v1::Results& results, const std::vector<Section>& sections,
                   const std::map<std::string, std::string>& pictures,
                   const Comparison* comparison) {
  struct Part {
    std::string id, title, link, html;
  };
  std::vector<Part> parts;
  if (comparison != nullptr) {
    parts.push_back({"compare", "What moved since the older report", "What moved",
                     ComparisonHtml(*comparison)});
  }
  for (const Section& section : sections) {
    parts.push_back({section.id, TitleOf(section), section.title, SectionHtml(section, pictures)});
  }
  parts.push_back({"promises", PromisesTitle(results), "Promises", PromisesHtml(results)});
  parts.push_back({"machine", "Where and how: the machine, the versions and the commands",
                   "Where and how", MachineHtml(results)});
  std::string links, folded;
  for (const Part& part : parts) {
    links += "<a href=\"#" + part.id + "\">" + EscapeHtml(part.link) + "</a> ";
    folded += Folded(part.id, part.title, part.html);
  }
  return std::string(kPageHead) + Intro(results) + VerdictHtml(results) +
         FirstPlotsHtml(FirstPlotsOf(sections), pictures) +
         "<h2 id=\"rest\">Everything else</h2>\n<nav>" + links +
         "<button type=\"button\" id=\"unfold\">unfold all</button></nav>\n" + folded + kPageEnd;
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
