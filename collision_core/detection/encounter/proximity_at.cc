#include "collision_core/detection/encounter/proximity_at.h"

#include <numbers>

#include "collision_core/narrow_phase/contact/ball_proximity.h"
#include "collision_core/narrow_phase/contact/shape_contact.h"

namespace collision::detection {

narrow_phase::Proximity ProximityOfAwaited(narrow_phase::Proximity of_balls) {
  of_balls.separation.upper = numeric::kInfinity;
  of_balls.depth_lower = 0;
  of_balls.point_error = numeric::kInfinity;
  of_balls.normal_error = std::numbers::pi;
  of_balls.limited_by = narrow_phase::BracketLimit::kGeometry;
  return of_balls;
}

narrow_phase::Proximity ProximityAt(const History& a, const History& b, Instant at,
                                    WorkBudget* work) {
  work->Spend(1);
  const auto [of_a, of_b] = BothOver(a, b, at, at);
  if (of_a.is_ball() && of_b.is_ball()) return BallProximity(of_a.ball, of_b.ball, 0);
  if (of_a.awaited || of_b.awaited) {
    return ProximityOfAwaited(BallProximity(of_a.ball, of_b.ball, 0));
  }
  return ShapeProximity(of_a, of_b, 0, work);
}

}  // namespace collision::detection
