#include "collision_core/narrow_phase/shape_motion.h"

#include <algorithm>

namespace collision {

/// With h the seconds from the instant on: the prediction moves any two points relative to each
/// other by at most speed h, where translation alone does by along h and turning by spin h (the
/// faster of the two bodies); the uncertainty of translation is u(h), that of turning moves a point
/// by at most turned c1 h + c2 h² more than at the instant.
struct ShapeMotion::Drift {
  Interval along;
  Interval spin_sum, spin_most;
  Quadratic translation;
  Interval turned1_sum, turned2_sum, turned1_most, turned2_most;
};

namespace {

/// |ω| R, and the growth of θ R; the chord 2 sin(θ/2) grows no faster than θ, but shrinks slower.
struct Turning {
  Interval spin, turned1, turned2;
};

Turning TurningOf(const BodySegment& body, std::size_t bound, double at, bool backward) {
  if (!body.shape) return {0, 0, 0};
  const MovingTurn& turn = body.turns[bound];
  const Quadratic angle = backward ? turn.off_angle.BackwardFrom(at) : turn.off_angle.From(at);
  const Interval reach = ReachOf(body);
  return {reach * Norm(IntervalVector(turn.w_WB)), reach * Max(0, angle.c1), reach * angle.c2};
}

// The tangent's deviation ½ |ω|² h² belongs to what turning may move a point by.
SweptPose::Growth GrowthOf(const BodySegment& body, std::size_t bound, double at, bool backward,
                           double chord) {
  if (!body.shape) return {};
  const MovingTurn& turn = body.turns[bound];
  const Quadratic angle = backward ? turn.off_angle.BackwardFrom(at) : turn.off_angle.From(at);
  const Interval bend = Interval(0.5) * Square(Norm(IntervalVector(turn.w_WB)));
  return {chord, std::max(0.0, angle.c1.upper), std::max(0.0, (Max(0, angle.c2) + bend).upper)};
}

// Half of the acceleration of the point that turning moves the most [m/s²].
double BendOf(const BodySegment& body, std::size_t bound) {
  return body.shape ? 0.5 * body.turns[bound].w_WB.squaredNorm() * ReachOf(body) : 0;
}

// What tangents leave their circles by matters beyond this share of the bodies' size.
constexpr double kFineBend = 1e-6;

// Within so small a turn [rad] a tangent leaves its circle by 3 % of the radius.
constexpr double kTurnOfSweep = 0.25;

// Nearer to the middle of a segment than this share of it is the middle.
constexpr double kNearMiddle = 1e-6;

}  // namespace

ShapeMotion::ShapeMotion(const BodySegment& a, const BodySegment& b, Work* work)
    : a_(a), b_(b), surface_a_(a), surface_b_(b), work_(*work) {}

ShapeMotion::Instance ShapeMotion::InstanceAt(double at) const {
  Instance instance;
  instance.at = at;
  instance.choice = BestBounds(a_, b_, at);
  if (!instance.choice.certain) return instance;
  work_.Spend(kPoseUnits);
  instance.pose = PoseAt(a_, b_, instance.choice, at);
  instance.uncertainty =
      AddUp(instance.pose.translation,
            AddUp(MultiplyUp(instance.pose.chord_A, surface_a_.turning_reach()),
                  MultiplyUp(instance.pose.chord_B, surface_b_.turning_reach())));
  return instance;
}

ShapeMotion::Instance ShapeMotion::LookAt(double at, Goal goal, const Evidence& hint) const {
  Instance instance = InstanceAt(at);
  if (!instance.choice.certain) return instance;
  instance.look = collision::LookAt(surface_a_, surface_b_, instance.pose, goal, &work_, hint);
  return instance;
}

ShapeMotion::Instance ShapeMotion::LookAgain(double at, const Evidence& evidence) const {
  Instance instance = InstanceAt(at);
  if (!instance.choice.certain) return instance;
  instance.look = collision::LookAgain(surface_a_, surface_b_, instance.pose, evidence, &work_);
  return instance;
}

// The bounds that are the least uncertain half-way are taken for the whole sweep.
ShapeMotion::Sweep ShapeMotion::SweepFrom(double at, double span, bool backward) const {
  Sweep sweep;
  const double middle = backward ? at - 0.5 * span : at + 0.5 * span;
  const BoundChoice choice = BestBounds(a_, b_, std::max(0.0, middle));
  if (!choice.certain) return sweep;
  sweep.known = true;
  work_.Spend(kPoseUnits);
  sweep.pose = PoseAt(a_, b_, choice, at);
  const MovingBall& ball_A = a_.ball.bounds[choice.of_A];
  const MovingBall& ball_B = b_.ball.bounds[choice.of_B];
  const IntervalVector velocity = ball_B.velocity - ball_A.velocity;
  const double sign = backward ? -1 : 1;
  const auto seen = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(sign * sweep.pose.matrix_WA.transpose() * v);
  };
  SweptPose swept;
  swept.pose = sweep.pose;
  swept.velocity = seen(velocity.middle());
  if (a_.shape) swept.spin_A = seen(a_.turns[choice.of_A].w_WB);
  if (b_.shape) swept.spin_B = seen(b_.turns[choice.of_B].w_WB);
  // Each of the three is turned by a matrix that is off by matrix_error at most, and rounded.
  const Interval fastest = Norm(velocity) + TurningOf(a_, choice.of_A, at, backward).spin +
                           TurningOf(b_, choice.of_B, at, backward).spin;
  swept.velocity_error = MultiplyUp(2 * sweep.pose.matrix_error + 0x1p-47, fastest.upper);
  const Quadratic both = ball_A.u() + ball_B.u();
  const Quadratic u = backward ? both.BackwardFrom(at) : both.From(at);
  swept.translation = {u.c0.upper, u.c1.upper, std::max(0.0, u.c2.upper)};
  swept.turning_A = GrowthOf(a_, choice.of_A, at, backward, sweep.pose.chord_A);
  swept.turning_B = GrowthOf(b_, choice.of_B, at, backward, sweep.pose.chord_B);
  sweep.touch = TouchOf(surface_a_, surface_b_, swept, span, &work_);
  if (sweep.touch.resolved) {
    const double h = sweep.touch.seconds;
    const double bend = BendOf(a_, choice.of_A) + BendOf(b_, choice.of_B);
    const double unknown =
        swept.translation.c0 + h * (swept.translation.c1 + h * swept.translation.c2);
    sweep.final =
        bend * h * h <= std::max(unknown, kFineBend * (surface_a_.reach() + surface_b_.reach()));
  }
  return sweep;
}

double ShapeMotion::SpanFrom(double at, double left, bool backward, double duration) const {
  double span = left;
  for (const BodySegment* body : {&a_, &b_}) {
    for (const MovingTurn& turn : body->turns) {
      const double rate = turn.w_WB.norm();
      if (rate * span > kTurnOfSweep) span = kTurnOfSweep / rate;
    }
    const double half = 0.5 * duration;
    const double to_middle = backward ? at - half : half - at;
    if (body->ball.bounds.size() > 1 && to_middle > kNearMiddle * duration) {
      span = std::min(span, to_middle);
    }
  }
  return span;
}

void ShapeMotion::LookInside(Instance* instance) const {
  Look& look = instance->look;
  if (!instance->choice.certain || !(look.lower > instance->pose.translation)) return;
  const Nesting nesting = NestingOf(surface_a_, surface_b_, instance->pose, &work_);
  if (!nesting.certain() || look.upper <= -look.lower) return;
  look.upper = -look.lower;
  look.point = nesting.point;
  look.point_error = nesting.point_error;
}

bool ShapeMotion::NeitherInside(const RelativePose& pose) const {
  return NestingOf(surface_a_, surface_b_, pose, &work_).neither;
}

ShapeMotion::Drift ShapeMotion::DriftFrom(const Instance& instance, bool backward) const {
  const MovingBall& ball_A = a_.ball.bounds[instance.choice.of_A];
  const MovingBall& ball_B = b_.ball.bounds[instance.choice.of_B];
  const Quadratic u = ball_A.u() + ball_B.u();
  const Turning of_A = TurningOf(a_, instance.choice.of_A, instance.at, backward);
  const Turning of_B = TurningOf(b_, instance.choice.of_B, instance.at, backward);
  Drift drift;
  drift.along = Norm(ball_B.velocity - ball_A.velocity);
  drift.spin_sum = of_A.spin + of_B.spin;
  drift.spin_most = Max(of_A.spin, of_B.spin);
  drift.translation = backward ? u.BackwardFrom(instance.at) : u.From(instance.at);
  drift.turned1_sum = of_A.turned1 + of_B.turned1;
  drift.turned2_sum = of_A.turned2 + of_B.turned2;
  drift.turned1_most = Max(of_A.turned1, of_B.turned1);
  drift.turned2_most = Max(of_A.turned2, of_B.turned2);
  return drift;
}

// Balls within the solids that overlap by −upper do so until that is used up. Crossing triangles
// cross while no corner moves further than the margin: seen from half-way between the two bodies
// each corner moves by half of what translation does, and by the turning of its own body.
double ShapeMotion::ContactStep(const Instance& instance, bool backward) const {
  const Drift d = DriftFrom(instance, backward);
  double step = 0;
  if (instance.look.upper <= -instance.pose.translation) {
    const Interval gap = Interval(-instance.look.upper) - d.translation.c0;
    const Interval closing = d.along + d.spin_sum + d.translation.c1 + d.turned1_sum;
    const Interval growth = d.translation.c2 + d.turned2_sum;
    step = FirstZero(gap.lower, closing.upper, std::max(0.0, growth.upper));
  }
  if (instance.look.crossing_margin >= instance.pose.translation / 2) {
    const Interval half = 0.5;
    const Interval gap = Interval(instance.look.crossing_margin) - half * d.translation.c0;
    const Interval closing = half * (d.along + d.translation.c1) + d.spin_most + d.turned1_most;
    const Interval growth = half * d.translation.c2 + d.turned2_most;
    step = std::max(step, FirstZero(gap.lower, closing.upper, std::max(0.0, growth.upper)));
  }
  return step;
}

double ShapeMotion::SpeedAt(const Instance& instance) const {
  const Drift drift = DriftFrom(instance, false);
  return (drift.along + drift.spin_sum).upper;
}

}  // namespace collision
