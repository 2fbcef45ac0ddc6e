// A spaceship among drones, flown once and recorded: every method sees the same motion.
#pragma once

#include <Eigen/Geometry>
#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include "collision_core/motion/space_time_bound.h"
#include "collision_core/shape/shape.h"

namespace collision::bench {

struct ShipState {
  Eigen::Vector3d p_WA, v_WA, w_WB;
  Eigen::Quaterniond q_WB;
  Eigen::Matrix3d matrix_WB;  ///< Of q_WB.
  bool jumped = false;        ///< It bounced: the velocities changed at this frame.
};

/// lower < higher.
struct ShipPair {
  std::uint32_t lower, higher;

  friend auto operator<=>(const ShipPair&, const ShipPair&) = default;
};

/// Two kinds of ships: the first is the spaceship, all others are drones.
struct ShipKind {
  geometry::TriangleMesh mesh;
  std::shared_ptr<const shape::Shape> shape;
  double radius = 0;            ///< About the reference point [m].
  double acceleration_max = 0;  ///< M [m/s²]
  double speed_max = 0;         ///< A ship that flies faster brakes [m/s].
};

struct FlightOptions {
  std::uint32_t drones = 20;
  double volume = 2000;  ///< Of the box for each ship [m³]; it is half as high as wide.
  std::int64_t frames = 600;
  std::uint64_t seed = 1995;
};

/// Recorded at 60 frames a second. No acceleration exceeds M but where two ships touch in a frame
/// and come nearer: they bounce, as balls of one mass would. Out of the box they accelerate inward.
class Flight {
 public:
  static constexpr std::int64_t kFrameNs = 16'666'667;
  static constexpr double kFrame = kFrameNs * 1e-9;

  Flight(const ShipKind& spaceship, const ShipKind& drone, const FlightOptions& options);

  std::uint32_t ships() const { return options_.drones + 1; }
  std::int64_t frames() const { return static_cast<std::int64_t>(states_.size()); }
  const ShipKind& kind(std::uint32_t ship) const { return ship == 0 ? spaceship_ : drone_; }
  const ShipState& at(std::int64_t frame, std::uint32_t ship) const {
    return states_[static_cast<std::size_t>(frame)][ship];
  }
  static Instant InstantOf(std::int64_t frame) {
    return Instant::FromNanoseconds(frame * kFrameNs);
  }
  motion::SpaceTimeBound BoundOf(std::int64_t frame, std::uint32_t ship) const;

  bool BallsOverlap(std::int64_t frame, const ShipPair& pair) const;
  /// All pairs whose balls overlap in the frame, in order.
  std::vector<ShipPair> NearPairs(std::int64_t frame) const;
  /// All pairs that certainly touch in the frame, in order.
  const std::vector<ShipPair>& contacts(std::int64_t frame) const {
    return contacts_[static_cast<std::size_t>(frame)];
  }
  std::size_t undecided() const { return undecided_; }
  std::size_t bounces() const { return bounces_; }

 private:
  void Place();
  void Bounce(std::vector<ShipState>* states, const ShipPair& pair, std::uint64_t seed);
  std::vector<ShipState> Next(const std::vector<ShipState>& states, std::int64_t frame) const;

  const ShipKind& spaceship_;
  const ShipKind& drone_;
  FlightOptions options_;
  Eigen::Vector3d half_;  ///< Of the box.
  std::vector<std::vector<ShipState>> states_;
  std::vector<std::vector<ShipPair>> contacts_;
  std::size_t undecided_ = 0, bounces_ = 0;
};

/// B's frame seen from A's.
struct ShipPose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d offset;
};
ShipPose PoseBetween(const ShipState& a, const ShipState& b);

}  // namespace collision::bench
