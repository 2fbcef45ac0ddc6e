#include "collision_core/detection/encounter/event_facts.h"

#include "collision_core/base/work_budget.h"
#include "collision_core/detection/encounter/expectation.h"
#include "collision_core/detection/encounter/proximity_at.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

std::optional<StateUsed> Used(const History::Sample* sample) {
  if (sample == nullptr) return std::nullopt;
  const motion::MotionState& state = sample->bound.state;
  return StateUsed{state.stamp, state.p_WA, state.v_WA, state.a_WA};
}

struct VelocityAt {
  numeric::IntervalVector v;
  numeric::Interval error;
};

numeric::IntervalVector Cross(const numeric::IntervalVector& a, const numeric::IntervalVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Of the agent's point at `place`.
std::optional<VelocityAt> VelocityOf(const History& history, Instant at,
                                     const Eigen::Vector3d& place, double place_error) {
  const History::Sample* sample = history.SampleAt(at);
  if (sample == nullptr) return std::nullopt;
  const motion::SpaceTimeBound& bound = sample->bound;
  const motion::MotionState& state = bound.state;
  const motion::MotionLimits& limits = bound.limits;
  const numeric::Interval since = numeric::SecondsBetween(state.stamp, at);
  const numeric::Interval step = limits.time_step, sigma = since + bound.skew + step;
  const numeric::IntervalVector a(state.a_WA);
  VelocityAt velocity;
  velocity.v = numeric::IntervalVector(state.v_WA) + since * a;
  velocity.error = numeric::Interval(state.velocity_error) +
                   numeric::Norm(a) * (step + bound.skew) + limits.acceleration_max * sigma +
                   numeric::Interval(0.5) * limits.jerk_max * Square(sigma);
  if (!sample->shape) return velocity;
  if (limits.angular_acceleration_max < 0) return std::nullopt;
  const numeric::MovingBall ball = ForwardBall(bound, at);
  const numeric::IntervalVector arm = numeric::IntervalVector(place) - ball.centre();
  const numeric::IntervalVector w(state.w_WB);
  velocity.v = velocity.v + Cross(w, arm);
  const numeric::Interval unknown = ball.u.At(0) + place_error;
  velocity.error = velocity.error + numeric::Norm(w) * unknown +
                   limits.angular_acceleration_max * sigma * (numeric::Norm(arm) + unknown);
  return velocity;
}

}  // namespace

std::optional<RelativeVelocity> RelativeVelocityAt(const History& lower, const History& higher,
                                                   Instant at, const Eigen::Vector3d& point,
                                                   double point_error) {
  const auto of_lower = VelocityOf(lower, at, point, point_error);
  const auto of_higher = VelocityOf(higher, at, point, point_error);
  if (!of_lower || !of_higher) return std::nullopt;
  const numeric::IntervalVector v = of_higher->v - of_lower->v;
  RelativeVelocity relative;
  relative.v_AB = v.middle();
  relative.error = (numeric::Norm(v - numeric::IntervalVector(relative.v_AB)) + of_lower->error +
                    of_higher->error)
                       .upper;
  if (!(relative.error < numeric::kInfinity)) return std::nullopt;
  return relative;
}

EncounterAnswer EventFacts::At(Instant at) {
  const History &lower = lower_.history, &higher = higher_.history;
  WorkBudget work(limits_.proximity_units);
  EncounterAnswer answer;
  answer.found = ProximityAt(lower, higher, at, &work);
  answer.relative_velocity =
      RelativeVelocityAt(lower, higher, at, answer.found.p_WC, answer.found.point_error);
  answer.lower_state = Used(lower.SampleAt(at));
  answer.higher_state = Used(higher.SampleAt(at));
  answer.work = work.spent();
  counters_->work_units += work.spent();
  return answer;
}

ExpectationAnswer EventFacts::Expected() {
  WorkBudget work(limits_.expected_units);
  ExpectationAnswer answer;
  answer.expected =
      ExpectationOf(lower_.history, higher_.history, limits_.now, limits_.ahead, &work);
  answer.lower_state = Used(&lower_.history.newest());
  answer.higher_state = Used(&higher_.history.newest());
  counters_->encounter_units += work.spent();
  return answer;
}

}  // namespace collision::detection
