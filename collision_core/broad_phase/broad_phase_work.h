// Work of the broad phase, counted.
#pragma once

#include <cstdint>

namespace collision::broad_phase {

/// Work since the start, counted and never timed, so that it is the same on every machine.
struct BroadPhaseWork {
  std::uint64_t pair_queries = 0;  ///< Pairs given to EarliestIntersectionOf().
  std::uint64_t filter_tests = 0;  ///< Pairs examined by a cheaper test.
  std::uint64_t visits = 0;        ///< Cells, crossings or lists examined.
  std::uint64_t rebuilds = 0;      ///< Times the whole structure was rebuilt.
  std::uint64_t searches = 0;      ///< Searches for the neighbours of one agent in a time window.
  std::uint64_t neighbours = 0;    ///< Neighbours found by these searches.

  /// What a piece of work costs, in filter tests; measured once on one machine. Only the rough
  /// ratios matter, and only for the choice of a method.
  static constexpr double kPairUnits = 256, kVisitUnits = 16;
  /// The cost of placing an agent anew in the spatial index, in filter tests.
  static constexpr double kPlaceUnits = 64;

  /// The cost of filter tests and visits, in filter tests.
  double search_units() const {
    return static_cast<double>(filter_tests) + kVisitUnits * static_cast<double>(visits);
  }
};

}  // namespace collision::broad_phase
