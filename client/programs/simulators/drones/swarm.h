// A swarm of drones that bounce when the service reports a contact.
#pragma once

#include <deque>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/drone.h"
#include "client/programs/simulators/motion/motion_log.h"

namespace collision::client {

struct SwarmOptions {
  DroneLimits limits;
  std::size_t drones = 50;
  std::size_t first = 0;  ///< Number of the first: slices of one swarm in several processes.
  std::uint64_t seed = 1;
  double rate_hz = 60;          ///< Steps of the motion.
  std::size_t state_every = 1;  ///< Steps between two states of a drone.
  bool declares_speed = false;  ///< Declare the greatest speed: tighter bounds, costlier queries.
  std::size_t force_every = 1;  ///< Steps for which a drone holds a force; at most 0.1 s in all.
};

/// Longest time for which a drone may hold a force [s], as Drone::Step() requires.
inline constexpr double kForceHeldMax = 0.1;

/// Flies the drones of one process. A confirmed event turns its drones back once, at their next
/// step, with a state marked as a discontinuity.
class Swarm {
 public:
  /// `pace` and `log` must outlive the swarm. Throws std::runtime_error if the drones do not fit
  /// into the box.
  Swarm(const SwarmOptions& options, Pace* pace, MotionLog* log);

  /// Flies to pace.end_ns(), or until asked to stop; then lingers.
  void Fly();

  std::size_t bounces() const { return bounces_; }

 private:
  struct Member {
    Member(std::string its_name, const Drone& its_drone)
        : name(std::move(its_name)), drone(its_drone) {}

    std::string name;
    Drone drone;
    MotionPiece piece{};  // under one force; its end may lie ahead, where `drone` is already
    std::optional<Agent> agent;
    std::deque<std::pair<Vector3, int>>
        bounces;  // normals, and on which side of them this drone is
  };

  void Handle(const Event& event);
  void Add(Member* member);
  void Stage(Member* member, std::int64_t stamp_ns, bool bounced);
  std::int64_t HeldUntil(std::size_t member) const;
  bool Bounce(Member* member, std::int64_t stamp_ns);
  void StepTo(std::int64_t t0_ns, std::int64_t t1_ns, bool states);

  SwarmOptions options_;
  Pace* pace_;
  MotionLog* log_;
  std::vector<Member> members_;
  std::unordered_map<std::uint32_t, std::size_t> by_slot_;
  std::set<std::tuple<AgentId, AgentId, std::uint32_t>> answered_;  // contacts already answered
  std::size_t bounces_ = 0;
  std::size_t step_ = 0;  // from 1, as Pace::Fly() counts
};

}  // namespace collision::client
