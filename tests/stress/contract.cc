// The contract check at the extremes: what an honest state may look like, and what it may not.
#include "collision_core/motion/contract.h"

#include <cmath>

#include "tests/stress/pair_judge.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact_between.h"
#include "tests/support/truth/exact_triangle.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

/// Beyond the bound by what a sender may lose in so many steps, each a unit in the last place of
/// place and speed, and by a nanosecond of stamp, a state is a breach for certain.
constexpr double kSteps = 1001;
constexpr double kNanosecond = 1.001e-9;

/// |p' − p − v s| − ½ M s² and |v' − v| − M s, each as square of the left over square of the right.
struct Excess {
  ExactVector off;
  Exact allowed;
  Exact size;  ///< Of all that is compared.

  bool Within(const Exact& more) const {
    const Exact most = allowed + more;
    return most >= 0 && Square(off) <= most * most;
  }
};

Exact SumOf(const ExactVector& v) { return abs(v.x) + abs(v.y) + abs(v.z); }

Excess OfPosition(const motion::SpaceTimeBound& before, const motion::MotionState& next) {
  const Exact s = ExactSeconds(before.state.stamp, next.stamp);
  const ExactVector p(before.state.p_WA), v(before.state.v_WA), q(next.p_WA);
  const Exact reach = Exact(before.limits.acceleration_max) / 2 * s * s;
  return {q - p - s * v, reach, SumOf(p) + SumOf(q)};
}

Excess OfVelocity(const motion::SpaceTimeBound& before, const motion::MotionState& next) {
  const Exact s = ExactSeconds(before.state.stamp, next.stamp);
  const ExactVector v(before.state.v_WA), w(next.v_WA);
  const Exact reach = Exact(before.limits.acceleration_max) * s;
  return {w - v, reach, SumOf(v) + SumOf(w) + reach};
}

void JudgeState(const motion::SpaceTimeBound& before, const motion::MotionState& next,
                Outcome* outcome) {
  const motion::ContractCheck check = CheckContract(before, next);
  const Excess position = OfPosition(before, next), velocity = OfVelocity(before, next);
  const Exact s = ExactSeconds(before.state.stamp, next.stamp);
  const Exact lost(kSteps * 0x1p-52), speed = velocity.size;
  const Exact more_v = lost * speed + Exact(kNanosecond) * Exact(before.limits.acceleration_max);
  const Exact more_p = lost * (position.size + speed * s) + more_v * s + Exact(kNanosecond) * speed;
  const bool breached = check.verdict == motion::ContractVerdict::kBreached;
  outcome->Add(breached ? "breaches" : "states_kept", 1);
  const bool apart = BallsComeApart(before, next);
  if (position.Within(0) && velocity.Within(0) && !apart) {
    outcome->Expect(!breached, "an honest state is reported as a breach");
  }
  const bool beyond = !position.Within(more_p) || !velocity.Within(more_v);
  const bool contradicts = apart && !beyond && BallsComeApart(before, next, 1, more_p + more_v * s);
  if (beyond || contradicts) {
    outcome->Add(beyond ? "beyond" : "contradicts", 1);
    outcome->Expect(breached, "a breach is not noticed");
  }
  for (const double x : {check.position_excess, check.velocity_excess, check.between_excess,
                         check.position_drift, check.velocity_drift}) {
    outcome->Expect(std::isfinite(x) && x >= 0, "an excess is no number");
  }
  // What rounding may have cost makes up for what the new horn may stick out of the old one.
  if (breached) return;
  outcome->Expect(
      position.Within(Exact(check.position_drift)) && velocity.Within(Exact(check.velocity_drift)),
      "a state that is kept lies beyond the drift that is told");
  const auto share = [](double drift, const Exact& most) {
    return drift > 0 ? drift / most.convert_to<double>() : 0;
  };
  outcome->Greatest("drift_share", std::max(share(check.position_drift, more_p),
                                            share(check.velocity_drift, more_v)));
  outcome->Expect(Exact(check.position_drift) <= more_p && Exact(check.velocity_drift) <= more_v,
                  "a drift that rounding does not explain");
}

// A state after a step of 1 ns to a century, with all of M, a little less, or a little more, all
// the way or turned round once.
void Contract(const Setting& setting, Outcome* outcome) {
  Random random(601);
  for (int i = 0; i < setting.Many(4000, 100'000); ++i) {
    const auto any = [&random](double lo, double hi) {
      return random.Chance(0.15) ? 0 : random.LogUniform(lo, hi);
    };
    motion::SpaceTimeBound before =
        Ball(any(1e-12, 1e15) * random.UnitVector(), any(1e-12, 299792458) * random.UnitVector(), 1,
             any(1e-12, 1e18));
    const std::int64_t century = 3'155'760'000'000'000'000;
    before.state.stamp = Instant::FromNanoseconds(random.Chance(0.5) ? century : -century);
    const auto step =
        static_cast<std::int64_t>(random.LogUniform(1, random.Chance(0.5) ? 1e9 : 1e18));
    motion::MotionState next = before.state;
    next.stamp = Instant::FromNanoseconds(before.state.stamp.nanoseconds() + step);
    const double s = static_cast<double>(step) * 1e-9;
    const double off = random.Chance(0.5) ? random.LogUniform(1e-17, 10) : 0;
    const double share = random.Chance(0.3) ? std::max(0.0, 1 - off) : 1 + off;
    const Vector3d a = share * before.limits.acceleration_max * random.UnitVector();
    const double back = random.Chance(0.5) ? s * random.Uniform(0, 1) : 0;  // The last part.
    next.v_WA += (s - 2 * back) * a;
    next.p_WA += s * before.state.v_WA + (s * s / 2 - back * back) * a;
    JudgeState(before, next, outcome);
  }
  outcome->Say(Show(outcome->Get("states_kept")) + " states kept, " +
               Show(outcome->Get("breaches")) + " breaches, " + Show(outcome->Get("beyond")) +
               " of them for certain, and " + Show(outcome->Get("contradicts")) +
               " because no motion leads there");
}

}  // namespace

std::vector<Case> ContractCases() {
  return {
      {"extreme", "contract",
       "in exact arithmetic: an honest state is never a breach, one that is "
       "1000 steps' rounding and a nanosecond beyond its bound, or beyond what any motion leads "
       "to, always is, and what is kept lies within the drift that is told, which is no more than "
       "that rounding and nanosecond",
       Contract}};
}

}  // namespace collision::stress
