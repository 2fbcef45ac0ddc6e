// A swarm of drones in a world, bounced by the collisions that the service reports.
#pragma once

#include <deque>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "client/simulators/drone.h"
#include "client/simulators/motion_log.h"
#include "client/simulators/pace.h"

namespace collision::client {

struct SwarmOptions {
  DroneLimits limits;
  std::size_t drones = 50;
  std::size_t first = 0;  ///< Number of the first: slices of one swarm in several processes.
  std::uint64_t seed = 1;
  double rate_hz = 60;          ///< Steps of the motion.
  std::size_t state_every = 1;  ///< Steps between two states of a drone.
};

/// Flies the drones of one process. A confirmed event of one of them turns it back once, at its
/// next step, with a state marked as a discontinuity.
class Swarm {
 public:
  /// Everything outlives the swarm. Throws std::runtime_error if the drones do not fit into the
  /// box.
  Swarm(const SwarmOptions& options, Pace* pace, MotionLog* log);

  /// To pace.end_ns(), or until asked to stop; then lingers.
  void Fly();

  std::size_t bounces() const { return bounces_; }

 private:
  struct Member {
    std::string name;
    Drone drone;
    std::optional<Agent> agent;
    std::deque<std::pair<Vector3, int>>
        bounces;  // normals, and on which side of them this drone is
  };

  void Hear(const Event& event);
  void Stage(Member* member, std::int64_t stamp_ns, bool discontinuity);
  void StepTo(std::int64_t t0_ns, std::int64_t t1_ns, bool states);

  SwarmOptions options_;
  Pace* pace_;
  MotionLog* log_;
  std::vector<Member> members_;
  std::set<std::tuple<AgentId, AgentId, std::uint32_t>> heard_;  // contacts already answered
  std::size_t bounces_ = 0;
};

}  // namespace collision::client
