// The states of one agent that are still needed, and what follows for the time between them.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/detection/agents/agent_declaration.h"
#include "collision_core/narrow_phase/pose/body_segment.h"

namespace collision::detection {

/// How a state follows from the one before it.
enum class Link {
  kFollows,  ///< By a motion under the declared bound: between the two both horns hold.
  kJumped,   ///< A declared discontinuity at its stamp: before it only the earlier horn holds.
  kBroken    ///< The bound was broken somewhere between the two: nothing is known there.
};

/// Holds samples, oldest first. When there are more than the capacity that Push() is given, it
/// drops every second sample of the older half that its neighbours bound; if there is none, it
/// drops the oldest, and what that covered becomes unknown.
class History {
 public:
  /// One state, as a bound, and what was declared with it.
  struct Sample {
    motion::SpaceTimeBound bound;
    broad_phase::CollisionFilter filter{};
    std::shared_ptr<const shape::Shape> shape = nullptr;  ///< As in AgentDeclaration.
    bool shape_awaited = false;                           ///< Likewise.
    Link link = Link::kFollows;
    std::shared_ptr<const shape::FixedHalfSpace> half_space = nullptr;  ///< Likewise.

    /// Whether the agent is more than a ball: it has a shape, known or not, or is a half-space.
    bool has_shape() const { return shape != nullptr || shape_awaited || half_space != nullptr; }
  };

  void Clear() { samples_.clear(); }
  void Push(const Sample& sample, std::size_t capacity);

  /// Gives every sample with the same body as this shape its tree: a better tree of the same
  /// geometry says nothing new about the past.
  void ReplaceTree(const std::shared_ptr<const shape::Shape>& shape);

  /// Forgets what is not needed from `since` on: later calls of Uninterrupted() and Over() may not
  /// go before it. The newest two samples stay.
  void Trim(Instant since);

  bool empty() const { return samples_.empty(); }

  /// The newest state. Requires !empty().
  const Sample& newest() const {
    CORE_CHECK(!samples_.empty(), "only a history with a state has a newest one");
    return samples_.back();
  }
  Sample& newest() { return const_cast<Sample&>(std::as_const(*this).newest()); }

  /// How many states are newer than `t`.
  std::size_t CountAfter(Instant t) const;

  /// The seconds between the newest two samples; 0 if there is only one.
  double LastInterval() const;

  /// The first instant later than `t` at which other bounds begin to hold: a stamp, an expiry, the
  /// edge of the skew about a jump. Never() if there is none.
  Instant NextCutAfter(Instant t) const;

  /// The newest stamp before `t`; Never() if there is none, or if the state stamped `t` follows
  /// from a jump or a breach.
  Instant LastStampBefore(Instant t) const;

  /// Whether a state at `t` began a motion: the first one, or a jump.
  bool BeginsAt(Instant t) const;

  /// The sample in force at `t`, if every later one follows from it; else nullptr.
  const Sample* Uninterrupted(Instant t) const;

  /// The newest sample stamped at or before `t`, from which what is known of `t` follows; nullptr
  /// if there is none, or the bound was broken between it and the next one.
  const Sample* SampleAt(Instant t) const;

  /// Calls `use` with the last bound of each motion since `from`: a jump or a breach begins a new
  /// one. Radius, acceleration and jerk are the greatest so far.
  template <typename Use>
  void ForEachMotion(Instant from, const Use& use) const {
    const std::size_t in_force = InForce(from);
    double radius = 0, acceleration_max = 0, jerk_max = 0;
    for (std::size_t i = in_force < samples_.size() ? in_force : 0; i < samples_.size(); ++i) {
      const motion::MotionLimits& limits = samples_[i].bound.limits;
      radius = std::max(radius, limits.radius);
      acceleration_max = std::max(acceleration_max, limits.acceleration_max);
      jerk_max = std::max(jerk_max, limits.jerk_max);
      if (i + 1 < samples_.size() && samples_[i + 1].link == Link::kFollows) continue;
      motion::SpaceTimeBound motion = samples_[i].bound;
      motion.limits.radius = radius;
      motion.limits.acceleration_max = acceleration_max;
      motion.limits.jerk_max = jerk_max;
      use(motion);
    }
  }

  /// What is certain on [from, to], where no cut lies strictly between. With samples of unequal
  /// radius the smaller counts, and the difference is added to the uncertainty; with samples of
  /// unequal shape, and about a jump, the shape counts as awaited.
  narrow_phase::BodySegment Over(Instant from, Instant to) const;

 private:
  void Thin();
  bool JumpsNear(std::size_t i, Instant from, Instant to) const;
  narrow_phase::BodySegment OverJump(std::size_t i, Instant from, Instant to) const;
  std::size_t InForce(Instant t) const;  // index of the last sample with stamp <= t; size() if none

  std::vector<Sample> samples_;
};

/// What is certain of two agents on [from, to], where no cut of either lies strictly between. Of a
/// half-space it is the block that stands in for it.
narrow_phase::BodyPair BothOver(const History& a, const History& b, Instant from, Instant to);

}  // namespace collision::detection
