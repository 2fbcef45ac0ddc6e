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

}  // namespace

ShapeMotion::ShapeMotion(const BodySegment& a, const BodySegment& b, Work* work)
    : a_(a), b_(b), surface_a_(a), surface_b_(b), work_(*work) {}

ShapeMotion::Instance ShapeMotion::LookAt(double at, Goal goal) const {
  Instance instance;
  instance.at = at;
  instance.choice = BestBounds(a_, b_, at);
  if (!instance.choice.certain) return instance;
  work_.Spend(kPoseUnits);
  instance.pose = PoseAt(a_, b_, instance.choice, at);
  instance.look = collision::LookAt(surface_a_, surface_b_, instance.pose, goal, &work_);
  instance.uncertainty =
      AddUp(instance.pose.translation,
            AddUp(MultiplyUp(instance.pose.chord_A, surface_a_.turning_reach()),
                  MultiplyUp(instance.pose.chord_B, surface_b_.turning_reach())));
  return instance;
}

bool ShapeMotion::NeitherInside(const Instance& instance) const {
  return collision::NeitherInside(surface_a_, surface_b_, instance.pose, &work_);
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

// The distance is at least lower − (along + spins) h − turned(h), and it must exceed u(h).
double ShapeMotion::FreeStep(const Instance& instance, bool backward) const {
  const Drift d = DriftFrom(instance, backward);
  const Interval gap = Interval(instance.look.lower) - d.translation.c0;
  const Interval closing = d.along + d.spin_sum + d.translation.c1 + d.turned1_sum;
  const Interval growth = d.translation.c2 + d.turned2_sum;
  return FirstZero(gap.lower, closing.upper, std::max(0.0, growth.upper));
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

}  // namespace collision
