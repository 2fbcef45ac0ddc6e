#include "tests/bench/harness/frame_times.h"

#include <algorithm>

#include "tests/bench/harness/measure.h"

namespace collision::bench {
namespace {

constexpr std::size_t kSlowest = 5, kParts = 64;

std::vector<double> Series(const std::vector<double>& frames) {
  const std::size_t parts = std::min(kParts, frames.size());
  std::vector<double> series(parts);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    double& slowest = series[i * parts / frames.size()];
    slowest = std::max(slowest, frames[i]);
  }
  return series;
}

}  // namespace

std::vector<Field> FrameFields(const std::vector<double>& frames) {
  if (frames.empty()) return {};
  std::vector<double> sorted = frames;
  std::sort(sorted.rbegin(), sorted.rend());
  sorted.resize(std::min(kSlowest, sorted.size()));
  return {Number("frames", static_cast<double>(frames.size())),
          Number("frame_p50_s", Quantile(frames, 0.5)),
          Number("frame_p90_s", Quantile(frames, 0.9)),
          Number("frame_p99_s", Quantile(frames, 0.99)),
          Number("slowest_frame_s", sorted[0]),
          List("slowest_frames_s", sorted),
          List("frame_series_s", Series(frames))};
}

}  // namespace collision::bench
