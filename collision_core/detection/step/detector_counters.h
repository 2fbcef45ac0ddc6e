// What a detector has done so far, counted.
#pragma once

#include <cstdint>

namespace collision::detection {

/// Work and occurrences since the start.
struct DetectorCounters {
  std::uint64_t updates_kept = 0, jumps = 0, widenings = 0, breaches = 0;
  std::uint64_t queries = 0;         ///< Queries for the intersections of one agent.
  std::uint64_t pair_queries = 0;    ///< Pairs given to the canonical routine.
  std::uint64_t filter_tests = 0;    ///< Pairs given to a cheaper test of the broad phase.
  std::uint64_t broad_units = 0;     ///< All work of the broad phase, in the units it chooses by.
  std::uint64_t method_changes = 0;  ///< Times the broad phase changed its method.
  std::uint64_t segments = 0;        ///< Segments of time evaluated by the narrow phase.
  std::uint64_t quick_segments = 0;  ///< Of these: decided in plain doubles.
  std::uint64_t work_units = 0;      ///< Spent by the narrow phase.
  std::uint64_t evaluations_cut_short = 0;  ///< Evaluations that spent all they were allowed.
  std::uint64_t saturations = 0;            ///< Times an agent became saturated.
  std::uint64_t events[6] = {};  ///< Published revisions that changed the status, by EventStatus.
};

}  // namespace collision::detection
