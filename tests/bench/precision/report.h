// What was measured of error and run time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/harness/number_hash.h"
#include "tests/bench/harness/report.h"

namespace collision::bench {

/// One point of a curve.
struct PrecisionRow {
  std::string part;    ///< precision, contact or service.
  std::string motion;  ///< translation, rotation or grazing.
  std::string mesh;    ///< Or the kinds of the two solids.
  std::string method, setting;
  std::string who;                ///< ours, peer, baseline or naive.
  std::optional<double> seconds;  ///< A query, median; nullopt: none ended before the cut-off.
  std::optional<double> width;    ///< Of the certified bracket, median.
  std::optional<double> error;    ///< Against the exact answer, median.
  std::size_t queries = 0, misses = 0, false_alarms = 0;
  bool certified = false;
  std::string limited_by;
  std::string hash;         ///< Of all answers.
  std::vector<Field> more;  ///< In the JSON only.

  /// What --only is compared with.
  std::string path() const {
    return part + "/" + motion + "/" + mesh + "/" + method + "/" + setting;
  }
  std::string Line() const;
  std::string Json() const;
};

struct PrecisionReport : RowReport<PrecisionRow> {
  PrecisionReport();
};

/// The comparisons that are made of all rows together.
void SetFigures(PrecisionReport* report);

}  // namespace collision::bench
