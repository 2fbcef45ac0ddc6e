#include "tests/report/first_plots.h"

#include <functional>

#include "tests/report/captions.h"
#include "tests/report/contestants.h"

namespace collision::report {

using chart::Chart;
using chart::Series;
namespace {

struct Choice {
  const char *id, *title, *section;
  std::function<std::string(const Chart&)> caption;
};

const std::vector<Choice>& Choices() {
  static const std::vector<Choice> choices = {
      {"distance-translation-homer-500", "How far apart are two bodies? Error against time",
       "precision",
       [](const Chart& chart) {
         return "Lower is more exact, further left is faster; ours certifies its error. " +
                MostExact(chart, kDistanceFloor, "m");
       }},
      {"scratch-half", "Which of many agents meet first?", "broad-phase",
       [](const Chart& chart) {
         return "Lower is faster; N^x is how the time grows with the agents. " +
                TimesAtTheEnd(chart, "agents");
       }},
      {"budget-begin", "What does it cost the service to have less time?", "budget",
       [](const Chart& chart) {
         return "How wide the bracket of a contact's begin is, over the time that the service may "
                "spend on a pair; from the least budget to the greatest: " +
                FirstToLast(chart, "ms");
       }},
      {"service-throughput", "How much can the service take in?", "service",
       [](const Chart& chart) {
         return "Higher is better; the no-op program does nothing but answer. " +
                RatesAtTheEnd(chart, "agents", "updates a second");
       }},
      {"take-over", "How long does a take-over take after a fault?", "load-and-faults",
       [](const Chart& chart) { return chart.caption; }},
  };
  return choices;
}

const Chart* FindChart(const std::vector<Section>& sections, const std::string& id) {
  for (const Section& section : sections) {
    for (const Chart& chart : section.charts) {
      if (chart.id == id) return &chart;
    }
  }
  return nullptr;
}

/// Without the variants of ours that are not drawn solid.
Chart Outline(const Chart& chart) {
  Chart outline = chart;
  std::erase_if(outline.series, [](const Series& series) {
    return ContestantOf(series.name) == "ours" && series.look && series.look->dash != 0;
  });
  outline.id = "first-" + chart.id;
  return outline;
}

}  // namespace

std::vector<FirstPlot> FirstPlotsOf(const std::vector<Section>& sections) {
  std::vector<FirstPlot> plots;
  for (const Choice& choice : Choices()) {
    FirstPlot plot{choice.title, choice.section, {}};
    if (const Chart* chart = FindChart(sections, choice.id)) {
      plot.chart = Outline(*chart);
      plot.chart.caption = choice.caption(plot.chart);
    }
    plots.push_back(plot);
  }
  return plots;
}

}  // namespace collision::report
