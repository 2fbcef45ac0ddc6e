// Looks of curves that nobody has chosen one for, and what gnuplot is told of them.
#include "client/programs/chart/chart.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace collision::chart {
namespace {

/// Some of them have the same colour by their letters.
const std::vector<std::string> kEight = {"ada", "bob",   "carol", "dave",
                                         "eve", "frank", "grace", "heidi"};

Chart ChartOfNames(const std::vector<std::string>& names) {
  Chart chart;
  for (const std::string& name : names) chart.series.push_back({name, {{1, 2, ""}}, false, "", {}});
  return chart;
}

// Goal:   curves are told apart: as long as there are colours, no two curves of a chart share one,
//         nor a mark.
// Method: as many names as there are colours; more than one of them must clash by its letters.
TEST(GiveLooks, NoTwoCurvesShareAColourOrAMark) {
  const std::vector<std::string>& names = kEight;
  ASSERT_EQ(names.size(), kColours);
  std::set<Colour> own;
  for (const std::string& name : names) own.insert(LookOf(name).colour);
  ASSERT_LT(own.size(), kColours) << "these names do not clash";
  Chart chart = ChartOfNames(names);
  GiveLooks(&chart);
  std::set<Colour> colours;
  std::set<Mark> marks;
  for (const Series& series : chart.series) {
    colours.insert(series.look->colour);
    marks.insert(series.look->mark);
  }
  EXPECT_EQ(colours.size(), names.size());
  EXPECT_EQ(marks.size(), names.size());
}

// Goal:   with more curves than colours, still no two have both in common.
TEST(GiveLooks, ManyCurvesDifferInColourOrMark) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kColours * kOpenMarks.size(); ++i) {
    names.push_back(std::to_string(i));
  }
  Chart chart = ChartOfNames(names);
  GiveLooks(&chart);
  std::set<std::pair<Colour, Mark>> looks;
  for (const Series& series : chart.series) looks.insert({series.look->colour, series.look->mark});
  EXPECT_EQ(looks.size(), names.size());
}

// Goal:   a look belongs to the name, not to the place in the chart, and a chosen look stays.
TEST(GiveLooks, TheOrderDoesNotMatter) {
  Chart one = ChartOfNames(kEight), other = ChartOfNames({kEight.rbegin(), kEight.rend()});
  GiveLooks(&one);
  GiveLooks(&other);
  for (std::size_t i = 0; i < kEight.size(); ++i) {
    EXPECT_EQ(one.series[i].look, other.series[kEight.size() - 1 - i].look) << kEight[i];
  }
  Chart alone = ChartOfNames({"bob"});
  GiveLooks(&alone);
  EXPECT_EQ(alone.series[0].look, LookOf("bob"));
  const Look chosen{Colour::kGreen, Mark::kDiamond, 3};
  alone.series[0].look = chosen;
  GiveLooks(&alone);
  EXPECT_EQ(alone.series[0].look, chosen);
}

// Goal:   gnuplot is told the look, and a cross for what is at infinity.
TEST(GnuplotScript, DrawsColourMarkAndDash) {
  Chart chart = ChartOfNames({"bob"});
  chart.series[0].look = Look{Colour::kGreen, Mark::kDiamond, 1};
  const std::string script = GnuplotScript(chart, "c.svg");
  EXPECT_NE(script.find("pt 13 ps 0.6 pi 1 dt (12,4) lc rgb '#009e73'"), std::string::npos)
      << script;
  chart.series[0].points[0].y = std::nullopt;
  const std::string crossed = GnuplotScript(chart, "c.svg");
  EXPECT_NE(crossed.find("with points pt 2 "), std::string::npos) << crossed;
}

TEST(GnuplotScript, SetsMarksApartOnCurvesOfManyPoints) {
  Chart chart = ChartOfNames({"bob"});
  chart.draws_title = true;
  chart.title = "Bob's";
  for (int i = 0; i < 200; ++i) chart.series[0].points.push_back({1.0 + i, 2.0, ""});
  const std::string script = GnuplotScript(chart, "c.svg");
  EXPECT_NE(script.find(" pi 6 "), std::string::npos) << script;
  EXPECT_NE(script.find("set title 'Bob''s' noenhanced"), std::string::npos) << script;
}

}  // namespace
}  // namespace collision::chart
