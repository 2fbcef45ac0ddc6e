// One contestant, one colour and one mark on all pages; each chart says what one sees in it.
#include "tests/report/contestants.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/report/captions.h"
#include "tests/report/first_plots.h"
#include "tests/report/sample_results.h"
#include "tests/report/sections.h"

namespace collision::report {

using chart::Chart;
using chart::kDashes;
using chart::Look;
using chart::Series;
namespace {

/// The charts of all sections and those at the top.
std::vector<Chart> AllCharts() {
  const auto sections = SectionsOf(SampleResults());
  std::vector<Chart> charts;
  for (const Section& section : sections) {
    charts.insert(charts.end(), section.charts.begin(), section.charts.end());
  }
  for (const FirstPlot& plot : FirstPlotsOf(sections)) charts.push_back(plot.chart);
  return charts;
}

const Chart& ChartNamed(const std::vector<Chart>& charts, const std::string& id) {
  for (const Chart& chart : charts) {
    if (chart.id == id) return chart;
  }
  throw std::logic_error(id);
}

// Goal:   the sample has a chart of each kind; without one the tests below would test nothing.
TEST(ReportCharts, TheSampleHasAllKinds) {
  const auto charts = AllCharts();
  for (const char* id : {"distance-translation-homer-500",
                         "distance-translation-box-and-hull",
                         "contact-translation-boxes",
                         "budget-begin",
                         "budget-depth",
                         "budget-undecided",
                         "turk-over-ours",
                         "turk-0.01",
                         "turk-0.1",
                         "turk-1",
                         "turk-10",
                         "frames-20-drones",
                         "satellites",
                         "scratch-at_once",
                         "scratch-half",
                         "scratch-never",
                         "streaming",
                         "service-event",
                         "service-event-p99",
                         "service-throughput",
                         "messages-acceleration",
                         "messages-spacing",
                         "messages-speed",
                         "take-over"}) {
    EXPECT_NO_THROW(ChartNamed(charts, id));
  }
}

// Goal:   no chart leaves its reader alone.
TEST(ReportCharts, EachHasACaption) {
  for (const Chart& chart : AllCharts()) {
    EXPECT_FALSE(chart.caption.empty()) << chart.id;
    EXPECT_TRUE(chart.caption.ends_with('.')) << chart.id << ": " << chart.caption;
  }
}

// Goal:   two contestants of a chart are told apart, also in a print without colours; variants of
//         one differ in dash alone.
TEST(ReportCharts, ContestantsOfAChartDifferInColourAndMark) {
  for (const Chart& chart : AllCharts()) {
    for (const Series& a : chart.series) {
      for (const Series& b : chart.series) {
        if (&a >= &b) continue;
        const std::string pair = chart.id + ": " + a.name + ", " + b.name;
        ASSERT_TRUE(a.look && b.look) << pair;
        if (ContestantOf(a.name) == ContestantOf(b.name)) {
          EXPECT_EQ(a.look->colour, b.look->colour) << pair;
          EXPECT_EQ(a.look->mark, b.look->mark) << pair;
          EXPECT_NE(a.look->dash, b.look->dash) << pair;
        } else {
          EXPECT_NE(a.look->colour, b.look->colour) << pair;
          EXPECT_NE(a.look->mark, b.look->mark) << pair;
        }
      }
    }
  }
}

// Goal:   what is learned from one chart holds on the next.
TEST(ReportCharts, AContestantLooksTheSameOnAllCharts) {
  std::map<std::string, Look> contestants, series;
  for (const Chart& chart : AllCharts()) {
    for (const Series& of_chart : chart.series) {
      const std::string name = WithoutGrowth(of_chart.name);
      const Look look = *of_chart.look;
      const Look first = contestants.try_emplace(ContestantOf(name), look).first->second;
      EXPECT_EQ(look.colour, first.colour) << chart.id << ": " << name;
      EXPECT_EQ(look.mark, first.mark) << chart.id << ": " << name;
      EXPECT_EQ(look, series.try_emplace(name, look).first->second) << chart.id << ": " << name;
    }
  }
  for (const char* name : {"ours", "FCL", "Bullet", "Embree", "CGAL", "ODE", "Turk", "BSP trees",
                           "no-op program", "stepping"}) {
    EXPECT_TRUE(contestants.contains(name)) << name;
  }
}

TEST(Contestant, IsWhatItsSeriesBeginsWith) {
  EXPECT_EQ(ContestantOf("FCL, windows"), "FCL");
  EXPECT_EQ(ContestantOf("FCL OBBRSS distance"), "FCL");
  EXPECT_EQ(ContestantOf("ours: octree, by width"), "ours");
  EXPECT_EQ(ContestantOf("ours (N^1.10)"), "ours");
  EXPECT_EQ(ContestantOf("FCLX"), "FCLX");
}

// Goal:   variants that nobody has listed are told apart, too.
// Method: as many as there are dashes; some have the same dash by their letters.
TEST(Contestant, UnknownVariantsDifferInDash) {
  Chart chart;
  for (int i = 0; i < kDashes; ++i) {
    chart.series.push_back({"FCL, way " + std::to_string(i * i), {}, false, "", {}});
  }
  DrawByContestant(&chart);
  std::set<int> dashes;
  for (const Series& series : chart.series) dashes.insert(series.look->dash);
  EXPECT_EQ(dashes.size(), static_cast<std::size_t>(kDashes));
}

// Goal:   a caption says who is ahead, and by how much, at the end that matters.
// Method: numbers of which the ratios are known: 2 at 100,000 agents, 4 at 1,000.
TEST(ReportCaptions, CompareAtTheEnd) {
  Chart chart;
  chart.series = {{"ours", {{1000, 1e-3, ""}, {1e5, 0.01, ""}}, true, "", {}},
                  {"ours: all-pairs", {{1e5, 1e-9, ""}}, false, "", {}},
                  {"FCL", {{1000, 4e-3, ""}, {1e5, 0.5, ""}}, false, "", {}},
                  {"Bullet (N^1.10)", {{1000, 5e-3, ""}, {1e5, 0.02, ""}}, false, "", {}}};
  EXPECT_EQ(TimesAtTheEnd(chart, "agents"),
            "With 100,000 agents ours takes 10 ms and the best other, Bullet, 20 ms: that takes 2 "
            "times as long.");
  chart.series[3].points[1].y = 0.0025;
  EXPECT_NE(TimesAtTheEnd(chart, "agents").find("ours takes 4 times as long."), std::string::npos);
  EXPECT_NE(RatesAtTheEnd(chart, "agents", "a second").find("FCL 0.5: ours reaches 0.02 of it."),
            std::string::npos);
  chart.series[0].points.clear();
  EXPECT_EQ(TimesAtTheEnd(chart, "agents"), "");
}

// Goal:   ours is timed at what it certifies, not at a wider answer; wrong answers are named.
TEST(ReportCaptions, CompareAtEqualError) {
  Chart chart;
  chart.series = {{"ours: a", {{1e-6, 1e-3, ""}, {5e-6, 1e-6, ""}}, true, "", {}},
                  {"FCL", {{20e-6, 2e-6, ""}}, false, "", {}},
                  {"Bullet", {{1e-6, std::nullopt, "3 missed"}}, false, "", {}}};
  const auto all = AtEqualError(chart, kDistanceFloor);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].ours_s, 5e-6);
  EXPECT_DOUBLE_EQ(all[0].ratio(), 4);
  EXPECT_EQ(MostExact(chart, kDistanceFloor, "m"),
            "FCL comes within 2e-06 m in 20 µs; ours certifies as much in 5 µs. Wrong at times "
            "(crosses): Bullet.");
}

}  // namespace
}  // namespace collision::report
