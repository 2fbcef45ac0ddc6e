// Times of the frames of a run: their distribution, and the slowest ones.
#pragma once

#include <vector>

#include "tests/bench/harness/json.h"

namespace collision::bench {

/// `frame_p50_s`, `frame_p90_s`, `frame_p99_s`, `slowest_frame_s`, `slowest_frames_s` (the five
/// slowest, slowest first) and `frame_series_s`: the slowest of each of at most 64 equal parts of
/// the run, in order.
std::vector<Field> FrameFields(const std::vector<double>& frames);

}  // namespace collision::bench
