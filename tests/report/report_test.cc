// The report's texts, plots and comparison, on results that are small enough to know by heart.
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "client/programs/chart/chart.h"
#include "tests/report/chart_rows.h"
#include "tests/report/compare.h"
#include "tests/report/page.h"
#include "tests/report/promises.h"
#include "tests/report/results.h"
#include "tests/report/rows.h"
#include "tests/report/sections.h"
#include "tests/report/text.h"
#include "tests/support/temporary_path.h"

namespace collision::report {

using chart::Chart;
using chart::Csv;
using chart::GnuplotScript;
namespace {

using Fields = std::vector<std::pair<std::string, double>>;

Row RowOf(const std::string& method, const Fields& numbers) {
  Row row;
  (*row.mutable_fields())["method"].set_string_value(method);
  for (const auto& [name, value] : numbers) {
    (*row.mutable_fields())[name].set_number_value(value);
  }
  return row;
}

/// Twelve timed rows that all take `seconds`, but for the i-th a hundredth of it more, i times.
v1::Results Timed(double seconds, double ratio) {
  v1::Results results;
  v1::Experiment* experiment = results.add_experiments();
  experiment->set_name("narrow-phase");
  for (int i = 0; i < 12; ++i) {
    *experiment->add_measurements() =
        RowOf(std::string("m").append(std::to_string(i)), {{"seconds", seconds * (1 + 0.001 * i)}});
  }
  v1::Figure* figure = experiment->add_figures();
  figure->set_name("ratio");
  figure->set_value(ratio);
  figure = experiment->add_figures();
  figure->set_name("contact_work_max");
  figure->set_value(1000);
  return results;
}

const Move& MoveOf(const Comparison& comparison, const std::string& figure) {
  for (const Move& move : comparison.moves) {
    if (move.figure == figure) return move;
  }
  throw std::logic_error(figure);
}

TEST(ReportText, DurationsAreReadable) {
  EXPECT_EQ(Duration(0.0000000123), "12.3 ns");
  EXPECT_EQ(Duration(0.25), "250 ms");
  EXPECT_EQ(Duration(125), "2 min 5 s");
}

// Goal:   a wrong answer is never a point among the right ones.
// Method: three rows of one method, one with misses, one given up.
TEST(ReportChart, MissesAndCutOffsStandAtInfinity) {
  const Row good = RowOf("FCL", {{"seconds", 1e-6}, {"width", 1e-3}});
  const Row missed =
      RowOf("FCL", {{"seconds", 2e-6}, {"width", 1e-9}, {"misses", 3}, {"queries", 40}});
  Chart words;
  words.id = "c", words.x_label = "x", words.y_label = "y";
  const Chart chart = ChartOf(words, {&missed, &good}, {{"method"}, "seconds", "width"});
  ASSERT_EQ(chart.series.size(), 1u);
  ASSERT_EQ(chart.series[0].points.size(), 2u);
  EXPECT_TRUE(chart.series[0].points[0].y);
  EXPECT_FALSE(chart.series[0].points[1].y);
  EXPECT_EQ(chart.series[0].points[1].note, "3 missed of 40");
  EXPECT_NE(Csv(chart).find("FCL,2e-06,inf,3 missed of 40"), std::string::npos) << Csv(chart);
  EXPECT_NE(GnuplotScript(chart, "c.svg").find("∞"), std::string::npos);
}

TEST(ReportTable, ACellPastItsCutOffSaysSo) {
  const Row row = RowOf("CGAL", {{"cut_off_s", 5}});
  const Table table = TableOf("t", {&row}, {{"method", "who"}, {"seconds", "time"}});
  EXPECT_EQ(table.rows.at(0).at(1), "> 5 s");
}

// Goal:   what moves with everything else is noise of the machine, what moves alone by more is
//         shown, and counts have no noise.
TEST(ReportCompare, TellsWhatMovedByMoreThanTheNoise) {
  v1::Results before = Timed(1, 2.0), after = Timed(1, 3.0);
  Comparison comparison = Compare(before, after);
  EXPECT_TRUE(MoveOf(comparison, "ratio").moved);
  EXPECT_NEAR(MoveOf(comparison, "ratio").change, 0.5, 1e-12);
  EXPECT_FALSE(MoveOf(comparison, "contact_work_max").moved);

  // The rows' times now lie far apart: a half more is not much.
  auto* rows = after.mutable_experiments(0)->mutable_measurements();
  for (int i = 0; i < rows->size(); i += 2) {
    (*rows->Mutable(i)->mutable_fields())["seconds"].set_number_value(2.0);
  }
  comparison = Compare(before, after);
  EXPECT_FALSE(MoveOf(comparison, "ratio").moved) << MoveOf(comparison, "ratio").noise;
  after.mutable_experiments(0)->mutable_figures(1)->set_value(1001);
  comparison = Compare(before, after);
  EXPECT_TRUE(MoveOf(comparison, "contact_work_max").moved);
}

TEST(ReportCompare, OtherHashesAreRemarked) {
  v1::Results before = Timed(1, 2), after = Timed(1, 2);
  for (v1::Results* results : {&before, &after}) {
    (*results->mutable_experiments(0)->mutable_measurements(3)->mutable_fields())["hash"]
        .set_string_value(results == &before ? "aa" : "bb");
  }
  EXPECT_TRUE(Compare(before, before).remarks.empty());
  ASSERT_EQ(Compare(before, after).remarks.size(), 1u);
  EXPECT_NE(Compare(before, after).remarks[0].find("m3"), std::string::npos);
}

// Goal:   the noise is what equal work differed by.
TEST(ReportResults, NoiseIsTheSpreadOfTheReference) {
  v1::Results results;
  for (int i = 0; i <= 20; ++i) results.add_reference_s(1 + 0.01 * i);
  EXPECT_NEAR(NoiseOf(results), 0.18 / 1.1, 1e-12);
}

TEST(ReportResults, JsonIsReadAgain) {
  const v1::Results results = Timed(0.25, 2);
  const std::string path = TemporaryPath("results.json");
  WriteFile(path, ToJson(results));
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(FromJson(path), results));
  WriteFile(path, "{\"machine\": 3}");
  EXPECT_THROW(FromJson(path), std::runtime_error);
}

// Goal:   the page is one file, names every section, and says what is missing and what failed.
TEST(ReportPage, SaysWhatIsMissingAndWhatFailed) {
  v1::Results results = Timed(1, 2);
  results.mutable_experiments(0)->set_failure("exit status 3");
  const auto sections = SectionsOf(results);
  const std::string page = PageOf(results, sections, {}, nullptr);
  EXPECT_NE(page.find("narrow-phase: exit status 3"), std::string::npos);
  EXPECT_NE(page.find("precision: not in this report."), std::string::npos);
  for (const Section& section : sections) {
    EXPECT_NE(page.find("id=\"" + section.id + "\""), std::string::npos) << section.id;
  }
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
}

// Goal:   what was broken is seen at once, as the programs write it.
// Method: a case of ./run stress that is not kept, and mutants that nothing noticed.
TEST(ReportPage, MarksWhatIsBroken) {
  const auto is_marked = [](const char* experiment, const char* field, const char* value) {
    v1::Results results;
    v1::Experiment* added = results.add_experiments();
    added->set_name(experiment);
    (*added->add_measurements()->mutable_fields())[field].set_string_value(value);
    const std::string page = PageOf(results, SectionsOf(results), {}, nullptr);
    return page.find("<td class=\"bad\">" + std::string(value) + "<") != std::string::npos;
  };
  EXPECT_FALSE(is_marked("stress", "kept", "yes"));
  EXPECT_TRUE(is_marked("stress", "kept", "NO"));
  EXPECT_TRUE(is_marked("mutants", "killed_by", "SURVIVES"));
  EXPECT_TRUE(is_marked("mutants", "killed_by", "ERROR"));
}

/// Of 50 take-overs that take 101, 102, ... ms, all but the last two are in time.
v1::Results TakenOver() {
  v1::Results results;
  v1::Experiment* network = results.add_experiments();
  network->set_name("network");
  Row* row = network->add_measurements();
  *row = RowOf("", {{"take_overs", 50},
                    {"promised_ms", 148},
                    {"within_lease_and_50_ms", 48},
                    {"p50_ms", 125},
                    {"p90_ms", 145},
                    {"max_ms", 150}});
  auto& fields = *row->mutable_fields();
  for (const auto& [field, text] :
       {std::pair{"group", "take-over"}, {"name", "killed"}, {"kept", "yes"}}) {
    fields[field].set_string_value(text);
  }
  for (int ms = 101; ms <= 150; ++ms) {
    fields["take_over_ms"].mutable_list_value()->add_values()->set_number_value(ms);
  }
  return results;
}

const Section& LoadAndFaultsOf(const std::vector<Section>& sections) {
  for (const Section& section : sections) {
    if (section.id == "load-and-faults") return section;
  }
  throw std::logic_error("no such section");
}

// Goal:   how long take-overs take is seen as a distribution, beside what is promised.
TEST(ReportLoadAndFaults, TakeOversRiseToAllOfThemBesideThePromise) {
  const auto sections = SectionsOf(TakenOver());
  const Section& section = LoadAndFaultsOf(sections);
  ASSERT_EQ(section.charts.size(), 1u);
  const Chart& chart = section.charts[0];
  ASSERT_EQ(chart.series.size(), 2u);
  EXPECT_EQ(chart.series[0].name, "killed");
  ASSERT_EQ(chart.series[0].points.size(), 50u);
  EXPECT_EQ(chart.series[0].points[0].y, 2.0);
  EXPECT_EQ(chart.series[0].points[47].x, chart.series[1].points[0].x);
  EXPECT_EQ(chart.series[0].points[49].y, 100.0);
}

// Goal:   a figure that is not reached is shown as not reached, with what was measured.
TEST(ReportLoadAndFaults, WhatIsNotReachedSaysSo) {
  const auto kept = [](const v1::Results& results, std::size_t line) {
    const auto sections = SectionsOf(results);
    return LoadAndFaultsOf(sections).tables.at(0).rows.at(line).back();
  };
  v1::Results results = TakenOver();
  EXPECT_EQ(kept(results, 0), "NO");
  EXPECT_EQ(kept(results, 1), "yes");
  auto& fields = *results.mutable_experiments(0)->mutable_measurements(0)->mutable_fields();
  fields["within_lease_and_50_ms"].set_number_value(50);
  EXPECT_EQ(kept(results, 0), "yes");
  fields["kept"].set_string_value("NO");
  EXPECT_EQ(kept(results, 0), "NO");
  EXPECT_EQ(kept(results, 1), "NO");

  v1::Experiment* service = results.add_experiments();
  service->set_name("service");
  EXPECT_EQ(kept(results, 2), "NO");  // not measured
  v1::Figure* figure = service->add_figures();
  figure->set_name("crowd_event_p50_ratio");
  figure->set_value(2.01);
  EXPECT_EQ(kept(results, 2), "NO");
  figure->set_value(1.99);
  EXPECT_EQ(kept(results, 2), "yes");
}

// Goal:   a case in few words, and one that broke with all of them.
TEST(ReportLoadAndFaults, ABrokenCaseTellsAll) {
  v1::Results results;
  v1::Experiment* faults = results.add_experiments();
  faults->set_name("faults");
  Row* row = faults->add_measurements();
  *row = RowOf("", {{"runs", 60}, {"late", 1}});
  (*row->mutable_fields())["measured"].set_string_value("BROKEN (1 of 9 checks): seed 7");
  const auto measured = [&](const char* kept) {
    (*row->mutable_fields())["kept"].set_string_value(kept);
    const auto sections = SectionsOf(results);
    return LoadAndFaultsOf(sections).tables.at(0).rows.at(0).at(2);
  };
  EXPECT_EQ(measured("yes"), "60 runs, 1 late");
  EXPECT_EQ(measured("NO"), "BROKEN (1 of 9 checks): seed 7");
}

TEST(ReportPage, ReplacesThePlotsBetweenTheMarks) {
  const std::string page = "a\n<!-- report: begin -->\nold\n<!-- report: end -->\nb\n";
  const std::string changed = WithPlots(page, {}, "plots");
  EXPECT_EQ(changed.find("old"), std::string::npos);
  EXPECT_TRUE(changed.starts_with("a\n") && changed.ends_with("<!-- report: end -->\nb\n"));
  EXPECT_NE(changed.find("(plots/" + MeasuredPlots()[0].id + ".svg)"), std::string::npos);
  EXPECT_THROW(WithPlots("no marks", {}, "plots"), std::runtime_error);
}

// A count above its bound breaks a promise, and so does one that was not measured; an experiment
// that is not there promises nothing, one that failed is shown.
TEST(ReportPromises, AreBrokenByCountsAndByFailures) {
  v1::Results results;
  EXPECT_TRUE(BrokenIn(results).empty());
  v1::Experiment* experiment = results.add_experiments();
  experiment->set_name("hubbard");
  v1::Figure* differ = experiment->add_figures();
  differ->set_name("frames_that_differ");
  differ->set_value(0);
  EXPECT_EQ(PromisesOf(results).size(), 2u);
  ASSERT_EQ(BrokenIn(results).size(), 1u);
  EXPECT_NE(BrokenIn(results)[0].find("service_missed is not measured"), std::string::npos);
  v1::Figure* missed = experiment->add_figures();
  missed->set_name("service_missed");
  missed->set_value(1);
  ASSERT_EQ(BrokenIn(results).size(), 1u);
  EXPECT_NE(BrokenIn(results)[0].find("service_missed is 1, at most 0"), std::string::npos);
  missed->set_value(0);
  EXPECT_TRUE(BrokenIn(results).empty());
  experiment->set_failure("exit status 1: no");
  EXPECT_EQ(BrokenIn(results), std::vector<std::string>{"hubbard: exit status 1: no"});
}

}  // namespace
}  // namespace collision::report
