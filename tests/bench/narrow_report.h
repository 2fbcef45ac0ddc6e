// What was measured of the narrow phase: a table for people, JSON for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/json.h"
#include "tests/bench/number_hash.h"

namespace collision::bench {

struct NarrowRow {
  std::string part;
  std::string mesh;
  std::size_t triangles = 0;
  std::string gap;
  std::string contestant;
  std::optional<double> warm, cold;  ///< Medians [s].
  std::string hash;                  ///< Of all answers.
  std::string remark;                ///< Shown behind the row: a mismatch, say.
  std::vector<Field> more;           ///< In the JSON only.
};

class NarrowReport {
 public:
  NarrowReport();

  /// Also says it on the standard error output, so that a long run shows where it is.
  void Add(NarrowRow row);
  void Figure(const std::string& name, std::optional<double> value) { figures_.Set(name, value); }
  /// Keeps the least or the greatest of what it is given.
  void FigureLeast(const std::string& name, double value);
  void FigureGreatest(const std::string& name, double value);

  std::string Table() const;
  std::string Json() const;

 private:
  std::vector<NarrowRow> rows_;
  Figures figures_;
};

}  // namespace collision::bench
