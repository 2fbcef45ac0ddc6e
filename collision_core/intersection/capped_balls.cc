#include "collision_core/intersection/capped_balls.h"

#include <algorithm>

#include "collision_core/motion/speed_cap.h"
#include "collision_core/numeric/first_approach.h"

namespace collision::intersection {
namespace {

/// An agent's ball over time: the horn's, and under the cap another from `start` on (which may lie
/// before the base).
struct Timeline {
  numeric::MovingBall horn, cap;
  double start = numeric::kInfinity;

  Timeline(const motion::SpaceTimeBound& bound, Instant base)
      : horn(ForwardBall(bound, base)), cap(horn) {
    const std::optional<motion::BallFromTime> capped = CappedBallFrom(bound, base);
    if (!capped) return;
    start = capped->start;
    cap = capped->ball;
  }

  Timeline WithoutCap() const {
    Timeline horn_only = *this;
    horn_only.start = numeric::kInfinity;
    return horn_only;
  }

  const numeric::MovingBall& at(double delta) const { return delta < start ? horn : cap; }
};

/// The first overlap, piece by piece.
double FirstOverlap(const Timeline& a, const Timeline& b, double margin, double limit) {
  const double first = std::max(0.0, std::min(a.start, b.start));
  const double second = std::max(first, std::max(a.start, b.start));
  // Before `first` they are the horns, which do not overlap then.
  if (first > limit) return numeric::kInfinity;
  const double end = std::min(second, limit);
  const double time = FirstApproach(Difference(a.at(first), b.at(first), margin), end, first);
  if (time < numeric::kInfinity || second > limit) return time;
  return FirstApproach(Difference(a.at(second), b.at(second), margin), limit, second);
}

}  // namespace

double LaterOfCappedBalls(const BoundPair& pair, double time, double limit) {
  const Timeline line_A(pair.a, pair.base), line_B(pair.b, pair.base);
  // Up to a cap's start the balls are the horns': where those have met before, they have too.
  double latest = time;
  const auto wait = [&](const Timeline& first, const Timeline& second) {
    if (time > std::min(first.start, second.start)) {
      latest = std::max(latest, FirstOverlap(first, second, pair.margin, limit));
    }
  };
  wait(line_A, line_B.WithoutCap());
  wait(line_A.WithoutCap(), line_B);
  wait(line_A, line_B);
  return latest;
}

}  // namespace collision::intersection
