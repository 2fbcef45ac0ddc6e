// What the page opens with: the verdict, five plots, and everything else folded.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "tests/report/first_plots.h"
#include "tests/report/page.h"
#include "tests/report/sample_results.h"
#include "tests/report/verdict.h"

namespace collision::report {

using chart::Chart;
namespace {

VerdictLine LineOf(const v1::Results& results, const std::string& asked) {
  for (const VerdictLine& line : VerdictsOf(results)) {
    if (line.asked.find(asked) != std::string::npos) return line;
  }
  throw std::logic_error(asked);
}

std::string PageOfSample() {
  const v1::Results results = SampleResults();
  const auto sections = SectionsOf(results);
  std::map<std::string, std::string> pictures;
  for (const Section& section : sections) {
    for (const Chart& chart : section.charts) pictures[chart.id] = chart.id;
  }
  for (const FirstPlot& plot : FirstPlotsOf(sections)) pictures[plot.chart.id] = plot.chart.id;
  return PageOf(results, sections, pictures, nullptr);
}

// Goal:   nothing is kept that was not measured, and all is measured where all experiments ran.
TEST(ReportVerdict, NothingIsKeptUnmeasured) {
  for (const VerdictLine& line : VerdictsOf({})) {
    EXPECT_EQ(line.verdict, Verdict::kNotMeasured) << line.asked;
    EXPECT_EQ(line.words, "not measured");
    EXPECT_EQ(line.beaten_by, "-");
  }
  for (const VerdictLine& line : VerdictsOf(SampleResults())) {
    EXPECT_NE(line.verdict, Verdict::kNotMeasured) << line.asked;
    EXPECT_FALSE(line.bound.empty() || line.measured.empty() || line.beaten_by.empty());
  }
  EXPECT_EQ(SummaryOf(VerdictsOf({})).find("0 of "), 0u);
}

// Goal:   a bound from below is kept at its value and missed below it, by the factor that lacks.
TEST(ReportVerdict, MissedSaysByWhichFactor) {
  v1::Results results = SampleResults();
  const char* asked = "Updates a second";
  EXPECT_EQ(LineOf(results, asked).verdict, Verdict::kMissed);
  EXPECT_EQ(LineOf(results, asked).words, "missed by 2 ×");
  EXPECT_EQ(LineOf(results, asked).measured, "0.35 ×: 35,000 a second");
  EXPECT_EQ(LineOf(results, asked).beaten_by, "no-op program: 100,000 a second");
  SetFigure(&results, "service", "service_updates_ratio_10000", 0.699);
  EXPECT_EQ(LineOf(results, asked).verdict, Verdict::kMissed);
  SetFigure(&results, "service", "service_updates_ratio_10000", 0.7);
  EXPECT_EQ(LineOf(results, asked).verdict, Verdict::kKept);
  EXPECT_EQ(LineOf(results, asked).words, "kept");
}

// Goal:   the same of a bound from above; a little too much is told in percent.
TEST(ReportVerdict, ABoundFromAboveIsMissedAboveIt) {
  v1::Results results = SampleResults();
  const auto words = [&](double ratio) {
    SetFigure(&results, "service", "service_event_p50_ratio_10000", ratio);
    return LineOf(results, "From an update to its event").words;
  };
  EXPECT_EQ(words(2), "kept");
  EXPECT_EQ(words(8), "missed by 4 ×");
  EXPECT_EQ(words(2.1), "missed by 5 %");
}

// Goal:   one wrong answer of any kind is enough.
TEST(ReportVerdict, CountsMustBeNone) {
  for (const char* figure : {"ours_misses", "ours_false_alarms", "ours_brackets_without_the_truth",
                             "contact_ours_misses", "contact_ours_false_alarms",
                             "contact_ours_brackets_without_the_truth"}) {
    v1::Results results = SampleResults();
    EXPECT_EQ(LineOf(results, "wrong answers").words, "kept");
    EXPECT_EQ(LineOf(results, "wrong answers").beaten_by,
              "nobody; the libraries, each at its best setting: 26");
    SetFigure(&results, "precision", figure, 1);
    EXPECT_EQ(LineOf(results, "wrong answers").words, "missed by 1") << figure;
  }
  v1::Results results = SampleResults();
  EXPECT_EQ(LineOf(results, "told late").measured, "0 of 1,200");
  for (const char* field : {"late", "unheard"}) {
    v1::Results late = SampleResults();
    (*SampleExperiment(&late, "faults")->mutable_measurements(0)->mutable_fields())[field]
        .set_number_value(2);
    EXPECT_EQ(LineOf(late, "told late").words, "missed by 2") << field;
  }
}

// Goal:   cases and take-overs that are not kept are counted.
TEST(ReportVerdict, BrokenCasesAreCounted) {
  v1::Results results = SampleResults();
  const auto first_row = [&](const char* experiment) {
    return SampleExperiment(&results, experiment)->mutable_measurements(0)->mutable_fields();
  };
  EXPECT_EQ(LineOf(results, "bad client").measured, "2 of 2 cases kept");
  (*first_row("soak"))["kept"].set_string_value("NO");
  EXPECT_EQ(LineOf(results, "bad client").measured, "1 of 2 cases kept");
  EXPECT_EQ(LineOf(results, "bad client").verdict, Verdict::kMissed);
  EXPECT_EQ(LineOf(results, "successor").measured, "6 of 6 in time");
  (*first_row("network"))["within_lease_and_50_ms"].set_number_value(1);
  EXPECT_EQ(LineOf(results, "successor").words, "missed by 1");
}

// Goal:   the best other is named, whether it is behind or ahead; neither variants of ours nor
//         libraries whose answers are wrong compete.
TEST(ReportVerdict, NamesTheBestOther) {
  const v1::Results results = SampleResults();
  EXPECT_EQ(LineOf(results, "two meshes touch").beaten_by, "nobody; next FCL OBB: 1.5 × our time");
  EXPECT_EQ(LineOf(results, "building its tree").beaten_by, "FCL OBBRSS: 0.05 × our time");
  EXPECT_EQ(LineOf(results, "from scratch").beaten_by,
            "nobody; next Embree, windows: 2 × our time");
  EXPECT_EQ(LineOf(results, "has news").beaten_by, "nobody; next Bullet: 20 × our time");
  EXPECT_EQ(LineOf(results, "in crowds").beaten_by, "Embree, windows: 0.5 × our time");
}

// Goal:   the bracket is that of the default budget, not of the greatest.
TEST(ReportVerdict, TheBracketIsOfTheDefaultBudget) {
  EXPECT_EQ(LineOf(SampleResults(), "Median width").measured, "50 µs");
}

// Goal:   five plots, whatever was measured; of ours one curve.
TEST(ReportFirstPlots, AreFive) {
  const auto plots = FirstPlotsOf(SectionsOf(SampleResults()));
  ASSERT_EQ(plots.size(), 5u);
  for (const FirstPlot& plot : plots) ASSERT_FALSE(plot.chart.empty()) << plot.title;
  EXPECT_EQ(plots[0].chart.series[0].name, "ours: fitted tree, by width");
  EXPECT_TRUE(plots[0].chart.series[1].name.starts_with("FCL"));
  EXPECT_EQ(FirstPlotsOf(SectionsOf({})).size(), 5u);
}

// Goal:   the verdict comes first, then the plots; all else is folded; each link leads somewhere.
TEST(ReportFront, VerdictThenPlotsThenFoldedParts) {
  const std::string page = PageOfSample();
  const std::size_t verdict = page.find("id=\"verdict\""), plots = page.find("id=\"plots\""),
                    parts = page.find("<details class=\"part\"");
  ASSERT_NE(parts, std::string::npos);
  EXPECT_LT(verdict, plots);
  EXPECT_LT(plots, parts);
  const std::string front = page.substr(0, parts);
  std::size_t figures = 0;
  for (std::size_t at = 0; (at = front.find("<figure", at)) != std::string::npos; ++at) ++figures;
  EXPECT_EQ(figures, 5u);
  for (const Section& section : SectionsOf(SampleResults())) {
    EXPECT_NE(page.find("<details class=\"part\" id=\"" + section.id + "\">"), std::string::npos);
  }
  EXPECT_EQ(page.find("<details open"), std::string::npos);
  const std::regex link("href=\"#([^\"]*)\"");
  for (std::sregex_iterator at(page.begin(), page.end(), link); at != std::sregex_iterator();
       ++at) {
    EXPECT_NE(page.find("id=\"" + (*at)[1].str() + "\""), std::string::npos) << (*at)[1];
  }
}

// Goal:   an id is given once, so that a link leads to one place.
TEST(ReportFront, NoIdIsGivenTwice) {
  const std::string page = PageOfSample();
  const std::regex id("<[^>]* id=\"([^\"]*)\"");
  std::set<std::string> ids;
  for (std::sregex_iterator at(page.begin(), page.end(), id); at != std::sregex_iterator(); ++at) {
    EXPECT_TRUE(ids.insert((*at)[1]).second) << (*at)[1];
  }
  EXPECT_GT(ids.size(), 20u);
}

}  // namespace
}  // namespace collision::report
