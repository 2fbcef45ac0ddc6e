// What was measured of the broad phase.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/broad_phase/answer.h"
#include "tests/bench/harness/report.h"

namespace collision::bench {

/// One contestant on one scene.
struct Row {
  std::string part;  ///< Of the benchmark: scratch, incremental...
  std::string scene;
  std::size_t agents = 0;
  std::string contestant;
  std::optional<double> seconds;  ///< Median; empty: past the cut-off, or failed.
  double cut_off = 0;             ///< [s]
  bool failed = false;
  std::optional<Answer> answer;
  std::string remark;       ///< Printed behind the row: a mismatch, say.
  std::vector<Field> more;  ///< In the JSON only.

  /// What --only is compared with.
  std::string path() const {
    return part + "/" + scene + "/" + std::to_string(agents) + "/" + contestant;
  }
  std::string Line() const;
  std::string Json() const;
};

struct Report : RowReport<Row> {
  Report();
};

/// "12.3 ms", "> 5 s" or "failed".
std::string TimeText(const Row& row);

}  // namespace collision::bench
