#include "collision_core/narrow_phase/sphere_pairs/kernel_pose.h"

#include "collision_core/numeric/rounding.h"

namespace collision::narrow_phase {
namespace {

void Store(const Eigen::Vector3d& from, float* to) {
  for (Eigen::Index i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

// Relative to the chord times the farthest a point may be: 16 · 2^-24 cover an arm that is off by
// (2 + 2.5) of these more, its product with the chord, and sums of it.
constexpr double kTurningRounding = 0x1p-20;

// What turning adds to the slack.
double TurningSlack(double chord, const PackedBody& body) {
  return chord > 0 ? kTurningRounding * chord * (body.origin.norm() + body.extent) : 0;
}

}  // namespace

PackedBody::PackedBody(const BodyTree& surface)
    : tree(surface.shape() ? &surface.shape()->packed() : nullptr),
      packs(tree ? tree->packs() : &ball),
      origin(tree ? tree->origin() : Eigen::Vector3d(0, 0, 0)),
      extent(tree ? tree->extent() : 2 * surface.reach()) {
  if (!tree) ball = sphere_tree::PackOfBall(surface.reach());
}

KernelPose KernelPoseOf(const PackedBody& a, const PackedBody& b, const RelativePose& pose,
                        double slack) {
  KernelPose scan;
  const Eigen::Vector3d offset = pose.ToA(b.origin) - a.origin;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) {
      scan.matrix[3 * row + column] = static_cast<float>(pose.R_AB(row, column));
    }
  }
  Store(offset, scan.offset);
  const double extent = a.extent + b.extent + offset.norm();
  const double more = slack + TurningSlack(pose.chord_A, a) + TurningSlack(pose.chord_B, b);
  scan.slack = numeric::FloatUp(kBallSlack * extent + more);
  scan.triangle_slack = numeric::FloatUp(kTriangleSlack * extent + more);
  scan.turn_a = pose.chord_A > 0 ? numeric::FloatUp(pose.chord_A) : 0;
  scan.turn_b = pose.chord_B > 0 ? numeric::FloatUp(pose.chord_B) : 0;
  Store(a.origin, scan.from_a);
  Store(b.origin, scan.from_b);
  Store(Eigen::Vector3d::Zero(), scan.direction);
  return scan;
}

}  // namespace collision::narrow_phase
