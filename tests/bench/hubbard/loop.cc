#include "tests/bench/hubbard/loop.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/narrow_phase/separation/separation.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;

class TurkShips : public ShipBroadPhase {
 public:
  explicit TurkShips(double cell) : scale_(1 / cell) {}

  void Look(const Flight& flight, std::int64_t frame, std::vector<ShipPair>* near) override {
    constexpr std::size_t kSlotsPerShip = 2;
    const std::size_t size = std::bit_ceil(kSlotsPerShip * flight.ships());
    slots_.assign(size, -1);
    entries_.clear();
    for (std::uint32_t ship = 0; ship < flight.ships(); ++ship) {
      const Eigen::Vector3d& p = flight.at(frame, ship).p_WA;
      const double radius = flight.kind(ship).radius;
      int lower[3], upper[3];
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = static_cast<int>(std::floor((p[axis] - radius) * scale_));
        upper[axis] = static_cast<int>(std::floor((p[axis] + radius) * scale_));
      }
      first_near_ = near->size();
      for (int x = lower[0]; x <= upper[0]; ++x) {
        for (int y = lower[1]; y <= upper[1]; ++y) {
          for (int z = lower[2]; z <= upper[2]; ++z) {
            Enter(flight, frame, ship, SlotOf(x, y, z, size - 1), near);
          }
        }
      }
    }
  }

 private:
  struct Entry {
    std::uint32_t ship;
    std::int32_t next;
  };

  static std::size_t SlotOf(int x, int y, int z, std::size_t mask) {
    const std::uint64_t mixed = 0x9e3779b97f4a7c15 * static_cast<std::uint64_t>(x) ^
                                0xc2b2ae3d27d4eb4f * static_cast<std::uint64_t>(y) ^
                                0x165667b19e3779f9 * static_cast<std::uint64_t>(z);
    return (mixed >> 20) & mask;
  }

  /// Two ships may share several cells: they are compared once.
  void Enter(const Flight& flight, std::int64_t frame, std::uint32_t ship, std::size_t slot,
             std::vector<ShipPair>* near) {
    for (std::int32_t at = slots_[slot]; at >= 0; at = entries_[at].next) {
      const ShipPair pair{entries_[at].ship, ship};
      if (pair.lower == ship || !flight.BallsOverlap(frame, pair)) continue;
      const auto from = near->begin() + static_cast<std::ptrdiff_t>(first_near_);
      if (std::find(from, near->end(), pair) == near->end()) near->push_back(pair);
    }
    entries_.push_back({ship, slots_[slot]});
    slots_[slot] = static_cast<std::int32_t>(entries_.size()) - 1;
  }

  const double scale_;
  std::size_t first_near_ = 0;  ///< Of the ship that is being entered.
  std::vector<std::int32_t> slots_;
  std::vector<Entry> entries_;
};

class HornShips : public ShipBroadPhase {
 public:
  explicit HornShips(std::unique_ptr<broad_phase::SweepingIndex> phase)
      : phase_(std::move(phase)) {}

  void Look(const Flight& flight, std::int64_t frame, std::vector<ShipPair>* near) override {
    if (frame >= until_) {
      MakeList(flight, frame);
    } else {
      for (std::uint32_t ship = 0; ship < flight.ships(); ++ship) {
        if (flight.at(frame, ship).jumped) AskAnew(flight, frame, ship);
      }
    }
    for (Listed& listed : list_) {
      if (listed.due > frame) continue;
      if (flight.BallsOverlap(frame, listed.pair)) {
        near->push_back(listed.pair);
      } else {
        listed.due = DueOf(flight, frame, listed.pair);
      }
    }
  }

 private:
  /// Frames from one list of all to the next.
  static constexpr std::int64_t kWindow = 30;

  struct Listed {
    ShipPair pair;
    std::int64_t due;  ///< The first frame in which they may overlap.
  };

  void MakeList(const Flight& flight, std::int64_t frame) {
    until_ = frame + kWindow;
    for (std::uint32_t ship = 0; ship < flight.ships(); ++ship) {
      phase_->Set(ship, flight.BoundOf(frame, ship));
    }
    found_.clear();
    phase_->FindNearPairs(
        {intersection::BoundKind::kHorn, Flight::InstantOf(frame), Flight::InstantOf(until_)},
        &found_);
    list_.clear();
    for (const broad_phase::NearPair& pair : found_)
      list_.push_back({{pair.lower, pair.higher}, frame});
  }

  void AskAnew(const Flight& flight, std::int64_t frame, std::uint32_t ship) {
    std::erase_if(list_, [ship](const Listed& listed) {
      return listed.pair.lower == ship || listed.pair.higher == ship;
    });
    phase_->Set(ship, flight.BoundOf(frame, ship));
    meetings_.clear();
    const Instant until = Flight::InstantOf(until_);
    const auto skip_none = [](std::uint32_t) { return false; };
    phase_->FindNeighbours(ship, {Flight::InstantOf(frame), until, until}, skip_none, &meetings_);
    for (const broad_phase::Neighbour& meeting : meetings_) {
      const auto [lower, higher] = std::minmax(ship, meeting.partner);
      list_.push_back({{lower, higher}, frame});
    }
  }

  /// The last frame before they may meet, and one at least: rounded down, never late.
  std::int64_t DueOf(const Flight& flight, std::int64_t frame, const ShipPair& pair) const {
    const Instant now = Flight::InstantOf(frame), until = Flight::InstantOf(until_);
    const intersection::IntersectionTime time = intersection::EarliestIntersection(
        flight.BoundOf(frame, pair.lower), flight.BoundOf(frame, pair.higher), now, until);
    if (!(time.seconds < numeric::kInfinity)) return until_;
    const auto frames = static_cast<std::int64_t>(time.seconds / Flight::kFrame);
    return std::min(until_, frame + std::max<std::int64_t>(1, frames));
  }

  std::unique_ptr<broad_phase::SweepingIndex> phase_;
  std::int64_t until_ = -1;  ///< The list knows of the frames before this one.
  std::vector<Listed> list_;
  std::vector<broad_phase::NearPair> found_;
  std::vector<broad_phase::Neighbour> meetings_;
};

}  // namespace

std::unique_ptr<ShipBroadPhase> MakeTurk(double cell) { return std::make_unique<TurkShips>(cell); }

std::unique_ptr<ShipBroadPhase> MakeHorns(std::unique_ptr<broad_phase::SweepingIndex> phase) {
  return std::make_unique<HornShips>(std::move(phase));
}

ShipComparison BySphereTrees(const ShipKind& spaceship, const ShipKind& drone) {
  narrow_phase::BodySegment of_spaceship, of_drone;
  of_spaceship.shape = spaceship.shape, of_drone.shape = drone.shape;
  return [of_spaceship, of_drone](const Flight& flight, std::int64_t frame, const ShipPair& pair) {
    const narrow_phase::BodyTree a(pair.lower == 0 ? of_spaceship : of_drone), b(of_drone);
    const ShipPose pose = PoseBetween(flight.at(frame, pair.lower), flight.at(frame, pair.higher));
    WorkBudget work(kUnlimited);
    return narrow_phase::DecideAt({a, b, narrow_phase::PoseOf(pose.rotation, pose.offset)}, &work)
               .verdict != narrow_phase::Verdict::kApart;
  };
}

ShipComparison ByBspTrees(const ShipKind& spaceship, const ShipKind& drone) {
  const auto of_spaceship = std::make_shared<baselines::BspTree>(spaceship.mesh);
  const auto of_drone = std::make_shared<baselines::BspTree>(drone.mesh);
  return [of_spaceship, of_drone](const Flight& flight, std::int64_t frame, const ShipPair& pair) {
    const ShipPose pose = PoseBetween(flight.at(frame, pair.lower), flight.at(frame, pair.higher));
    return baselines::BspTree::Intersect(pair.lower == 0 ? *of_spaceship : *of_drone, *of_drone,
                                         pose.rotation, pose.offset);
  };
}

}  // namespace collision::bench
