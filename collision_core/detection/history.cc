#include "collision_core/detection/history.h"

#include <algorithm>

namespace collision {
namespace {

// The declaration under which an agent moved between two states: whatever either allowed.
AgentDeclaration Widest(const AgentDeclaration& a, const AgentDeclaration& b) {
  AgentDeclaration widest = b;
  widest.radius = std::max(a.radius, b.radius);
  widest.acceleration_max = std::max(a.acceleration_max, b.acceleration_max);
  widest.time_step = std::max(a.time_step, b.time_step);
  return widest;
}

}  // namespace

void History::Push(const SpaceTimeBound& bound, Link link, std::size_t capacity) {
  if (samples_.size() >= capacity) Thin();
  // Where nothing can be spared, the oldest goes, and what it covered becomes unknown.
  if (samples_.size() >= capacity) samples_.erase(samples_.begin());
  samples_.push_back({bound, link});
}

void History::Thin() {
  const auto spared = [this](std::size_t i) {
    return samples_[i].link == Link::kFollows && samples_[i + 1].link == Link::kFollows &&
           samples_[i].bound.declaration == samples_[i - 1].bound.declaration &&
           samples_[i].bound.declaration == samples_[i + 1].bound.declaration;
  };
  std::vector<Sample> kept;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (i % 2 == 1 && i + 1 < samples_.size() && spared(i)) continue;
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

Instant History::NextStampAfter(Instant t) const {
  const std::size_t k = InForce(t);
  const std::size_t next = k == samples_.size() ? 0 : k + 1;
  return next < samples_.size() ? samples_[next].bound.state.stamp : Instant::Never();
}

const SpaceTimeBound* History::Uninterrupted(Instant t) const {
  const std::size_t k = InForce(t);
  if (k == samples_.size()) return nullptr;
  for (std::size_t later = k + 1; later < samples_.size(); ++later) {
    if (samples_[later].link != Link::kFollows) return nullptr;
  }
  return &samples_[k].bound;
}

BallSegment History::Over(Instant from, Instant to) const {
  BallSegment segment;
  const std::size_t k = InForce(from);
  if (k == samples_.size()) return segment;
  const bool has_next = k + 1 < samples_.size();
  SpaceTimeBound last = samples_[k].bound;
  SpaceTimeBound next = samples_[has_next ? k + 1 : k].bound;
  segment.radius = std::min(last.declaration.radius, next.declaration.radius);
  const double spread = std::max(last.declaration.radius, next.declaration.radius) - segment.radius;
  last.declaration = next.declaration = Widest(last.declaration, next.declaration);

  const bool broken = has_next && samples_[k + 1].link == Link::kBroken;
  const bool at_last = to == last.state.stamp;
  if (to <= last.state.expiry && (!broken || at_last)) {
    segment.bounds.push_back(ForwardBall(last, from));
  }
  if (has_next && samples_[k + 1].link == Link::kFollows) {
    segment.bounds.push_back(BackwardBall(next, from));
  }
  for (MovingBall& ball : segment.bounds) ball.u0 = ball.u0 + Interval(spread);
  return segment;
}

}  // namespace collision
