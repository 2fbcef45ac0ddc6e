#include "collision_core/detection/agents/history.h"

#include <algorithm>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// The limits within which an agent moved between two states: whatever either allowed.
motion::MotionLimits Widest(const motion::MotionLimits& a, const motion::MotionLimits& b) {
  motion::MotionLimits widest = b;
  widest.radius = std::max(a.radius, b.radius);
  widest.acceleration_max = std::max(a.acceleration_max, b.acceleration_max);
  widest.jerk_max = std::max(a.jerk_max, b.jerk_max);
  widest.time_step = std::max(a.time_step, b.time_step);
  widest.angular_acceleration_max =
      motion::WiderAngularBound(a.angular_acceleration_max, b.angular_acceleration_max);
  return widest;
}

bool SameDeclaration(const History::Sample& a, const History::Sample& b) {
  return a.bound.limits == b.bound.limits && a.filter == b.filter && a.shape == b.shape &&
         a.shape_awaited == b.shape_awaited;
}

}  // namespace

void History::Push(const Sample& sample, std::size_t capacity) {
  if (samples_.size() >= capacity) Thin();
  // Where no sample can be spared, the oldest is dropped, and what it covered becomes unknown.
  if (samples_.size() >= capacity) samples_.erase(samples_.begin());
  samples_.push_back(sample);
}

void History::ReplaceTree(const std::shared_ptr<const shape::Shape>& shape) {
  for (Sample& sample : samples_) {
    if (sample.shape && sample.shape->IsSameBodyAs(*shape)) sample.shape = shape;
  }
}

// Only samples of the older half are dropped: pairs are still evaluated over the newer half.
void History::Thin() {
  const auto spared = [this](std::size_t i) {
    return samples_[i].link == Link::kFollows && samples_[i + 1].link == Link::kFollows &&
           SameDeclaration(samples_[i], samples_[i - 1]) &&
           SameDeclaration(samples_[i], samples_[i + 1]);
  };
  std::vector<Sample> kept;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const bool old = i % 2 == 1 && i < (samples_.size() + 1) / 2 && i + 1 < samples_.size();
    if (old && spared(i)) continue;
    kept.push_back(samples_[i]);
  }
  samples_.swap(kept);
}

void History::Trim(Instant since) {
  std::size_t drop = 0;
  while (drop + 2 < samples_.size() && samples_[drop + 1].bound.state.stamp <= since) ++drop;
  samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(drop));
}

std::size_t History::InForce(Instant t) const {
  std::size_t k = samples_.size();
  while (k > 0 && samples_[k - 1].bound.state.stamp > t) --k;
  return k == 0 ? samples_.size() : k - 1;
}

std::size_t History::CountAfter(Instant t) const {
  const std::size_t in_force = InForce(t);
  return in_force == samples_.size() ? samples_.size() : samples_.size() - 1 - in_force;
}

double History::LastInterval() const {
  if (samples_.size() < 2) return 0;
  return numeric::SecondsBetween(samples_[samples_.size() - 2].bound.state.stamp,
                                 newest().bound.state.stamp)
      .upper;
}

Instant History::NextCutAfter(Instant t) const {
  Instant next = Instant::Never();
  const auto cut = [&](Instant at) {
    if (at > t) next = std::min(next, at);
  };
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const motion::SpaceTimeBound& bound = samples_[i].bound;
    cut(bound.state.stamp);
    cut(bound.state.expiry);
    if (i > 0 && samples_[i].link == Link::kJumped && bound.skew > 0) {
      cut(numeric::AddRoundedDown(bound.state.stamp, -bound.skew));
      cut(numeric::AddRoundedUp(bound.state.stamp, bound.skew));
    }
  }
  return next;
}

Instant History::LastStampBefore(Instant t) const {
  for (std::size_t i = samples_.size(); i-- > 0;) {
    const Instant stamp = samples_[i].bound.state.stamp;
    if (stamp < t) return stamp;
    if (stamp == t && samples_[i].link != Link::kFollows) break;
  }
  return Instant::Never();
}

bool History::BeginsAt(Instant t) const {
  return std::any_of(samples_.begin(), samples_.end(), [t](const Sample& sample) {
    return sample.bound.state.stamp == t && sample.link == Link::kJumped;
  });
}

const History::Sample* History::Uninterrupted(Instant t) const {
  const std::size_t k = InForce(t);
  if (k == samples_.size()) return nullptr;
  for (std::size_t later = k + 1; later < samples_.size(); ++later) {
    if (samples_[later].link != Link::kFollows) return nullptr;
  }
  return &samples_[k];
}

const History::Sample* History::SampleAt(Instant t) const {
  const std::size_t k = InForce(t);
  if (k == samples_.size()) return nullptr;
  const bool broken = k + 1 < samples_.size() && samples_[k + 1].link == Link::kBroken;
  return broken ? nullptr : &samples_[k];
}

bool History::JumpsNear(std::size_t i, Instant from, Instant to) const {
  const motion::SpaceTimeBound& bound = samples_[i].bound;
  return samples_[i].link == Link::kJumped && bound.skew > 0 &&
         numeric::AddRoundedDown(bound.state.stamp, -bound.skew) <= from &&
         to <= numeric::AddRoundedUp(bound.state.stamp, bound.skew);
}

// By our clock the jump may have come anywhere within the skew: the agent moves as before it, or as
// after it, so that one ball must contain both. With c, u of before and c', u' of after, all of
// both lies within
//   u + u' + |c' − c| <= u + u' + |Δc| + |Δv| δ + ½ |Δa| δ²   about c(δ).
narrow_phase::BodySegment History::OverJump(std::size_t i, Instant from, Instant to) const {
  narrow_phase::BodySegment segment;
  for (std::size_t other = i + 1; other < samples_.size(); ++other) {
    if (JumpsNear(other, from, to)) return segment;  // more than two motions: nothing is known
  }
  const motion::SpaceTimeBound& before = samples_[i - 1].bound;
  const motion::SpaceTimeBound& after = samples_[i].bound;
  segment.awaited = samples_[i - 1].has_shape() || samples_[i].has_shape();
  if (from < before.state.stamp || !SameDeclaration(samples_[i - 1], samples_[i])) return segment;
  numeric::MovingBall ball = ForwardBall(before, from);
  const numeric::MovingBall jumped =
      from >= after.state.stamp ? ForwardBall(after, from) : BackwardBall(after, from);
  ball.u.c0 = ball.u.c0 + jumped.u.c0 + numeric::Norm(jumped.centre() - ball.centre());
  ball.u.c1 = ball.u.c1 + jumped.u.c1 + numeric::Norm(jumped.velocity - ball.velocity);
  ball.u.c2 = ball.u.c2 + jumped.u.c2;
  ball.u.c3 = ball.u.c3 + jumped.u.c3;
  if (ball.bends || jumped.bends) ball.u.c2 = ball.u.c2 + numeric::Norm(jumped.bend - ball.bend);
  segment.ball.radius = before.limits.radius;
  segment.ball.bounds.push_back(ball);
  return segment;
}

narrow_phase::BodySegment History::Over(Instant from, Instant to) const {
  narrow_phase::BodySegment segment;
  const std::size_t k = InForce(from);
  if (k == samples_.size()) return segment;
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    if (JumpsNear(i, from, to)) return OverJump(i, from, to);
  }
  const bool has_next = k + 1 < samples_.size();
  const Sample &sample = samples_[k], &next_sample = samples_[has_next ? k + 1 : k];
  motion::SpaceTimeBound last = sample.bound, next = next_sample.bound;
  narrow_phase::BallSegment& ball = segment.ball;
  ball.radius = std::min(last.limits.radius, next.limits.radius);
  const numeric::Interval spread =
      numeric::Interval(std::max(last.limits.radius, next.limits.radius)) - ball.radius;
  if (sample.shape == next_sample.shape) segment.shape = sample.shape;
  segment.half_space = sample.half_space;
  segment.awaited =
      !segment.shape && !segment.half_space && (sample.has_shape() || next_sample.has_shape());
  last.limits = next.limits = Widest(last.limits, next.limits);

  const bool broken = has_next && samples_[k + 1].link == Link::kBroken;
  const bool at_last = to == last.state.stamp;
  if (to <= last.state.expiry && (!broken || at_last)) {
    ball.bounds.push_back(ForwardBall(last, from));
    if (segment.shape) segment.turns.push_back(ForwardRotation(last, from));
  }
  if (has_next && samples_[k + 1].link == Link::kFollows) {
    ball.bounds.push_back(BackwardBall(next, from));
    if (segment.shape) segment.turns.push_back(BackwardRotation(next, from));
  }
  for (numeric::MovingBall& bound : ball.bounds) bound.u.c0 = bound.u.c0 + spread;
  return segment;
}

narrow_phase::BodyPair BothOver(const History& a, const History& b, Instant from, Instant to) {
  narrow_phase::BodyPair bodies{a.Over(from, to), b.Over(from, to)};
  ReplaceHalfSpace(numeric::SecondsBetween(from, to).upper, &bodies);
  return bodies;
}

}  // namespace collision::detection
