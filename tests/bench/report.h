// What was measured: a table for people, JSON for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/answer.h"
#include "tests/bench/json.h"

namespace collision::bench {

/// One cell: what was done, by whom, and in what time.
struct Row {
  std::string part;  ///< Of the benchmark: scratch, incremental...
  std::string scene;
  std::size_t agents = 0;
  std::string contestant;
  std::optional<double> seconds;  ///< Median; empty: past the cut-off, or failed.
  double cut_off = 0;             ///< [s]
  bool failed = false;
  std::optional<Answer> answer;
  std::string remark;       ///< Shown behind the row: a mismatch, say.
  std::vector<Field> more;  ///< In the JSON only.
};

class Report {
 public:
  /// All figures are there from the start, not measured.
  Report();

  /// Also says it on the standard error output, so that a long run shows where it is.
  void Add(Row row);
  /// Adds a remark to the last row.
  void Mark(const std::string& remark);
  /// A figure of the summary; nullopt: not measured, null in the JSON.
  void Figure(const std::string& name, std::optional<double> value);

  const std::vector<Row>& rows() const { return rows_; }

  std::string Table() const;
  std::string Json() const;

 private:
  std::vector<Row> rows_;
  Figures figures_;
};

/// "12.3 ms", "> 5 s" or "failed".
std::string TimeText(const Row& row);

}  // namespace collision::bench
