// A plot: what it shows, as a file of numbers and as a picture that gnuplot draws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/programs/chart/palette.h"

namespace collision::chart {

struct Point {
  double x = 0;
  std::optional<double> y;  ///< Nullopt: at infinity, shown as a cross on the upper edge.
  std::string note;         ///< In the file: how many were missed, say.
};

struct Series {
  std::string name;
  std::vector<Point> points;  ///< In the order in which they are joined.
  bool thick = false;         ///< Drawn thicker than the others.
  std::string note;           ///< What a page says of it below the plot; not drawn.
  std::optional<Look> look;   ///< Nullopt: GiveLooks() finds one.
};

struct Chart {
  std::string id;     ///< Of the files: id.svg, id.csv.
  std::string title;  ///< Above the plot.
  std::string x_label, y_label;
  bool log_x = true, log_y = true;
  bool draws_title = false;  ///< In the picture: it stands alone.
  std::string caption;       ///< What is to be seen in it, below the plot.
  std::vector<Series> series = {};

  bool empty() const { return series.empty(); }
};

/// Gives each series that has no look the one of its name. Where another curve of the chart has its
/// colour or its mark, it takes the next that is free; names come in turn by their letters, so the
/// order of the series does not matter. Curves that have both in common do not occur as long as
/// there are colours and marks left.
void GiveLooks(Chart* chart);

/// One line for each point: series, x, y ("inf" at infinity), note.
std::string Csv(const Chart& chart);

/// Between quotes where commas or quotes ask for it.
std::string CsvCell(const std::string& text);

/// The script for gnuplot; it writes an SVG to `svg_path`.
std::string GnuplotScript(Chart chart, const std::string& svg_path);

/// Runs gnuplot, found on the path, and returns the SVG, which scales to the width it is given.
/// `folder` takes the script while it runs. Throws std::runtime_error with gnuplot's own words.
std::string Draw(const Chart& chart, const std::string& folder);

}  // namespace collision::chart
