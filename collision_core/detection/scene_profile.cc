#include "collision_core/detection/scene_profile.h"

namespace collision {

void SceneProfile::Count(const AgentRecord& agent) {
  const SpaceTimeBound& bound = agent.bound();
  ++agents_;
  accelerating_ += bound.declaration.acceleration_max > 0;
  directed_ += !bound.state.direction.isZero();
  stepping_ += bound.declaration.time_step > 0;
  uncertain_ += bound.state.position_error > 0 || bound.state.velocity_error > 0;
  expiring_ += !bound.state.expiry.is_never();
  masked_ += bound.declaration.group != 1 || bound.declaration.mask != ~0u;
  skewed_ |= bound.skew > 0;
  const bool shaped = bound.declaration.shape || bound.declaration.shape_awaited;
  shaped_ += shaped;
  turning_ +=
      shaped && (bound.declaration.angular_acceleration_max != 0 || !bound.state.w_WB.isZero());
}

Detector::Profile SceneProfile::Describe() const {
  Detector::Profile profile;
  profile.broad_phase = "all pairs";
  profile.why =
      std::to_string(agents_) + " agents: asking every partner is the method for up to about 1000";
  const auto leave_out = [&](bool unused, const char* what) {
    if (unused) profile.left_out.emplace_back(what);
  };
  leave_out(accelerating_ == 0, "parabolic growth: no agent declares an acceleration");
  leave_out(directed_ == 0, "directional boxes: no agent declares a thrust direction");
  leave_out(stepping_ == 0, "integrator step in the bound: no agent declares a time step");
  leave_out(uncertain_ == 0, "growth by state errors: every state is exact");
  leave_out(!skewed_, "clock skew: all clocks are one");
  leave_out(expiring_ == 0, "expiry: no agent declares one");
  leave_out(masked_ == 0, "masks: everybody can meet everybody");
  leave_out(shaped_ == 0, "sphere trees and rotation: every agent is a ball");
  leave_out(shaped_ > 0 && turning_ == 0, "rotation of sphere trees: no agent with a shape turns");
  return profile;
}

}  // namespace collision
