// The motion that a table of positions defines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "client/programs/simulators/motion/motion_log.h"
#include "client/programs/simulators/player/csv_rows.h"

namespace collision::client {

/// The acceleration on one piece of a curve, which is linear in time: at the piece's begin and at
/// its end, and what the roundings of the states at both ends may add to it.
struct PieceAcceleration {
  Vector3 first_m_s2{};
  Vector3 last_m_s2{};
  double rounding_m_s2 = 0;
};

/// The cubic Hermite curve through rows of positions and velocities: positions and velocities are
/// continuous, the acceleration is linear on each piece and largest at one of its ends. Before a
/// row with a jump the motion goes on as it is at the row before, with constant velocity, and ends
/// at the jump.
class Trajectory {
 public:
  /// At least one row, times strictly increasing. Without `velocities` they are central
  /// differences, one-sided at the ends (and zero for a single row); none reaches across a
  /// jump. The first row cannot be one. `offset_ns` is added to every
  /// time.
  Trajectory(std::vector<CsvRow> rows, bool velocities, std::int64_t offset_ns);

  std::int64_t begin_ns() const { return rows_.front().time_ns; }
  std::int64_t end_ns() const { return rows_.back().time_ns; }

  /// The rows with their velocities and times as played.
  const std::vector<CsvRow>& rows() const { return rows_; }

  /// One less than rows; piece i leads from row i to row i + 1.
  const std::vector<MotionPiece>& pieces() const { return pieces_; }

  /// Whether there is a row at `stamp_ns` that is a jump.
  bool JumpsAt(std::int64_t stamp_ns) const;

  /// On the curve; `stamp_ns` in [begin_ns, end_ns]. At a row exactly that row.
  PositionAndVelocity At(std::int64_t stamp_ns) const;

  /// On piece `i`.
  PieceAcceleration AccelerationOn(std::size_t i) const;

  /// A bound that the curve and the states taken from it keep [m/s²].
  double AccelerationMax() const;

 private:
  std::vector<CsvRow>::const_iterator RowFrom(std::int64_t stamp_ns) const;

  std::vector<CsvRow> rows_;
  std::vector<MotionPiece> pieces_;
};

}  // namespace collision::client
