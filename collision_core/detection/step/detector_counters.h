// What a detector has done so far, counted.
#pragma once

#include <cstddef>
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
  /// Spent beside it on what is expected of a pair and on closest approaches; no part of a step's
  /// budget, and at most a quarter of what an evaluation may spend for each of them.
  std::uint64_t encounter_units = 0;
  std::uint64_t evaluations_cut_short = 0;  ///< Evaluations that spent all they were allowed.
  std::uint64_t saturations = 0;            ///< Times an agent became saturated.
  std::uint64_t events[6] = {};  ///< Published revisions that changed the status, by EventStatus.

  /// Counts of one detector after another.
  DetectorCounters& operator+=(const DetectorCounters& more) {
    updates_kept += more.updates_kept;
    jumps += more.jumps;
    widenings += more.widenings;
    breaches += more.breaches;
    queries += more.queries;
    pair_queries += more.pair_queries;
    filter_tests += more.filter_tests;
    broad_units += more.broad_units;
    method_changes += more.method_changes;
    segments += more.segments;
    quick_segments += more.quick_segments;
    work_units += more.work_units;
    encounter_units += more.encounter_units;
    evaluations_cut_short += more.evaluations_cut_short;
    saturations += more.saturations;
    for (std::size_t i = 0; i < 6; ++i) events[i] += more.events[i];
    return *this;
  }
};

}  // namespace collision::detection
