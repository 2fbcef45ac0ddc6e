// What was measured of error and run time: a table for people, JSON for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/json.h"
#include "tests/bench/number_hash.h"

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
};

class PrecisionReport {
 public:
  PrecisionReport();

  /// Also says it on the standard error output, so that a long run shows where it is.
  void Add(PrecisionRow row);
  void FigureLeast(const std::string& name, double value);
  void FigureGreatest(const std::string& name, double value);
  void FigureSum(const std::string& name, double value);

  const std::vector<PrecisionRow>& rows() const { return rows_; }
  std::string Table() const;
  std::string Json() const;

 private:
  std::vector<PrecisionRow> rows_;
  Figures figures_;
};

/// The comparisons that are made of all rows together.
void SetFigures(PrecisionReport* report);

}  // namespace collision::bench
