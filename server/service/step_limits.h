// What one step of the daemon does at most.
#pragma once

#include <cstddef>
#include <cstdint>

namespace collision::server {

/// Rounds in which no simulator has a step follow each other in one step of the daemon, but not
/// more than these, so that it hears what arrives meanwhile.
inline constexpr int kRoundsPerStepMax = 64;

/// A process that makes no step for so much longer than the status period [ns] has stood still.
inline constexpr std::int64_t kStoodStill = 1'000'000'000;

/// Queries for one answer about the earliest intersection, some 5 us each: all that an exact answer
/// needs, unless agents or pairs by the dozen are about equally near.
inline constexpr std::size_t kEarliestQueriesMax = 64;

}  // namespace collision::server
