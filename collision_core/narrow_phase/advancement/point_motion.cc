#include "collision_core/narrow_phase/advancement/point_motion.h"

#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::narrow_phase {
namespace {

/// Relative to the lengths, and for each second of the speeds, that a distance is made of: less
/// than two dozen operations on terms below their sum, of 2^-53 each.
constexpr double kDistanceRounding = 0x1p-48;

}  // namespace

PointMotion::PointMotion(const SweptPair& pair)
    : swept_(pair.swept), reach_a_(pair.a.turning_reach()), reach_b_(pair.b.turning_reach()) {
  const auto& [a, b, swept] = pair;
  const RelativePose& pose = swept.pose;
  const double offset = pose.p_AB.cwiseAbs().sum();
  const double extent = a.reach() + b.reach() + offset;
  const double pace = swept.velocity.cwiseAbs().sum() + reach_a_ * swept.spin_A.cwiseAbs().sum() +
                      (reach_b_ + offset) * swept.spin_B.cwiseAbs().sum();
  fastest_ = numeric::kManyRoundingsUp * (swept.velocity.norm() + reach_a_ * swept.spin_A.norm() +
                                          reach_b_ * swept.spin_B.norm());
  slack_ = numeric::AddUp(
      numeric::MultiplyUp(kDistanceRounding, extent),
      numeric::AddUp(pose.offset_error, numeric::MultiplyUp(pose.matrix_error, b.reach())));
  slack_growth_ = numeric::MultiplyUp(kDistanceRounding, pace);
}

}  // namespace collision::narrow_phase
