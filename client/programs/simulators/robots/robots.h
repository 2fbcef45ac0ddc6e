// Robots of several links, each an assembly: the links of one never meet each other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/ship_agent.h"
#include "client/programs/simulators/robots/robot.h"

namespace collision::client {

struct RobotOptions {
  RobotLimits limits;
  std::size_t robots = 100;
  std::size_t first = 0;  ///< Number of the first: slices of one crowd in several processes.
  std::uint64_t seed = 1;
  std::string class_name = {};  ///< Of all links.
  double rate_hz = 20;          ///< Steps of the motion; at least 20.
  std::size_t state_every = 1;  ///< Steps between two states of a link.
};

/// Where the robots begin, no two within reach of each other; for every slice the same. Throws
/// std::runtime_error if the box is too small.
std::vector<Vector3> RobotPositions(const RobotOptions& options);

/// Robot `number` of the crowd.
Robot RobotOf(const RobotOptions& options, std::size_t number, const Vector3& position_m);

/// "robot-3", the assembly, of which the links are "robot-3/0", "robot-3/1", ...
std::string RobotName(std::size_t number);

/// What a link declares.
AgentDescription LinkDescription(const RobotOptions& options, std::size_t number, std::size_t link,
                                 const std::shared_ptr<const Shape>& shape);

/// Moves the robots of one process. They do not answer contacts: they pass through each other.
class Robots {
 public:
  /// `pace` and `log` must outlive it. Throws like RobotPositions().
  Robots(const RobotOptions& options, Pace* pace, MotionLog* log);

  /// Moves to pace.end_ns(), or until asked to stop; then lingers.
  void Move();

 private:
  struct Member {
    Robot robot;
    std::vector<ShipAgent> links;
  };

  void StepTo(const PaceStep& step);
  void SetStates(std::int64_t stamp_ns);

  RobotOptions options_;
  Pace* pace_;
  std::vector<Member> members_;
};

}  // namespace collision::client
