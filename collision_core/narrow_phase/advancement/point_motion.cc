#include "collision_core/narrow_phase/advancement/point_motion.h"

#include "collision_core/numeric/rounding.h"

namespace collision::narrow_phase {

PointMotion::PointMotion(const SweptPair& pair)
    : swept_(pair.swept), reach_a_(pair.a.turning_reach()), reach_b_(pair.b.turning_reach()) {
  const auto& [a, b, swept] = pair;
  const RelativePose& pose = swept.pose;
  const double offset = pose.p_AB.cwiseAbs().sum();
  const double extent = a.reach() + b.reach() + offset;
  const double pace = swept.velocity.cwiseAbs().sum() + reach_a_ * swept.spin_A.cwiseAbs().sum() +
                      (reach_b_ + offset) * swept.spin_B.cwiseAbs().sum();
  // 1 + 2^-40 for its own rounding.
  fastest_ = (1 + 0x1p-40) * (swept.velocity.norm() + reach_a_ * swept.spin_A.norm() +
                              reach_b_ * swept.spin_B.norm());
  slack_ = numeric::AddUp(
      numeric::MultiplyUp(0x1p-48, extent),
      numeric::AddUp(pose.offset_error, numeric::MultiplyUp(pose.matrix_error, b.reach())));
  slack_growth_ = numeric::MultiplyUp(0x1p-48, pace);
}

}  // namespace collision::narrow_phase
