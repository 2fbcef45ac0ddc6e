// Plays trajectories into a world.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/motion_log.h"
#include "client/programs/simulators/player/trajectory.h"

namespace collision::client {

struct PlayerOptions {
  double radius_m = 0;
  double acceleration_max_m_s2 = -1;  ///< < 0: derived from each trajectory.
  double position_error_m = 0;
  double rate_hz = 0;  ///< States at this rate; 0: at the rows' times.
  /// Of every agent, which never turns: its axes are the world's. Null: a ball.
  std::shared_ptr<const Shape> shape = nullptr;
};

/// One agent to play.
struct PlayedAgent {
  std::string name;
  Trajectory trajectory;
};

/// Throws CsvError, "file:line: cause", if the client library would refuse a state at a row, or the
/// agent's declaration.
void RequirePlayable(const PlayedAgent& agent, const PlayerOptions& options,
                     const std::string& file);

/// Stamps of the states of a trajectory, increasing: at its rows, or at its ends and at whole
/// multiples of 1/rate since `start_ns` between them.
std::vector<std::int64_t> StateInstants(const Trajectory& trajectory, double rate_hz,
                                        std::int64_t start_ns);

/// Plays the agents: each appears with its first row and leaves after its last. Ends at
/// pace.end_ns(), or when asked to stop.
void Play(const std::vector<PlayedAgent>& agents, const PlayerOptions& options, Pace* pace,
          MotionLog* log);

}  // namespace collision::client
