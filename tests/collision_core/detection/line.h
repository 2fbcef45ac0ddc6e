// A detector with few agents on lines: what the tests of the detector share.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "collision_core/detection/detector.h"

namespace collision {

using Eigen::Vector3d;

inline Instant At(double seconds) {
  return Instant::FromNanoseconds(static_cast<std::int64_t>(seconds * 1e9));
}

// Each agent has a simulator of its own: time heard of one holds for no other.
inline detection::AgentId Id(std::uint32_t slot) { return {1 + std::uint64_t{slot}, slot, 1, 1}; }

inline motion::MotionState State(double t, const Vector3d& p, const Vector3d& v) {
  motion::MotionState state;
  state.stamp = At(t);
  state.p_WA = p;
  state.v_WA = v;
  return state;
}

// Agents that move on lines under a declared bound of 1 m/s², in a detector that receives states 16
// times a second.
class Line {
 public:
  explicit Line(detection::DetectorOptions options = {}) : detector(options) {}

  void Add(std::uint32_t slot, const Vector3d& p, const Vector3d& v, double radius = 1) {
    detector.Admit(Id(slot), {.limits = {radius, 1}}, State(now, p, v), At(now));
    agents.push_back({slot, p, v, now});
  }

  void RunTo(double end) {
    while (now < end) {
      now += 1.0 / 16;
      for (const Mover& agent : agents) {
        const double dt = now - agent.since;
        detector.Update(Id(agent.slot), State(now, agent.p + agent.v * dt, agent.v), At(now));
        detector.SetHeardUntil(OwnerOf(Id(agent.slot)), At(now));
      }
      Step();
    }
  }

  void Step() {
    detector.Advance(At(now));
    detector.Validate();
    events.insert(events.end(), detector.events().begin(), detector.events().end());
  }

  std::vector<detection::CollisionEvent> With(detection::EventStatus status) const {
    std::vector<detection::CollisionEvent> found;
    std::copy_if(events.begin(), events.end(), std::back_inserter(found),
                 [&](const detection::CollisionEvent& event) { return event.status == status; });
    return found;
  }

  struct Mover {
    std::uint32_t slot;
    Vector3d p, v;
    double since;
  };
  detection::Detector detector;
  std::vector<Mover> agents;
  std::vector<detection::CollisionEvent> events;
  double now = 0;
};

}  // namespace collision
