#include "collision_core/narrow_phase/advancement/swept_balls.h"

#include "collision_core/numeric/first_root.h"

namespace collision::narrow_phase {
namespace {

// Tangent steps for one pair of balls; each goes on from where the last one ended.
constexpr int kTangentSteps = 4;

}  // namespace

double SweptBallsTouch(const SweptBalls& balls, double duration, double step_worth) {
  const auto& [d, w, reach] = balls;
  double h = 0;
  for (int step = 0; step < kTangentSteps; ++step) {
    const Eigen::Vector3d between = d + h * w;
    const double distance = between.norm();
    const double gap = distance - (reach.c0 + h * (reach.c1 + h * reach.c2));
    if (!(gap > 0)) return h;
    const double closing = reach.c1 + 2 * h * reach.c2 - between.dot(w) / distance;
    const double further = numeric::FirstRoot(gap, closing, reach.c2);
    h += further;
    if (h > duration) return numeric::kInfinity;
    if (further < step_worth * duration) break;
  }
  return h;
}

}  // namespace collision::narrow_phase
