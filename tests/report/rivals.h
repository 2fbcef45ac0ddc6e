// Who comes nearest to ours, or is ahead of it, in the measurements of an experiment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "idl/report.pb.h"
#include "tests/report/rows.h"

namespace collision::report {

/// The best other contestant in the cell in which ours looks worst.
struct Rival {
  std::string who;
  double over_ours = 0;  ///< Its time over ours: below 1 it is ahead.
};

/// Which rows compete with each other, and by what.
struct Contest {
  std::string experiment;
  std::vector<Condition> conditions;
  std::vector<std::string> cell;  ///< Rows with the same texts in these fields are one cell.
  std::string time;               ///< The field with the time [s].
  std::string ours;               ///< The contestant that is ours.
  std::vector<std::string> variants = {};  ///< Other methods of ours, which do not compete.
};

/// Rows that do not count, since too many answers are wrong, are left out.
std::optional<Rival> RivalOf(const v1::Results& results, const Contest& contest);

/// Of the time of contact, among the libraries' right answers: the one that comes nearest to ours,
/// at an error that ours certifies.
std::optional<Rival> ContactRivalOf(const v1::Results& results);

}  // namespace collision::report
