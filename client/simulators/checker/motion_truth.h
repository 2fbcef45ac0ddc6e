// What the agents of a run really did, read from the simulators' motion logs.
//
// The checker shares no code with the service nor with the simulators: a mistake of theirs must not
// be its own.
#pragma once

#include <array>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace collision::checker {

/// A cubic per axis over [t0_ns, t1_ns], in seconds since t0_ns, the constant first.
struct Piece {
  std::int64_t t0_ns = 0;
  std::int64_t t1_ns = 0;
  std::array<std::array<double, 4>, 3> p_WA{};
};

/// One agent's whole motion.
struct AgentMotion {
  std::string simulator;
  std::string agent;
  double radius_m = 0;
  std::vector<Piece> pieces;           ///< In order of time.
  std::vector<std::int64_t> jumps_ns;  ///< Published discontinuities, in order.

  std::int64_t begin_ns() const { return pieces.front().t0_ns; }
  std::int64_t end_ns() const { return pieces.back().t1_ns; }
};

/// Reads one motion log (../README.md). Agents without pieces are left out. Throws
/// std::runtime_error with "simulator:line: what" if it is malformed.
std::vector<AgentMotion> ReadMotionLog(std::istream& text, const std::string& simulator);

}  // namespace collision::checker
