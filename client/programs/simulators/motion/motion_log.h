// The exact motion of a simulator's agents, written to a file for the checker.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <string>

#include "collision/shape.h"

namespace collision::client {

/// A cubic per axis over [t0_ns, t1_ns], in seconds since t0_ns, the constant first. This is the
/// motion by definition, so it is exact.
struct MotionPiece {
  std::int64_t t0_ns = 0;
  std::int64_t t1_ns = 0;
  std::array<std::array<double, 4>, 3> coefficients{};
};

struct PositionAndVelocity {
  Vector3 position_m{};
  Vector3 velocity_m_s{};
};

/// Where the piece is at `stamp_ns`.
PositionAndVelocity Evaluate(const MotionPiece& piece, std::int64_t stamp_ns);

/// The rotation over [t0_ns, t1_ns]: the solution of q' = ½ ω q from `orientation` with
/// ω(t) = angular_velocity + angular_acceleration (t − t0), both in W. Exact by definition.
struct TurnPiece {
  std::int64_t t0_ns = 0;
  std::int64_t t1_ns = 0;
  Quaternion orientation{1, 0, 0, 0};
  Vector3 angular_velocity_rad_s{};
  Vector3 angular_acceleration_rad_s2{};
};

/// A text file, one record per line (client/checker/README.md). Without a path nothing is written.
class MotionLog {
 public:
  /// Throws std::runtime_error if the file cannot be created.
  explicit MotionLog(const std::string& path);

  /// Without a shape the agent is a ball. A shape is written before its first agent.
  void Agent(const std::string& name, double radius_m,
             const std::shared_ptr<const Shape>& shape = nullptr);

  /// The agent's body is this.
  void Agent(const std::string& name, const HalfSpace& half_space);

  /// The agent never meets others of this assembly; empty: it is of none.
  void Assembly(const std::string& name, const std::string& assembly);

  /// The agent is of this class of the configuration; empty: of none.
  void Class(const std::string& name, const std::string& class_name);

  /// Whatever is this near to the agent counts as touching it.
  void Margin(const std::string& name, double margin_m);

  /// Pieces of one agent follow each other in time.
  void Piece(const std::string& name, const MotionPiece& piece);

  /// Over the same interval as the agent's last piece. An agent that never turns needs none; its
  /// axes are the world's.
  void Turn(const std::string& name, const TurnPiece& turn);

  /// A state with `discontinuity` was published for this instant.
  void Jump(const std::string& name, std::int64_t stamp_ns);

  /// Throws std::runtime_error if something could not be written.
  void Close();

 private:
  std::string ShapeName(const Shape& shape);
  void WriteMesh(const std::string& name, const Triangles& triangles);
  void WriteSolid(const std::string& name, const Solid& solid);

  std::string path_;
  std::ofstream file_;
  std::map<std::string, std::string> shapes_;  // name, by content hash
};

}  // namespace collision::client
