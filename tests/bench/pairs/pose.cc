#include "tests/bench/pairs/pose.h"

namespace collision::bench {

Eigen::Matrix3d RotationOf(const PlainPose& pose) {
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation(i, j) = pose.rotation[i][j];
  }
  return rotation;
}

Eigen::Vector3d OffsetOf(const PlainPose& pose) {
  return {pose.offset[0], pose.offset[1], pose.offset[2]};
}

narrow_phase::RelativePose PoseOf(const PlainPose& pose) {
  return collision::narrow_phase::PoseOf(RotationOf(pose), OffsetOf(pose));
}

narrow_phase::BodySegment BodyOf(std::shared_ptr<const shape::Shape> shape) {
  narrow_phase::BodySegment body;
  body.shape = std::move(shape);
  return body;
}

PairOracle OracleOf(std::shared_ptr<const shape::Shape> shape) {
  const narrow_phase::BodySegment body = BodyOf(std::move(shape));
  return {[body](const narrow_phase::RelativePose& pose) {
            WorkBudget work(kUnlimited);
            return narrow_phase::DecideAt(
                       {narrow_phase::BodyTree(body), narrow_phase::BodyTree(body), pose}, &work)
                .verdict;
          },
          [body](const narrow_phase::RelativePose& pose, double width) {
            WorkBudget work(kUnlimited);
            const narrow_phase::SeparationBracket look = narrow_phase::BracketSeparation(
                {narrow_phase::BodyTree(body), narrow_phase::BodyTree(body), pose}, {width, 0},
                &work);
            return numeric::Interval(look.lower, look.upper);
          }};
}

PlainPose Placement::Plainly(double along) const {
  const Eigen::Vector3d offset = along * direction;
  PlainPose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.rotation[i][j] = rotation(i, j);
    pose.offset[i] = offset[i];
  }
  return pose;
}

std::optional<double> Boundary(double diameter, double tolerance,
                               const std::function<bool(double along)>& is_near) {
  double near = 0, far = 2 * diameter;
  if (!is_near(near)) return std::nullopt;
  while (far - near > tolerance) {
    const double middle = 0.5 * (near + far);
    if (middle <= near || middle >= far) break;
    (is_near(middle) ? near : far) = middle;
  }
  return far;
}

}  // namespace collision::bench
