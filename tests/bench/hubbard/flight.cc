#include "tests/bench/hubbard/flight.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "collision_core/narrow_phase/separation/separation.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;
/// A ship keeps to one acceleration for so many frames, and to this part of M: rounding takes no
/// motion outside its bound.
constexpr std::int64_t kSameFrames = 30;
constexpr double kShareOfM = 0.999;
/// A ship turns no faster [rad/s], and leaves a contact no slower [m/s].
constexpr double kRotationAngleMax = 1.5, kSpeedApart = 1;

/// Beyond, the box is too small for them.
constexpr int kDrawsMax = 1'000'000;

std::uint64_t Mixed(std::uint64_t seed, std::uint64_t ship, std::uint64_t step) {
  return seed + 0xd1342543de82ef95 * (ship + 1) + 0xaf251af3b0f025b5 * (step + 1);
}

Eigen::Vector3d InBox(Random& random, const Eigen::Vector3d& half) {
  const double x = random.Uniform(-half.x(), half.x()), y = random.Uniform(-half.y(), half.y());
  return {x, y, random.Uniform(-half.z(), half.z())};
}

narrow_phase::Verdict VerdictOf(const ShipKind& a, const ShipKind& b, const ShipPose& pose) {
  narrow_phase::BodySegment body_a, body_b;
  body_a.shape = a.shape, body_b.shape = b.shape;
  WorkBudget work(kUnlimited);
  return narrow_phase::DecideAt({narrow_phase::BodyTree(body_a), narrow_phase::BodyTree(body_b),
                                 narrow_phase::PoseOf(pose.rotation, pose.offset)},
                                &work)
      .verdict;
}

}  // namespace

ShipPose PoseBetween(const ShipState& a, const ShipState& b) {
  return {a.matrix_WB.transpose() * b.matrix_WB, a.matrix_WB.transpose() * (b.p_WA - a.p_WA)};
}

Flight::Flight(const ShipKind& spaceship, const ShipKind& drone, const FlightOptions& options)
    : spaceship_(spaceship), drone_(drone), options_(options) {
  const double width = std::cbrt(2 * options.volume * ships());
  half_ = {width / 2, width / 2, width / 4};
  Place();
  while (frames() <= options.frames) {
    const std::int64_t frame = frames() - 1;
    std::vector<ShipPair> touching;
    for (const ShipPair& pair : NearPairs(frame)) {
      const ShipPose pose = PoseBetween(at(frame, pair.lower), at(frame, pair.higher));
      const narrow_phase::Verdict verdict = VerdictOf(kind(pair.lower), kind(pair.higher), pose);
      undecided_ += verdict == narrow_phase::Verdict::kUndecided;
      if (verdict != narrow_phase::Verdict::kApart) touching.push_back(pair);
    }
    for (const ShipPair& pair : touching) {
      Bounce(&states_.back(), pair, Mixed(options_.seed, pair.lower + (pair.higher << 10), frame));
    }
    contacts_.push_back(std::move(touching));
    if (frame + 1 == options.frames) break;
    states_.push_back(Next(states_.back(), frame));
  }
}

void Flight::Place() {
  Random random(options_.seed);
  std::vector<ShipState> states;
  for (int draws = 0; states.size() < ships(); ++draws) {
    if (draws > kDrawsMax) throw std::runtime_error("the ships do not fit into their box");
    ShipState state;
    const auto ship = static_cast<std::uint32_t>(states.size());
    state.p_WA = InBox(random, half_);
    state.v_WA = 0.7 * kind(ship).speed_max * random.UnitVector();
    state.w_WB = random.Uniform(0, kRotationAngleMax) * random.UnitVector();
    state.q_WB = Eigen::AngleAxisd(random.Uniform(0, 3), random.UnitVector());
    state.matrix_WB = state.q_WB.toRotationMatrix();
    bool free = true;
    for (std::uint32_t other = 0; other < ship && free; ++other) {
      const double reach = kind(ship).radius + kind(other).radius;
      free = (states[other].p_WA - state.p_WA).norm() > reach;
    }
    if (free) states.push_back(state);
  }
  states_.push_back(std::move(states));
}

void Flight::Bounce(std::vector<ShipState>* states, const ShipPair& pair, std::uint64_t seed) {
  ShipState &a = (*states)[pair.lower], &b = (*states)[pair.higher];
  const Eigen::Vector3d n = (b.p_WA - a.p_WA).normalized();
  const double apart = (b.v_WA - a.v_WA).dot(n);
  if (apart >= kSpeedApart) return;
  const double push = 0.5 * (std::max(kSpeedApart, -apart) - apart);
  Random random(seed);
  for (ShipState* state : {&a, &b}) {
    state->v_WA += (state == &a ? -push : push) * n;
    state->w_WB = random.Uniform(0, kRotationAngleMax) * random.UnitVector();
    state->jumped = true;
  }
  ++bounces_;
}

std::vector<ShipState> Flight::Next(const std::vector<ShipState>& states,
                                    std::int64_t frame) const {
  std::vector<ShipState> next = states;
  for (std::uint32_t ship = 0; ship < ships(); ++ship) {
    ShipState& state = next[ship];
    const double most = kShareOfM * kind(ship).acceleration_max;
    Random random(Mixed(options_.seed, ship, static_cast<std::uint64_t>(frame / kSameFrames)));
    Eigen::Vector3d a = random.Uniform(0, most) * random.UnitVector();
    const Eigen::Vector3d inside = state.p_WA.cwiseMax(-half_).cwiseMin(half_);
    const bool leaves = (inside - state.p_WA).dot(state.v_WA) < 0;
    if (leaves) {
      a = most * (inside - state.p_WA).normalized();
    } else if (state.v_WA.norm() > kind(ship).speed_max) {
      a = -most * state.v_WA.normalized();
    }
    state.p_WA += kFrame * state.v_WA + 0.5 * kFrame * kFrame * a;
    state.v_WA += kFrame * a;
    const double rate = state.w_WB.norm();
    if (rate > 0) {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(rate * kFrame, state.w_WB / rate));
      state.q_WB = (turn * state.q_WB).normalized();
    }
    state.matrix_WB = state.q_WB.toRotationMatrix();
    state.jumped = false;
  }
  return next;
}

motion::SpaceTimeBound Flight::BoundOf(std::int64_t frame, std::uint32_t ship) const {
  const ShipState& state = at(frame, ship);
  motion::SpaceTimeBound bound;
  bound.state.stamp = InstantOf(frame);
  bound.state.p_WA = state.p_WA;
  bound.state.v_WA = state.v_WA;
  bound.state.q_WB = state.q_WB;
  bound.state.w_WB = state.w_WB;
  bound.state.discontinuity = state.jumped;
  bound.limits.radius = kind(ship).radius;
  bound.limits.acceleration_max = kind(ship).acceleration_max;
  bound.limits.angular_acceleration_max = 0;
  return bound;
}

bool Flight::BallsOverlap(std::int64_t frame, const ShipPair& pair) const {
  const double reach = kind(pair.lower).radius + kind(pair.higher).radius;
  return (at(frame, pair.higher).p_WA - at(frame, pair.lower).p_WA).squaredNorm() <= reach * reach;
}

std::vector<ShipPair> Flight::NearPairs(std::int64_t frame) const {
  std::vector<ShipPair> pairs;
  for (std::uint32_t i = 0; i < ships(); ++i) {
    for (std::uint32_t k = i + 1; k < ships(); ++k) {
      if (BallsOverlap(frame, {i, k})) pairs.push_back({i, k});
    }
  }
  return pairs;
}

}  // namespace collision::bench
