#include "client/programs/simulators/motion/drone.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "client/library/vector.h"

namespace collision::client {
namespace {

// Forces stay inside M by this factor. Then rounding p and v (below 1 km and 1 km/s, half an ulp is
// 6e-14) never makes a step of 1 ms or longer break the bound: M h² 1e-6 / 2 >= 2.5e-12 for M = 5.
constexpr double kForceInside = 1 - 1e-6;

constexpr int kAttemptsPerDrone = 10000;
constexpr double kDroneReached = 10;     // a target is reached within this many metres
constexpr double kGustShare = 0.5;       // of M; the rest pulls to the target
constexpr int kThinkSteps[] = {20, 80};  // between two choices of gust and target

Vector3 PointIn(const Vector3& box, double margin_share, SeededRandom* random) {
  Vector3 point;
  for (int axis = 0; axis < 3; ++axis) {
    point[axis] = box[axis] * random->Uniform(margin_share, 1 - margin_share);
  }
  return point;
}

// The same few places for all drones of a box: a fixed seed.
Vector3 Target(const DroneLimits& limits, std::uint64_t index) {
  SeededRandom random(index % limits.places);
  return PointIn(limits.box_m, 0.3, &random);
}

}  // namespace

Drone::Drone(const DroneLimits& limits, const Vector3& position_m, std::uint64_t seed)
    : limits_(limits), random_(seed), position_m_(position_m) {}

Vector3 Drone::Force(double step) {
  const double force_max = limits_.acceleration_max_m_s2 * kForceInside;
  Vector3 away{};
  for (int axis = 0; axis < 3; ++axis) away[axis] = target_m_[axis] - position_m_[axis];
  if (steps_left_-- <= 0 || Norm(away) < kDroneReached) {
    steps_left_ = static_cast<int>(random_.Uniform(kThinkSteps[0], kThinkSteps[1]));
    gust_ = Scaled(random_.InUnitBall(), kGustShare * force_max);
    target_m_ = Target(limits_, random_.Next());
  }
  const double distance = std::max(Norm(away), kDroneReached);
  Vector3 force;
  for (int axis = 0; axis < 3; ++axis) {
    force[axis] = gust_[axis] + away[axis] / distance * force_max * (1 - kGustShare);
    // A wall nearer than 2.5 times the way to brake (on three axes at once it takes √3 of it) and
    // what the step itself may add: brake.
    const double v = velocity_m_s_[axis];
    const double room = v > 0 ? limits_.box_m[axis] - position_m_[axis] : position_m_[axis];
    const double margin = 2 * step * (std::fabs(v) + force_max * step);
    if (1.25 * v * v / force_max + margin > room) force[axis] = v > 0 ? -force_max : force_max;
  }
  const double size = Norm(force);
  if (size > force_max) force = Scaled(force, force_max / size);
  Vector3 next = velocity_m_s_;
  for (int axis = 0; axis < 3; ++axis) next[axis] += force[axis] * step;
  const double speed = Norm(velocity_m_s_);
  if (Norm(next) > limits_.speed_max_m_s && speed > force_max * step) {
    force = Scaled(velocity_m_s_, -force_max / speed);
  }
  const double rounded = Norm(force);
  return rounded > force_max ? Scaled(force, force_max / rounded * kForceInside) : force;
}

MotionPiece Drone::Step(std::int64_t t0_ns, std::int64_t t1_ns) {
  const double step = static_cast<double>(t1_ns - t0_ns) * 1e-9;
  const Vector3 force = Force(step);
  MotionPiece piece{t0_ns, t1_ns, {}};
  for (int axis = 0; axis < 3; ++axis) {
    piece.coefficients[axis] = {position_m_[axis], velocity_m_s_[axis], force[axis] / 2, 0};
  }
  const PositionAndVelocity end = Evaluate(piece, t1_ns);
  position_m_ = end.position_m;
  velocity_m_s_ = end.velocity_m_s;
  return piece;
}

bool Drone::Bounce(const Vector3& normal, int side) {
  const double length = Norm(normal);
  if (!(length > 0)) return false;
  const Vector3 n = Scaled(normal, side / length);
  const double approach =
      velocity_m_s_[0] * n[0] + velocity_m_s_[1] * n[1] + velocity_m_s_[2] * n[2];
  if (approach <= 0) return false;
  for (int axis = 0; axis < 3; ++axis) velocity_m_s_[axis] -= 2 * approach * n[axis];
  return true;
}

std::vector<Vector3> StartPositions(const DroneLimits& limits, std::size_t count,
                                    std::uint64_t seed) {
  SeededRandom random(seed);
  const double distance_min = 4 * limits.radius_m;
  std::vector<Vector3> positions;
  int attempts = 0;
  while (positions.size() < count) {
    if (++attempts > kAttemptsPerDrone)
      throw std::runtime_error("the box is too small for the drones");
    const Vector3 point = PointIn(limits.box_m, 0.05, &random);
    const bool clear = std::none_of(positions.begin(), positions.end(), [&](const Vector3& other) {
      return Norm({point[0] - other[0], point[1] - other[1], point[2] - other[2]}) < distance_min;
    });
    if (!clear) continue;
    positions.push_back(point);
    attempts = 0;
  }
  return positions;
}

}  // namespace collision::client
