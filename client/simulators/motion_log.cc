#include "client/simulators/motion_log.h"

#include <cstdio>
#include <stdexcept>

namespace collision::client {

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
  file_ << "motion-log 1\n";
}

void MotionLog::Agent(const std::string& name, double radius_m) {
  if (path_.empty()) return;
  char number[32];
  std::snprintf(number, sizeof number, "%.17g", radius_m);
  file_ << "agent " << name << ' ' << number << '\n';
}

void MotionLog::Piece(const std::string& name, const MotionPiece& piece) {
  if (path_.empty()) return;
  file_ << "piece " << name << ' ' << piece.t0_ns << ' ' << piece.t1_ns;
  for (const auto& axis : piece.coefficients) {
    for (const double c : axis) {
      char number[32];
      std::snprintf(number, sizeof number, " %.17g", c);
      file_ << number;
    }
  }
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
