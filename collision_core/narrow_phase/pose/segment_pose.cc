#include "collision_core/narrow_phase/pose/segment_pose.h"

#include <algorithm>

#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

// A product of two matrices of norm at most 1 + 2^-20, entry by entry three products and two sums:
// each entry is off by less than 3.1 kUnitRoundoff, the matrix as a whole by less than three times
// as much.
constexpr double kProductRounding = 16 * numeric::kUnitRoundoff;

struct Orientation {
  numeric::Rotation rotation;
  double chord = 0;
};

// A rotation with a larger error counts as unknown (kRotationAngleMax).
constexpr double kAnyRotation = 0.5;

// The chord 2 sin(θ/2) is at most θ, and less by θ²/24 of it: up to this angle [rad], where that is
// less than a thousandth, θ itself will do.
constexpr double kSmallAngle = 0.125;

// Less than π: up to this angle [rad] the chord grows with it. Beyond, 2 bounds it.
constexpr double kGrowingAngle = 3.14159;

// A ball looks the same however it is turned. For a body that may be turned any way, every exact
// orientation is as good as another.
Orientation OrientationOf(const BodySegment& body, std::size_t bound, double delta) {
  if (!body.shape) return {};
  const motion::MovingRotation& turn = body.turns[bound];
  Orientation orientation{RotationOf(turn.OrientationAt(delta)), 2};
  if (orientation.rotation.error > kAnyRotation) return {numeric::Rotation{}, 2};
  const double angle = std::max(0.0, turn.angle_error.At(delta).upper);
  if (angle <= kSmallAngle) orientation.chord = angle;
  if (angle > kSmallAngle && angle < kGrowingAngle) {
    orientation.chord = std::min(2.0, 2 * SinCosOf(numeric::Interval(angle / 2)).sin.upper);
  }
  return orientation;
}

// Only chooses among bounds that all hold.
double TurnedAbout(const motion::MovingRotation& turn, double delta) {
  const double seconds = turn.since.middle() + delta;
  const bool followed = turn.w_WB.squaredNorm() * seconds * seconds <=
                        numeric::kRotationAngleMax * numeric::kRotationAngleMax;
  return followed ? std::min(2.0, turn.angle_error.At(delta).upper) : 2;
}

double Uncertainty(const BodySegment& body, std::size_t bound, double delta) {
  const double turned =
      body.shape ? TurnedAbout(body.turns[bound], delta) * TurningReachOf(body) : 0;
  return body.ball.bounds[bound].u.At(delta).upper + turned;
}

std::size_t LeastUncertain(const BodySegment& body, double delta) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < body.ball.bounds.size(); ++i) {
    if (Uncertainty(body, i, delta) < Uncertainty(body, best, delta)) best = i;
  }
  return best;
}

numeric::IntervalVector CentreAt(const numeric::MovingBall& ball, double delta) {
  return ball.centre() + ball.PathTo(delta);
}

double Width(const numeric::IntervalVector& v, const Eigen::Vector3d& middle) {
  return numeric::Norm(v - numeric::IntervalVector(middle)).upper;
}

}  // namespace

BoundChoice BestBounds(const BodySegment& a, const BodySegment& b, double delta) {
  if (a.ball.bounds.empty() || b.ball.bounds.empty()) return {};
  return {LeastUncertain(a, delta), LeastUncertain(b, delta), true};
}

RelativePose PoseAt(const BodySegment& a, const BodySegment& b, BoundChoice choice, double delta) {
  const numeric::MovingBall& ball_a = a.ball.bounds[choice.of_a];
  const numeric::MovingBall& ball_b = b.ball.bounds[choice.of_b];
  const Orientation of_a = OrientationOf(a, choice.of_a, delta);
  const Orientation of_b = OrientationOf(b, choice.of_b, delta);
  // Positions are subtracted first: far from the origin nothing is lost but what the states lost.
  numeric::IntervalVector d = (ball_b.centre() - ball_a.centre()) +
                              numeric::Interval(delta) * (ball_b.velocity - ball_a.velocity);
  if (ball_a.bends || ball_b.bends) {
    d = d + Square(numeric::Interval(delta)) * (ball_b.bend - ball_a.bend);
  }
  const Eigen::Vector3d middle = d.middle();
  const double length = numeric::Norm(numeric::IntervalVector(middle)).upper;

  RelativePose pose;
  pose.R_AB = of_a.rotation.matrix.transpose() * of_b.rotation.matrix;
  pose.p_AB = of_a.rotation.matrix.transpose() * middle;
  const double errors = numeric::AddUp(of_a.rotation.error, of_b.rotation.error);
  pose.matrix_error = numeric::AddUp(
      numeric::AddUp(errors, numeric::MultiplyUp(of_a.rotation.error, of_b.rotation.error)),
      kProductRounding + kPosingRounding);
  pose.offset_error = numeric::AddUp(
      Width(d, middle),
      numeric::MultiplyUp(numeric::AddUp(of_a.rotation.error, kProductRounding + kPosingRounding),
                          length));
  pose.translation = std::max(0.0, (ball_a.u.At(delta) + ball_b.u.At(delta)).upper);
  pose.chord_A = of_a.chord;
  pose.chord_B = of_b.chord;

  const numeric::IntervalVector centre_A = CentreAt(ball_a, delta);
  pose.p_WA = centre_A.middle();
  pose.R_WA = of_a.rotation.matrix;
  const double rounding = numeric::MultiplyUp(
      kPosingRounding, numeric::AddUp(numeric::Norm(centre_A).upper, a.ball.radius + length));
  pose.error_A = numeric::AddUp(
      numeric::AddUp(ball_a.u.At(delta).upper, Width(centre_A, pose.p_WA)),
      numeric::AddUp(rounding, numeric::MultiplyUp(of_a.rotation.error, TurningReachOf(a))));
  return pose;
}

}  // namespace collision::narrow_phase
