// The first window of a face sweep.
#pragma once

#include <vector>

#include "collision_core/broad_phase/agent_bound.h"

namespace collision::broad_phase {

/// The length of the first window [ns], at least 1, over which chords fit the horns: with ℓ the
/// agents' typical radius and distance to each other, typical horns grow by at most ½ M w² = ½ ℓ,
/// so that a chord lies at most ℓ/8 outside; and a tick of the sweep is short against the time in
/// which they move ℓ. Typical is the seventh octile of at most 1024 agents at equal steps through
/// `agents`: the result depends on the bounds alone, and a few unusual agents do not decide it.
/// Only the cost depends on it.
std::int64_t FirstWindow(const BoundList& bounds, const std::vector<std::uint32_t>& agents);

/// The latest instant at which two horns first overlap whose answer is `time` or earlier. An answer
/// may be early by 1e−9 of the way from `first` (earliest_intersection.h); this allows 2^−29 of it,
/// and three nanoseconds for rounding both. Never() − 1 ns at most.
Instant WithEarliness(Instant first, Instant time);

}  // namespace collision::broad_phase
