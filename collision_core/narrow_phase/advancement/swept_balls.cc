#include "collision_core/narrow_phase/advancement/swept_balls.h"

#include <Eigen/Core>

#include "collision_core/numeric/first_root.h"

namespace collision::narrow_phase {
namespace {

// Tangent steps for one pair of balls; each goes on from where the last one ended.
constexpr int kTangentSteps = 4;

}  // namespace

double SweptBallsTouch(const numeric::QuickBall& difference, double duration, double step_worth) {
  const Eigen::Vector3d d(difference.c), w(difference.v);
  const double s0 = difference.s0, s1 = difference.s1, s2 = difference.s2;
  double h = 0;
  for (int step = 0; step < kTangentSteps; ++step) {
    const Eigen::Vector3d between = d + h * w;
    const double distance = between.norm();
    const double gap = distance - (s0 + h * (s1 + h * s2));
    if (!(gap > 0)) return h;
    const double closing = s1 + 2 * h * s2 - between.dot(w) / distance;
    const double further = numeric::FirstRoot(gap, closing, s2);
    h += further;
    if (h > duration) return numeric::kInfinity;
    if (further < step_worth * duration) break;
  }
  return h;
}

}  // namespace collision::narrow_phase
