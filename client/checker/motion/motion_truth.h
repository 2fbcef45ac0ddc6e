// The true motion of the agents of a run, read from the simulators' motion logs.
//
// The checker shares no code with the service or the simulators, so it does not share their
// mistakes.
#pragma once

#include <array>
#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/checker/shape/bodies.h"

namespace collision::checker {

/// How an agent turns during a piece.
struct Turn {
  std::array<double, 4> q{1, 0, 0, 0};  ///< w x y z, body to world, at the piece's begin; unit.
  std::array<double, 3> w{};            ///< Angular velocity then, in the world's axes [rad/s].
  std::array<double, 3> b{};            ///< Its constant change [rad/s²].
};

/// A cubic per axis over [t0_ns, t1_ns], in seconds since t0_ns, the constant first.
struct Piece {
  std::int64_t t0_ns = 0;
  std::int64_t t1_ns = 0;
  std::array<std::array<double, 4>, 3> p_WA{};
  std::optional<Turn> turn = std::nullopt;  ///< None: the body's axes are the world's.
};

/// One agent's whole motion.
struct AgentMotion {
  std::string simulator;
  std::string agent;
  double radius_m = 0;
  std::vector<Piece> pieces;                   ///< In order of time.
  std::vector<std::int64_t> jumps_ns;          ///< Published discontinuities, in order.
  std::shared_ptr<const Mesh> mesh = nullptr;  ///< Null: no triangles.
  std::shared_ptr<const std::vector<Solid>> solids = nullptr;  ///< Null: none. Neither: a ball.
  std::string assembly = {};                                   ///< Empty: of none.
  double margin_m = 0;          ///< Whatever comes this near counts as touching it.
  std::string class_name = {};  ///< Empty: it can meet agents of all classes.

  std::optional<HalfSpace> half_space = std::nullopt;  ///< In place of a ball.

  /// Grown by the margin. Refers to this motion.
  Body body() const {
    return {mesh.get(), radius_m, solids.get(), margin_m, half_space ? &*half_space : nullptr};
  }

  /// Whether the two are of one assembly of one simulator, so that they never meet.
  bool IsOfOneAssemblyWith(const AgentMotion& other) const {
    return !assembly.empty() && assembly == other.assembly && simulator == other.simulator;
  }

  std::int64_t begin_ns() const { return pieces.front().t0_ns; }
  std::int64_t end_ns() const { return pieces.back().t1_ns; }
};

/// Larger logs are refused: most likely a mistake.
inline constexpr std::size_t kMeshItemsMax = 20'000'000;  ///< Vertices, and triangles, of a mesh.
inline constexpr std::size_t kSolidsMax = 65536;          ///< Of one shape.
inline constexpr double kRotationAngleMax = 1000;         ///< Within one piece [rad].

/// Reads one motion log of format 1 to 5 (client/checker/README.md). Agents without pieces are left
/// out. Throws std::runtime_error, "simulator:line: cause", if it is malformed.
std::vector<AgentMotion> ReadMotionLog(std::istream& text, const std::string& simulator);

}  // namespace collision::checker
