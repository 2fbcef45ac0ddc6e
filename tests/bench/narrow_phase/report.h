// What was measured of the narrow phase.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/harness/number_hash.h"
#include "tests/bench/harness/report.h"
#include "tests/bench/pairs/bench_mesh.h"

namespace collision::bench {

struct NarrowRow {
  std::string part;
  std::string mesh;
  std::size_t triangles = 0;
  std::string gap;
  std::string contestant;
  std::optional<double> warm, cold;  ///< Medians [s].
  std::string hash;                  ///< Of all answers.
  std::string remark;                ///< Printed behind the row: a mismatch, say.
  std::vector<Field> more;           ///< In the JSON only.

  /// What --only is compared with.
  std::string path() const { return part + "/" + mesh + "/" + gap + "/" + contestant; }
  std::string Line() const;
  std::string Json() const;
};

/// Named, not measured.
NarrowRow RowOf(const std::string& part, const BenchMesh& mesh, const std::string& contestant);

struct NarrowReport : RowReport<NarrowRow> {
  NarrowReport();
};

}  // namespace collision::bench
