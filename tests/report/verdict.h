// What was asked of the service and its parts, and what was measured: the table that the page opens
// with.
#pragma once

#include <string>
#include <vector>

#include "idl/report.pb.h"

namespace collision::report {

enum class Verdict { kKept, kMissed, kNotMeasured };

struct VerdictLine {
  std::string group;     ///< What it is about: lines of a group stand together.
  std::string asked;     ///< In words that need no other page.
  std::string bound;     ///< "≥ 0.7"
  std::string measured;  ///< For people; "–" where it was not measured.
  Verdict verdict = Verdict::kNotMeasured;
  std::string words;  ///< "kept", "missed by 3.9 ×", "not measured"
  /// The best other contestant with its value, "nobody" and the next best where ours is the best,
  /// "-" where there is none.
  std::string beaten_by;
};

/// All lines, in their order; a line whose experiment is missing is not measured.
std::vector<VerdictLine> VerdictsOf(const v1::Results& results);

/// "12 of 17 kept, 3 missed, 2 not measured."
std::string SummaryOf(const std::vector<VerdictLine>& lines);

}  // namespace collision::report
