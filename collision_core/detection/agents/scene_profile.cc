#include "collision_core/detection/agents/scene_profile.h"

namespace collision::detection {
namespace {

enum Feature {
  kAccelerating,
  kKnowing,
  kJerking,
  kCapped,
  kDirected,
  kStepping,
  kUncertain,
  kSkewed,
  kExpiring,
  kMasked,
  kShaped,
  kTurning,
  kMoving
};

}  // namespace

SceneProfile::Features SceneProfile::Of(const History::Sample& newest) {
  const motion::SpaceTimeBound& bound = newest.bound;
  const motion::MotionState& state = bound.state;
  const motion::MotionLimits& limits = bound.limits;
  const bool shaped = newest.has_shape();
  const bool turning = limits.angular_acceleration_max != 0 || !state.w_WB.isZero();
  unsigned features = 0;
  const auto set = [&](Feature feature, bool needed) { features |= needed ? 1u << feature : 0; };
  set(kAccelerating, limits.acceleration_max > 0);
  set(kKnowing, HasKnownAcceleration(state));
  set(kJerking, limits.jerk_max > 0);
  set(kCapped, limits.speed_max < numeric::kInfinity);
  set(kDirected, !state.direction.isZero());
  set(kStepping, limits.time_step > 0);
  set(kUncertain, state.position_error > 0 || state.velocity_error > 0);
  set(kSkewed, bound.skew > 0);
  set(kExpiring, !state.expiry.is_never());
  set(kMasked, KeepsApart(newest.filter));
  set(kShaped, shaped);
  set(kTurning, shaped && turning);
  set(kMoving, !NeverMoves(bound));
  return static_cast<Features>(features);
}

void SceneProfile::Count(Features features, int change) {
  for (int feature = 0; feature < kFeatures; ++feature) {
    if ((features >> feature & 1) != 0) counts_[feature] += change;
  }
}

std::vector<std::string> SceneProfile::LeftOut() const {
  std::vector<std::string> left_out;
  const auto leave_out = [&](bool unused, const char* what) {
    if (unused) left_out.emplace_back(what);
  };
  leave_out(counts_[kAccelerating] == 0, "parabolic growth: no agent declares an acceleration");
  leave_out(counts_[kKnowing] == 0, "curved centres: no agent knows its acceleration");
  leave_out(counts_[kJerking] == 0, "cubic growth: no agent declares a jerk");
  leave_out(counts_[kCapped] == 0, "speed caps: no agent declares one");
  leave_out(counts_[kDirected] == 0, "directional boxes: no agent declares a thrust direction");
  leave_out(counts_[kStepping] == 0, "integrator step in the bound: no agent declares a time step");
  leave_out(counts_[kUncertain] == 0, "growth by state errors: every state is exact");
  leave_out(counts_[kSkewed] == 0, "clock skew: all clocks are one");
  leave_out(counts_[kExpiring] == 0, "expiry: no agent declares one");
  leave_out(counts_[kMasked] == 0, "masks, assemblies: every agent can meet every other");
  leave_out(counts_[kShaped] == 0, "sphere trees and rotation: every agent is a ball");
  leave_out(counts_[kShaped] > 0 && counts_[kTurning] == 0,
            "rotation of sphere trees: no agent with a shape turns");
  leave_out(counts_[kMoving] == 0, "intersections: no agent can move");
  return left_out;
}

}  // namespace collision::detection
