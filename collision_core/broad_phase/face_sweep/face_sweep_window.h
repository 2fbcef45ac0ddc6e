// The first window of a face sweep.
#pragma once

#include <optional>
#include <vector>

#include "collision_core/broad_phase/agent_bound.h"

namespace collision::broad_phase {

/// Nanoseconds, at least 1, from `first` on over which chords fit the horns: with ℓ the agents'
/// typical radius and distance to each other, typical horns grow by at most ½ M w² = ½ ℓ, so that a
/// chord lies at most ℓ/8 outside; and a tick of the sweep is short against the time in which they
/// move ℓ. Typical is the seventh octile of at most 1024 agents at equal steps through `agents`:
/// the answer follows from the bounds alone, and a few agents out of the ordinary do not decide.
/// It bears on the cost only.
std::int64_t FirstWindow(const BoundList& bounds, const std::vector<std::uint32_t>& agents);

/// How early a horn's meeting may be reported: 1e−9 of its distance (earliest_intersection.h), here
/// 2^−29 and three nanoseconds for rounding both. Whatever is told as `time` or earlier,
/// after `first`, overlaps by the instant that this returns, Never() − 1 ns at the latest.
Instant WithEarliness(Instant first, Instant time);

}  // namespace collision::broad_phase
