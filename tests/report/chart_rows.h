// Charts and tables from measurements.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/programs/chart/chart.h"
#include "tests/report/rows.h"
#include "tests/report/table.h"

namespace collision::report {

struct ChartFields {
  std::vector<std::string> series;  ///< Fields whose texts name a series.
  std::string x, y;
  double x_factor = 1, y_factor = 1;
  std::vector<std::string> ours = {};  ///< Series that begin with one of these are drawn thicker.
  std::string y_else = {};             ///< Taken where there is no y.
};

/// A series for each text of the series' fields, in the order in which they come; points by x. Rows
/// whose field "who" is "ours" are drawn thicker, too. A row
/// with "misses" or "false_alarms" above 0 becomes a cross at infinity, with what it missed as its
/// note; so does one without y that was given up, noted as "> x s". `chart` brings the words.
chart::Chart ChartOf(chart::Chart chart, const std::vector<const Row*>& rows,
                     const ChartFields& fields);

/// Copies of the rows with other texts in a field, for the charts' names.
std::vector<Row> Renamed(const std::vector<const Row*>& rows, const std::string& field,
                         const std::function<std::string(const std::string&)>& name);
std::vector<const Row*> Pointers(const std::vector<Row>& rows);

struct Column {
  std::string field, title;
};

/// One line for each row. Fields "seconds" and those that end in "_s" are shown as durations; one
/// that was given up as "> x s".
Table TableOf(const std::string& title, const std::vector<const Row*>& rows,
              const std::vector<Column>& columns);

/// All fields of all rows, those of the first rows first; folded.
Table WholeTable(const std::string& title, const std::vector<const Row*>& rows);

}  // namespace collision::report
