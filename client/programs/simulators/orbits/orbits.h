// Satellites that tell the acceleration of gravity at their place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/orbits/constellation.h"
#include "client/programs/simulators/orbits/orbit.h"

namespace collision::client {

struct OrbitsOptions {
  ConstellationOptions constellation;
  std::size_t satellites = 100;
  std::size_t first = 0;           ///< Number of the first: slices of one constellation.
  double radius_m = 1000;          ///< Of the keep-out ball.
  double rate_hz = 1;              ///< States a second.
  bool tells_acceleration = true;  ///< False: a state tells none, and M is declared.
};

/// "satellite-17".
std::string SatelliteName(std::size_t number);

/// What a satellite declares.
AgentDescription SatelliteDescription(const OrbitsOptions& options, std::size_t number,
                                      const Orbit& orbit);

/// Its state; `stamp_ns` within the orbit.
State SatelliteState(const OrbitsOptions& options, const Orbit& orbit, std::int64_t stamp_ns);

/// Moves the satellites of one process. They answer nothing.
class Orbits {
 public:
  /// `pace` and `log` must outlive it. Computes all orbits up to pace.end_ns().
  Orbits(const OrbitsOptions& options, Pace* pace, MotionLog* log);

  /// Prints least and greatest of what the satellites declare.
  void PrintBounds() const;

  /// Moves to pace.end_ns(), or until asked to stop; then lingers.
  void Fly();

 private:
  struct Member {
    std::size_t number;
    Orbit orbit;
    std::optional<Agent> agent = {};
    std::size_t logged = 0;  ///< Pieces of the orbit.
  };

  void Add(Member* member);
  void Log(std::int64_t flown_ns);
  void Finish(std::int64_t flown_ns);

  OrbitsOptions options_;
  Pace* pace_;
  MotionLog* log_;
  std::vector<Member> members_;
};

}  // namespace collision::client
