// What a benchmark measured: a table for people, JSON for programs, and the figures of both.
#pragma once

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/harness/json.h"

namespace collision::bench {

/// The rows of one benchmark, in order, and its figures.
///
/// `Row` describes itself: `Line()` is its line of the table and `Json()` its object in the file,
/// empty if it has none.
/// All figures exist from the start, not measured.
template <typename Row>
class RowReport {
 public:
  /// `head` is the line above the rows, `note` the line above the figures.
  RowReport(const std::vector<std::string>& figures, std::string head, std::string note)
      : head_(std::move(head)), note_(std::move(note)), figures_(figures) {}

  /// Also prints the row on the standard error output, so that a long run shows where it is.
  void Add(Row row) {
    std::fprintf(stderr, "bench: %s\n", row.Line().c_str());
    rows_.push_back(std::move(row));
  }

  /// Adds a remark to the last row.
  void Mark(const std::string& remark) {
    std::fprintf(stderr, "bench:   %s\n", remark.c_str());
    rows_.back().remark += (rows_.back().remark.empty() ? "" : "; ") + remark;
  }

  /// nullopt: not measured, null in the JSON.
  void Figure(const std::string& name, std::optional<double> value) { figures_.Set(name, value); }
  /// The least, the greatest or the sum of all values that a figure is given.
  void FigureLeast(const std::string& name, double value) {
    figures_.Set(name, std::min(figures_.Get(name).value_or(value), value));
  }
  void FigureGreatest(const std::string& name, double value) {
    figures_.Set(name, std::max(figures_.Get(name).value_or(value), value));
  }
  void FigureSum(const std::string& name, double value) {
    figures_.Set(name, figures_.Get(name).value_or(0) + value);
  }

  const std::vector<Row>& rows() const { return rows_; }

  std::string Table() const {
    std::string text = head_.empty() ? "" : head_ + "\n";
    for (const Row& row : rows_) text += row.Line() + "\n";
    if (!note_.empty()) text += "\n" + note_ + "\n";
    return text + figures_.Table();
  }

  std::string Json() const {
    std::vector<std::string> measurements;
    for (const Row& row : rows_) {
      if (const std::string json = row.Json(); !json.empty()) measurements.push_back(json);
    }
    return figures_.Json(measurements);
  }

 private:
  const std::string head_, note_;
  std::vector<Row> rows_;
  Figures figures_;
};

/// Prints the table and writes the file of --json, if any. Returns the program's exit status.
template <typename Row>
int Finish(const RowReport<Row>& report, const std::string& json) {
  std::fputs(report.Table().c_str(), stdout);
  return WriteJson(json, report.Json());
}

}  // namespace collision::bench
