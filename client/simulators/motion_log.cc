#include "client/simulators/motion_log.h"

#include <charconv>
#include <stdexcept>

#include "client/shape.h"

namespace collision::client {
namespace {

// The fewest digits that name a double: a swarm writes millions.
void Write(double number, std::ofstream* file) {
  char text[32] = " ";
  const auto end = std::to_chars(text + 1, text + sizeof text, number).ptr;
  file->write(text, end - text);
}

}  // namespace

PositionAndVelocity Evaluate(const MotionPiece& piece, std::int64_t stamp_ns) {
  const double t = static_cast<double>(stamp_ns - piece.t0_ns) * 1e-9;
  PositionAndVelocity result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& c = piece.coefficients[axis];
    result.position_m[axis] = c[0] + t * (c[1] + t * (c[2] + t * c[3]));
    result.velocity_m_s[axis] = c[1] + t * (2 * c[2] + t * 3 * c[3]);
  }
  return result;
}

MotionLog::MotionLog(const std::string& path) : path_(path) {
  if (path_.empty()) return;
  file_.open(path_);
  if (!file_) throw std::runtime_error(path_ + ": cannot be created");
  file_ << "motion-log 2\n";
}

std::string MotionLog::MeshName(const Shape& shape) {
  const auto [mesh, is_new] =
      meshes_.try_emplace(shape.hash(), "mesh-" + std::to_string(meshes_.size() + 1));
  if (!is_new) return mesh->second;
  const Triangles& triangles = shape.triangles();
  file_ << "mesh " << mesh->second << ' ' << triangles.vertices_m.size() << ' '
        << triangles.indices.size();
  for (const Vector3& vertex : triangles.vertices_m) {
    for (const double x : vertex) Write(x, &file_);
  }
  for (const auto& triangle : triangles.indices) {
    for (const std::uint32_t index : triangle) file_ << ' ' << index;
  }
  file_ << '\n';
  return mesh->second;
}

void MotionLog::Agent(const std::string& name, double radius_m,
                      const std::shared_ptr<const Shape>& shape) {
  if (path_.empty()) return;
  const std::string mesh = shape ? " " + MeshName(*shape) : "";
  file_ << "agent " << name;
  Write(radius_m, &file_);
  file_ << mesh << '\n';
}

void MotionLog::Piece(const std::string& name, const MotionPiece& piece) {
  if (path_.empty()) return;
  file_ << "piece " << name << ' ' << piece.t0_ns << ' ' << piece.t1_ns;
  for (const auto& axis : piece.coefficients) {
    for (const double c : axis) Write(c, &file_);
  }
  file_ << '\n';
}

void MotionLog::Turn(const std::string& name, const TurnPiece& turn) {
  if (path_.empty()) return;
  file_ << "turn " << name << ' ' << turn.t0_ns << ' ' << turn.t1_ns;
  for (const double c : turn.orientation) Write(c, &file_);
  for (const double c : turn.angular_velocity_rad_s) Write(c, &file_);
  for (const double c : turn.angular_acceleration_rad_s2) Write(c, &file_);
  file_ << '\n';
}

void MotionLog::Jump(const std::string& name, std::int64_t stamp_ns) {
  if (!path_.empty()) file_ << "jump " << name << ' ' << stamp_ns << '\n';
}

void MotionLog::Close() {
  if (path_.empty()) return;
  file_.close();
  if (!file_) throw std::runtime_error(path_ + ": could not be written");
}

}  // namespace collision::client
