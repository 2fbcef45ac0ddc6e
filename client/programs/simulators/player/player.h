// Plays trajectories into a world.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/motion_log.h"
#include "client/programs/simulators/player/known_acceleration.h"
#include "client/programs/simulators/player/trajectory.h"

namespace collision::client {

/// Whether states tell the acceleration that their curve has: always, never, or where this makes
/// the bound smaller.
enum class KnownUse { kAuto, kTold, kUntold };

struct PlayerOptions {
  double radius_m = 0;
  double margin_m = 0;                ///< Of every agent but half-spaces.
  double acceleration_max_m_s2 = -1;  ///< >= 0: no state tells its acceleration; < 0: derived.
  KnownUse known_acceleration = KnownUse::kAuto;
  double look_ahead_s = 2;  ///< After so long the bounds of both ways are compared.
  double position_error_m = 0;
  double rate_hz = 0;  ///< States at this rate; 0: at the rows' times.
  /// Of every agent, which never turns: its axes are the world's. Null: a ball.
  std::shared_ptr<const Shape> shape = nullptr;
  /// Floors and walls, which are there from the start on.
  std::vector<HalfSpace> half_spaces = {};
  bool hypothetical = false;  ///< All agents are plans to be screened.
};

/// One agent to play.
struct PlayedAgent {
  std::string name;
  Trajectory trajectory;
  std::optional<KnownAcceleration> known = {};  ///< What its states tell; nullopt: nothing.
};

/// What the states of this trajectory tell. Where the options leave it open: what is known, if it
/// makes the bound smaller after `look_ahead_s` than the greatest acceleration alone does.
std::optional<KnownAcceleration> KnownOf(const Trajectory& trajectory,
                                         const PlayerOptions& options);

/// Throws CsvError, "file:line: cause", if the client library would refuse a state at a row, or the
/// agent's declaration.
void RequirePlayable(const PlayedAgent& agent, const PlayerOptions& options,
                     const std::string& file);

/// Throws BadInput if two agents, or an agent and a half-space, would have one name: nobody could
/// tell their events apart.
void RequireNamesOfTheirOwn(const std::vector<PlayedAgent>& agents, const PlayerOptions& options);

/// A run's start without any row that is longer than this is told [ns].
inline constexpr std::int64_t kQuietStartMax = 60'000'000'000;

/// A sentence about file times that begin long after the run does, as those since 1970 do, and what
/// to do; empty: the first row is due within kQuietStartMax. `agents` are played from 0 on, which
/// is `begin_ns` of the file's time.
std::string LateStartText(const std::vector<PlayedAgent>& agents, std::int64_t begin_ns);

/// Stamps of the states of a trajectory, increasing: at its rows, or at its ends and at whole
/// multiples of 1/rate since `start_ns` and its jumps between them.
std::vector<std::int64_t> StateInstants(const Trajectory& trajectory, double rate_hz,
                                        std::int64_t start_ns);

/// Plays the agents: each appears with its first row and leaves after its last. Ends at
/// pace.end_ns(), or when asked to stop.
void Play(const std::vector<PlayedAgent>& agents, const PlayerOptions& options, Pace* pace,
          MotionLog* log);

}  // namespace collision::client
