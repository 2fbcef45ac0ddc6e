#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "client/programs/chart/chart.h"

namespace collision::chart {
namespace {

/// Gnuplot's mark of points at infinity.
constexpr int kCross = 2;
/// Above the highest point, where infinity is drawn: a share of the axis.
constexpr double kRoomAbove = 0.12;
/// On a curve of more points they are set apart.
constexpr std::size_t kMarksMax = 40;
/// Two of these stand beside each other.
constexpr std::size_t kShortName = 26;

std::string ReadAll(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

/// As one word of a shell.
std::string ShellWord(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

bool Drawable(const Chart& chart, const Point& point) {
  if (!std::isfinite(point.x) || (chart.log_x && point.x <= 0)) return false;
  return !point.y || (std::isfinite(*point.y) && (!chart.log_y || *point.y > 0));
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool at_infinity = false;
};

Range HeightOf(const Chart& chart) {
  Range range;
  for (const Series& series : chart.series) {
    for (const Point& point : series.points) {
      if (!Drawable(chart, point)) continue;
      range.at_infinity |= !point.y;
      if (!point.y) continue;
      range.low = std::min(range.low, *point.y), range.high = std::max(range.high, *point.y);
    }
  }
  if (range.low > range.high) range.low = 1, range.high = 10;
  return range;
}

/// Where crosses at infinity stand.
double InfinityOf(const Chart& chart, const Range& range) {
  if (chart.log_y) {
    return range.high * std::pow(std::max(10.0, range.high / range.low), kRoomAbove);
  }
  return range.high + kRoomAbove * std::max(range.high - range.low, 1e-300);
}

/// Long names stand below each other.
std::size_t KeyColumns(const Chart& chart) {
  const bool all_short = std::all_of(chart.series.begin(), chart.series.end(),
                                     [](const Series& s) { return s.name.size() <= kShortName; });
  return all_short ? 2 : 1;
}

std::string Data(const Chart& chart, const Series& series, bool at_infinity, double infinity) {
  std::string text;
  for (const Point& point : series.points) {
    if (!Drawable(chart, point) || at_infinity == point.y.has_value()) continue;
    char line[80];
    std::snprintf(line, sizeof line, "%.15g %.15g\n", point.x, point.y.value_or(infinity));
    text += line;
  }
  return text;
}

std::string AxisOf(char axis, const std::string& label, bool logarithmic) {
  std::string text = std::string("set ") + axis + "label " + Quoted(label) + "\n";
  if (logarithmic) {
    text += std::string("set logscale ") + axis + "\nset format " + axis + " '10^{%L}'\n";
  } else {
    text += std::string("set format ") + axis + " '%g'\n";
  }
  return text;
}

}  // namespace

std::string GnuplotScript(Chart chart, const std::string& svg_path) {
  GiveLooks(&chart);
  const Range range = HeightOf(chart);
  const double infinity = InfinityOf(chart, range);
  const std::size_t columns = KeyColumns(chart);
  const std::size_t key_rows = (chart.series.size() + columns - 1) / columns;
  std::string text = "set terminal svg size 560," + std::to_string(368 + 18 * key_rows) +
                     " dynamic noenhanced font 'sans-serif,13' background '#ffffff'\n" +
                     "set output " + Quoted(svg_path) + "\n" +
                     "set key outside below center horizontal Left reverse maxcols " +
                     std::to_string(columns) + " samplen 4 title ' '\n" +
                     "set grid lc '#dddddd'\nset border 3\nset tics nomirror\n";
  // Powers of ten need gnuplot's own markup; names must not be read as such.
  text += "set termoption enhanced\n";
  if (chart.draws_title) text += "set title " + Quoted(chart.title) + " noenhanced\n";
  text += AxisOf('x', chart.x_label, chart.log_x) + AxisOf('y', chart.y_label, chart.log_y);
  if (range.at_infinity) {
    char line[120];
    std::snprintf(
        line, sizeof line, "set yrange [*:%.9g]\nset label '∞' at graph 0.01, first %.9g\n",
        chart.log_y ? infinity * 1.3 : infinity + 0.03 * (infinity - range.low), infinity);
    text += line;
  }
  std::string plots;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const Series& series = chart.series[i];
    const Look& look = *series.look;
    const std::string style =
        " lc rgb '" + HtmlColour(look.colour) + "' lw " + (series.thick ? "2.4" : "1.3");
    std::string title = " title " + Quoted(series.name) + " noenhanced";
    const std::string joined = Data(chart, series, false, infinity);
    const std::string crosses = Data(chart, series, true, infinity);
    const std::string name = "$s" + std::to_string(i);
    if (!joined.empty()) {
      text += name + " << EOD\n" + joined + "EOD\n";
      const std::size_t apart = 1 + series.points.size() / kMarksMax;
      plots += (plots.empty() ? "" : ", ") + name + " using 1:2 with linespoints pt " +
               std::to_string(static_cast<int>(look.mark)) + " ps 0.6 pi " + std::to_string(apart) +
               " dt " + GnuplotDash(look.dash) + style + title;
      title = " notitle";
    }
    if (!crosses.empty()) {
      text += name + "x << EOD\n" + crosses + "EOD\n";
      plots += (plots.empty() ? "" : ", ") + name + "x using 1:2 with points pt " +
               std::to_string(kCross) + " ps 0.9" + style + title;
    }
  }
  return text + (plots.empty() ? "" : "plot " + plots + "\n");
}

std::string Draw(const Chart& chart, const std::string& folder) {
  const std::string base = folder + "/" + chart.id;
  const std::string svg = base + ".svg", script = base + ".gnuplot", errors = base + ".errors";
  std::ofstream(script, std::ios::binary) << GnuplotScript(chart, svg);
  const int status =
      std::system(("gnuplot " + ShellWord(script) + " 2>" + ShellWord(errors)).c_str());
  const std::string said = ReadAll(errors);
  std::filesystem::remove(errors);
  if (status != 0) throw std::runtime_error("gnuplot, of " + chart.id + ": " + said);
  std::filesystem::remove(script);
  return ReadAll(svg);
}

}  // namespace collision::chart
