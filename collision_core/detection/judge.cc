#include "collision_core/detection/judge.h"

#include <algorithm>

namespace collision {
namespace {

// Where the two were certified to be nearest: looked for at the ends and where the centres' lines
// are nearest.
Nearest NearestOf(const BallSegment& a, const BallSegment& b, Instant from, double duration) {
  Nearest nearest;
  if (a.bounds.empty() || b.bounds.empty()) return nearest;
  const Eigen::Vector3d d = (b.bounds[0].centre - a.bounds[0].centre).middle();
  const Eigen::Vector3d w = (b.bounds[0].velocity - a.bounds[0].velocity).middle();
  const double speed_squared = w.squaredNorm();
  const double bottom = speed_squared > 0 ? -d.dot(w) / speed_squared : 0;
  for (const double delta : {0.0, std::clamp(bottom, 0.0, duration), duration}) {
    const SeparationAt found = JudgeInstant(a, b, delta);
    if (nearest.at.is_never() || found.separation.upper < nearest.found.separation.upper) {
      nearest = {AddRoundedDown(from, delta), found};
    }
  }
  return nearest;
}

}  // namespace

std::uint64_t Judge(const History& a, const History& b, Instant until, ContactTracker* tracker) {
  std::uint64_t segments = 0;
  while (tracker->at() < until) {
    const Instant from = tracker->at();
    const Instant to = std::min({until, a.NextCutAfter(from), b.NextCutAfter(from)});
    const double duration = SecondsBetween(from, to).upper;
    const BallSegment of_a = a.Over(from, to);
    const BallSegment of_b = b.Over(from, to);
    const SegmentVerdict verdict = JudgeSegment(of_a, of_b, duration);
    Nearest nearest;
    if (verdict.free_until < duration) nearest = NearestOf(of_a, of_b, from, duration);
    tracker->Apply(verdict, to, nearest);
    ++segments;
  }
  return segments;
}

SeparationAt SeparationOf(const History& a, const History& b, Instant at) {
  return JudgeInstant(a.Over(at, at), b.Over(at, at), 0);
}

}  // namespace collision
