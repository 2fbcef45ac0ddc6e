#include "client/programs/simulators/player/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace collision::client {
namespace {

// The second derivative is computed from differences of doubles with a handful of roundings;
// rounding it up by this much more than covers them.
constexpr double kRelativeMargin = 1e-9;

// Half an ulp in each coordinate of a state looks like an acceleration of ulp / h² over a piece of
// length h. Three axes, two states and the evaluation between them stay below 16 roundings.
constexpr double kRoundings = 16;

double Seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

double Norm(const Vector3& v) { return std::hypot(v[0], v[1], v[2]); }

void DifferenceVelocities(std::vector<CsvRow>* rows) {
  const std::size_t n = rows->size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool begins = i == 0 || (*rows)[i].jump;
    const bool ends = i + 1 == n || (*rows)[i + 1].jump;
    if (begins && ends) continue;  // Alone between two jumps: at rest.
    const CsvRow& before = (*rows)[begins ? i : i - 1];
    const CsvRow& after = (*rows)[ends ? i : i + 1];
    const double duration = Seconds(before.time_ns, after.time_ns);
    for (int axis = 0; axis < 3; ++axis) {
      (*rows)[i].velocity_m_s[axis] = (after.position_m[axis] - before.position_m[axis]) / duration;
    }
  }
}

MotionPiece Hermite(const CsvRow& from, const CsvRow& to) {
  MotionPiece piece{from.time_ns, to.time_ns, {}};
  const double h = Seconds(from.time_ns, to.time_ns);
  for (int axis = 0; axis < 3; ++axis) {
    if (to.jump) {
      piece.coefficients[axis] = {from.position_m[axis], from.velocity_m_s[axis], 0, 0};
      continue;
    }
    const double slope = (to.position_m[axis] - from.position_m[axis]) / h;
    const double v0 = from.velocity_m_s[axis], v1 = to.velocity_m_s[axis];
    piece.coefficients[axis] = {from.position_m[axis], v0, (3 * slope - 2 * v0 - v1) / h,
                                (v0 + v1 - 2 * slope) / (h * h)};
  }
  return piece;
}

}  // namespace

Trajectory::Trajectory(std::vector<CsvRow> rows, bool velocities, std::int64_t offset_ns)
    : rows_(std::move(rows)) {
  for (CsvRow& row : rows_) row.time_ns += offset_ns;
  rows_.front().jump = false;
  if (!velocities) DifferenceVelocities(&rows_);
  for (std::size_t i = 1; i < rows_.size(); ++i) pieces_.push_back(Hermite(rows_[i - 1], rows_[i]));
}

std::vector<CsvRow>::const_iterator Trajectory::RowFrom(std::int64_t stamp_ns) const {
  return std::lower_bound(rows_.begin(), rows_.end(), stamp_ns,
                          [](const CsvRow& r, std::int64_t t) { return r.time_ns < t; });
}

bool Trajectory::JumpsAt(std::int64_t stamp_ns) const {
  const auto row = RowFrom(stamp_ns);
  return row != rows_.end() && row->time_ns == stamp_ns && row->jump;
}

PositionAndVelocity Trajectory::At(std::int64_t stamp_ns) const {
  const auto row = RowFrom(stamp_ns);
  if (row->time_ns == stamp_ns) return {row->position_m, row->velocity_m_s};
  return Evaluate(pieces_[row - rows_.begin() - 1], stamp_ns);
}

PieceAcceleration Trajectory::AccelerationOn(std::size_t i) const {
  constexpr double kUlp = std::numeric_limits<double>::epsilon();
  const auto& c = pieces_[i].coefficients;
  const double h = Seconds(pieces_[i].t0_ns, pieces_[i].t1_ns);
  PieceAcceleration acceleration;
  for (int axis = 0; axis < 3; ++axis) {
    acceleration.first_m_s2[axis] = 2 * c[axis][2];
    acceleration.last_m_s2[axis] = 2 * c[axis][2] + 6 * c[axis][3] * h;
  }
  const double length = std::max(Norm(rows_[i].position_m), Norm(rows_[i + 1].position_m));
  const double speed = std::max(Norm(rows_[i].velocity_m_s), Norm(rows_[i + 1].velocity_m_s));
  acceleration.rounding_m_s2 = kRoundings * kUlp * (length / (h * h) + speed / h);
  return acceleration;
}

double Trajectory::AccelerationMax() const {
  double greatest = 0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const PieceAcceleration on = AccelerationOn(i);
    const double most = std::max(Norm(on.first_m_s2), Norm(on.last_m_s2));
    greatest = std::max(greatest, most * (1 + kRelativeMargin) + on.rounding_m_s2);
  }
  return greatest;
}

}  // namespace collision::client
