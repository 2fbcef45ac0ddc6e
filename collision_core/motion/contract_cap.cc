#include "collision_core/motion/contract_cap.h"

#include "collision_core/base/check.h"
#include "collision_core/numeric/seconds.h"

namespace collision::motion {
namespace {

/// Both states, and what the checks share.
class Comparison {
 public:
  Comparison(const SpaceTimeBound& before, const MotionState& next)
      : before_(before),
        after_{next, before.limits, before.skew},
        lenient_(before),
        step_(numeric::IntervalVector(next.p_WA) - numeric::IntervalVector(before.state.p_WA)) {
    // Both stamps may be off, in opposite ways.
    lenient_.skew = 2 * before.skew;
    new_errors_ = ForwardErrors(after_, next.stamp).c0;
    new_deviation_ = ForwardDeviation(after_, next.stamp).c0;
  }

  CapCheck Result() {
    const numeric::Interval too_fast = numeric::Norm(numeric::IntervalVector(after_.state.v_WA)) -
                                       after_.state.velocity_error - before_.limits.speed_max;
    check_.velocity_excess = std::max(0.0, too_fast.lower);
    CompareBalls();
    const bool use_direction = DirectionHoldsFor(before_, after_.state.stamp) >= 0;
    const DirectionalReach all, directed = ReachOfDirection(before_.state);
    for (int axis = 0; axis < 3; ++axis) {
      CompareFaces({axis, 1}, all.upward[axis]);
      CompareFaces({axis, -1}, all.downward[axis]);
      if (use_direction) CompareFaces({axis, 1}, directed.upward[axis]);
      if (use_direction) CompareFaces({axis, -1}, directed.downward[axis]);
    }
    return check_;
  }

 private:
  /// The new ball at its stamp, in the old one.
  void CompareBalls() {
    const CappedBall cap = CappedBallOf(before_);
    const double early = TakenOverEarly(cap.from, CapStartOf(after_));
    const double speed = numeric::Norm(numeric::IntervalVector(before_.state.v_WA)).upper;
    if (early > 0) Drift(EarlyGrowth(numeric::Interval(2) * speed, early, cap.from));
    if (cap.from >= after_.state.stamp) return;
    const numeric::Interval away = numeric::Norm(step_ - cap.shift);
    Drift(away + (new_errors_ + new_deviation_) - cap.UFrom(after_.state.stamp).c0);
    Exceed(away, cap.from, cap.speed);
  }

  /// Likewise one face.
  void CompareFaces(FaceNormal face, numeric::Interval fraction) {
    const CappedFace cap = CappedFaceOf(before_, face, fraction);
    const double early = TakenOverEarly(cap.from, FaceCapStartOf(after_, face, fraction.upper));
    if (early > 0) Drift(EarlyGrowth(0, early, cap.from));
    if (cap.from >= after_.state.stamp) return;
    const numeric::Interval step = face.axis == 0 ? step_.x : face.axis == 1 ? step_.y : step_.z;
    const numeric::Interval away = numeric::Interval(face.sign) * step - cap.shift;
    const numeric::Interval u = new_errors_ + fraction * new_deviation_;
    Drift(away + u - cap.UFrom(after_.state.stamp).c0);
    if (fraction.lower == 1) Exceed(away, cap.from, cap.speed);
  }

  /// Seconds by which the new bound turns to the cap before the old one does.
  double TakenOverEarly(Instant old_from, Instant new_from) const {
    if (new_from >= old_from) return 0;
    return old_from.is_never() ? numeric::kInfinity
                               : numeric::SecondsBetween(new_from, old_from).upper;
  }

  /// What that adds: the velocities of the new ball fill the cap's, those of the old one fall short
  /// of it by 2 |v| + M t in the direction −v, t before it turns `at`; of a face by M t. With a
  /// known acceleration or jerk: by V' and the speed of the horn's centre at most.
  numeric::Interval EarlyGrowth(numeric::Interval shortfall, double early, Instant at) const {
    if (early == numeric::kInfinity) return {0, numeric::kInfinity};
    const numeric::Interval all = early;
    if (Bends(before_)) return all * (CappedSpeed(after_) + SpeedAt(at));
    return all * (shortfall + numeric::Interval(before_.limits.acceleration_max) * all);
  }

  /// The speed of the horn's centre up to `at`, at most.
  numeric::Interval SpeedAt(Instant at) const {
    const MotionState& state = before_.state;
    return numeric::Norm(numeric::IntervalVector(state.v_WA)) +
           numeric::Norm(numeric::IntervalVector(state.a_WA)) *
               numeric::SecondsBetween(state.stamp, at);
  }

  void Drift(numeric::Interval outside) {
    check_.position_drift = std::max(check_.position_drift, outside.upper);
  }

  /// No true motion is further `away` from where the cap took over: errors, both skews, and V'
  /// since. If the true time was shorter than up to `from`, |v| 2κ covers the difference.
  void Exceed(numeric::Interval away, Instant from, numeric::Interval speed) {
    const numeric::Interval since =
        numeric::SecondsBetween(from, after_.state.stamp) + numeric::Interval(2) * before_.skew;
    const numeric::Interval limit =
        ForwardBall(lenient_, from).u.c0 + after_.state.position_error + speed * since;
    check_.position_excess = std::max(check_.position_excess, (away - limit).lower);
  }

  const SpaceTimeBound& before_;
  const SpaceTimeBound after_;
  SpaceTimeBound lenient_;
  numeric::IntervalVector step_;
  numeric::Interval new_errors_, new_deviation_;  // The two parts of the new u at its stamp.
  CapCheck check_;
};

}  // namespace

CapCheck CheckCap(const SpaceTimeBound& before, const MotionState& next) {
  CORE_CHECK(HasSpeedCap(before.limits), "a cap is checked where one is declared");
  CORE_CHECK(next.stamp >= before.state.stamp, "a state follows the one before",
             next.stamp.nanoseconds(), before.state.stamp.nanoseconds());
  return Comparison(before, next).Result();
}

}  // namespace collision::motion
