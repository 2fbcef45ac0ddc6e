#include "client/programs/simulators/motion/motion_log.h"

#include <charconv>
#include <stdexcept>

namespace collision::client {
namespace {

// With the fewest digits that identify a double: a swarm writes millions of numbers.
void Write(double number, std::ofstream* file) {
  char text[32] = " ";
  const auto end = std::to_chars(text + 1, text + sizeof text, number).ptr;
  file->write(text, end - text);
}

template <std::size_t kNumbers>
void Write(const std::array<double, kNumbers>& numbers, std::ofstream* file) {
  for (const double number : numbers) Write(number, file);
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
  file_ << "motion-log 5\n";
}

std::string MotionLog::ShapeName(const Shape& shape) {
  const auto [found, is_new] =
      shapes_.try_emplace(shape.hash(), "shape-" + std::to_string(shapes_.size() + 1));
  const std::string& name = found->second;
  if (!is_new) return name;
  if (!shape.triangles().indices.empty()) WriteMesh(name, shape.triangles());
  for (const Solid& solid : shape.solids()) WriteSolid(name, solid);
  return name;
}

void MotionLog::WriteMesh(const std::string& name, const Triangles& triangles) {
  file_ << "mesh " << name << ' ' << triangles.vertices_m.size() << ' ' << triangles.indices.size();
  for (const Vector3& vertex : triangles.vertices_m) Write(vertex, &file_);
  for (const auto& triangle : triangles.indices) {
    for (const std::uint32_t index : triangle) file_ << ' ' << index;
  }
  file_ << '\n';
}

void MotionLog::WriteSolid(const std::string& name, const Solid& solid) {
  file_ << "solid " << name << ' ' << Name(solid.kind);
  Write(solid.rounding_m, &file_);
  Write(solid.position_m, &file_);
  Write(solid.orientation, &file_);
  if (solid.kind == Solid::Kind::kCapsule) Write(solid.half_extents_m[2], &file_);
  const bool has_axes = solid.kind == Solid::Kind::kBox || solid.kind == Solid::Kind::kEllipsoid;
  if (has_axes) Write(solid.half_extents_m, &file_);
  if (solid.kind == Solid::Kind::kCylinder || solid.kind == Solid::Kind::kCone)
    Write(std::array{solid.half_extents_m[0], solid.half_extents_m[2]}, &file_);
  if (solid.kind == Solid::Kind::kHull) file_ << ' ' << solid.points_m.size();
  for (const Vector3& point : solid.points_m) Write(point, &file_);
  file_ << '\n';
}

void MotionLog::Agent(const std::string& name, double radius_m,
                      const std::shared_ptr<const Shape>& shape) {
  if (path_.empty()) return;
  const std::string suffix = shape ? " " + ShapeName(*shape) : "";
  file_ << "agent " << name;
  Write(radius_m, &file_);
  file_ << suffix << '\n';
}

void MotionLog::Agent(const std::string& name, const HalfSpace& half_space) {
  if (path_.empty()) return;
  file_ << "half-space " << name;
  Write(half_space.normal, &file_);
  Write(half_space.offset_m, &file_);
  file_ << '\n';
}

void MotionLog::Assembly(const std::string& name, const std::string& assembly) {
  if (path_.empty() || assembly.empty()) return;
  file_ << "assembly " << name << ' ' << assembly << '\n';
}

void MotionLog::Class(const std::string& name, const std::string& class_name) {
  if (path_.empty() || class_name.empty()) return;
  file_ << "class " << name << ' ' << class_name << '\n';
}

void MotionLog::Margin(const std::string& name, double margin_m) {
  if (path_.empty() || margin_m == 0) return;
  file_ << "margin " << name;
  Write(margin_m, &file_);
  file_ << '\n';
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
