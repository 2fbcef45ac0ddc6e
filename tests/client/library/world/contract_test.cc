// Goal:   a state that the client does not send keeps the contract at the service, and an honest
//         sender's states are not sent needlessly.
// Method: against the core's own check, which is in intervals, on both sides of every bound; honest
//         integrators at full thrust; each field that counts changed on its own.
#include "client/library/world/contract.h"

#include <gtest/gtest.h>

#include <cmath>

#include "collision_core/motion/contract.h"
#include "tests/support/random.h"

namespace collision::client {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Vector3 ToArray(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d ToVector(const Vector3& v) { return {v[0], v[1], v[2]}; }

motion::MotionState ToCore(const State& state) {
  motion::MotionState core;
  core.stamp = Instant::FromNanoseconds(state.stamp_ns);
  core.p_WA = ToVector(state.position_m);
  core.v_WA = ToVector(state.velocity_m_s);
  const Quaternion& q = state.orientation;
  core.q_WB = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  core.w_WB = ToVector(state.angular_velocity_rad_s);
  core.position_error = state.position_error_m;
  core.velocity_error = state.velocity_error_m_s;
  core.rotation_error = state.rotation_error_rad;
  core.direction = ToVector(state.thrust_direction.value_or(Vector3{}));
  core.direction_until = Instant::FromNanoseconds(state.direction_until_ns);
  core.expiry = Instant::FromNanoseconds(state.expiry_ns.value_or(kNever));
  return core;
}

motion::ContractVerdict ServiceSays(const MotionBounds& bounds, const State& sent,
                                    const State& next) {
  motion::SpaceTimeBound before;
  before.state = ToCore(sent);
  before.limits.acceleration_max = bounds.acceleration_max_m_s2;
  before.limits.time_step = bounds.time_step_s;
  before.limits.angular_acceleration_max = bounds.angular_acceleration_max_rad_s2.value_or(-1);
  const auto orientation =
      bounds.turns ? motion::OrientationUse::kMatters : motion::OrientationUse::kIgnored;
  return CheckContract(before, ToCore(next), orientation).verdict;
}

Quaternion About(const Eigen::Vector3d& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {std::cos(angle / 2), s * axis.x(), s * axis.y(), s * axis.z()};
}

// States that a random sender may send one after the other, near the bounds and beyond.
struct StatePair {
  MotionBounds bounds;
  State sent, next;
};

StatePair RandomPair(Random* random) {
  StatePair pair;
  pair.bounds.acceleration_max_m_s2 = random->Chance(0.1) ? 0 : random->LogUniform(1e-3, 1e3);
  pair.bounds.time_step_s = random->Chance(0.7) ? 0 : random->LogUniform(1e-3, 0.1);
  pair.bounds.turns = random->Chance(0.5);
  pair.bounds.angular_acceleration_max_rad_s2 = random->LogUniform(1e-3, 10);
  State& sent = pair.sent;
  sent.stamp_ns = static_cast<std::int64_t>(random->Below(1000) * kSecond);
  sent.position_m = ToArray(random->LogUniform(1e-3, 1e9) * random->UnitVector());
  sent.velocity_m_s = ToArray(random->LogUniform(1e-3, 1e4) * random->UnitVector());
  sent.position_error_m = random->Chance(0.5) ? 0 : random->LogUniform(1e-6, 1);
  sent.velocity_error_m_s = random->Chance(0.5) ? 0 : random->LogUniform(1e-6, 1);
  sent.rotation_error_rad = random->Chance(0.5) ? 0 : random->LogUniform(1e-6, 1e-2);
  const Eigen::Vector3d axis = random->UnitVector();
  sent.angular_velocity_rad_s = ToArray(random->LogUniform(1e-3, 3) * axis);
  if (random->Chance(0.3)) sent.thrust_direction = ToArray(random->UnitVector());
  State& next = pair.next;
  next = sent;
  const double s = random->LogUniform(1e-3, 100);
  const auto ns = static_cast<std::int64_t>(std::llround(s * 1e9));
  next.stamp_ns += ns;
  const double acceleration_max = pair.bounds.acceleration_max_m_s2;
  const double share =
      random->Chance(0.5) ? random->Uniform(0, 2) : 1 + random->Uniform(-1, 1) * 1e-6;
  const Eigen::Vector3d moved =
      ToVector(sent.velocity_m_s) * s +
      share * 0.5 * acceleration_max * s * (s + pair.bounds.time_step_s) * random->UnitVector();
  const Eigen::Vector3d sped =
      random->Uniform(0, 1.3) * acceleration_max * s * random->UnitVector();
  next.position_m = ToArray(ToVector(sent.position_m) + moved);
  next.velocity_m_s = ToArray(ToVector(sent.velocity_m_s) + sped);
  next.orientation = About(axis, ToVector(sent.angular_velocity_rad_s).norm() * s +
                                     random->Uniform(-1, 1) * 0.6 * s * s *
                                         *pair.bounds.angular_acceleration_max_rad_s2);
  return pair;
}

TEST(Contract, AStateNotSentBreaksNothingAtTheService) {
  Random random(61);
  int kept_back = 0, breached = 0;
  for (int i = 0; i < 50000; ++i) {
    const StatePair pair = RandomPair(&random);
    const motion::ContractVerdict verdict = ServiceSays(pair.bounds, pair.sent, pair.next);
    breached += verdict == motion::ContractVerdict::kBreached;
    if (!StandsIn(pair.bounds, pair.sent, pair.next)) continue;
    ++kept_back;
    ASSERT_NE(verdict, motion::ContractVerdict::kBreached) << i;
  }
  EXPECT_GT(kept_back, 5000);
  EXPECT_GT(breached, 5000);
}

TEST(Contract, HonestIntegratorsStaySilent) {
  Random random(62);
  for (int i = 0; i < 2000; ++i) {
    const double dt = random.LogUniform(1e-4, 1);
    const bool is_euler = random.Chance(0.5);
    const MotionBounds bounds{
        .acceleration_max_m_s2 = random.Chance(0.2) ? 0 : random.LogUniform(1e-3, 1e3),
        .time_step_s = is_euler ? dt : 0};
    State sent;
    sent.position_m = ToArray(random.LogUniform(1e-3, 1e9) * random.UnitVector());
    sent.velocity_m_s = ToArray(random.LogUniform(1e-3, 1e4) * random.UnitVector());
    const Eigen::Vector3d a = bounds.acceleration_max_m_s2 * (1 - 0x1p-52) * random.UnitVector();
    State next = sent;
    const int steps = static_cast<int>(1 + random.Below(400));
    for (int step = 1; step <= steps; ++step) {
      for (int axis = 0; axis < 3; ++axis) {
        double &p = next.position_m[axis], &v = next.velocity_m_s[axis];
        if (is_euler) {
          v += a[axis] * dt;
          p += v * dt;
        } else {
          p += v * dt + 0.5 * a[axis] * dt * dt;
          v += a[axis] * dt;
        }
      }
    }
    next.stamp_ns = std::llround(steps * dt * 1e9);
    ASSERT_TRUE(StandsIn(bounds, sent, next)) << i << " after " << steps;
  }
}

// A person at a standstill, a second ago; each change below must be sent.
TEST(Contract, EveryNewDeclarationIsSent) {
  const MotionBounds bounds{.acceleration_max_m_s2 = 2,
                            .angular_acceleration_max_rad_s2 = 1,
                            .speed_max_m_s = 1,
                            .turns = true};
  const State sent{.position_error_m = 0.1,
                   .velocity_error_m_s = 0.1,
                   .rotation_error_rad = 0.1,
                   .thrust_direction = {{1, 0, 0}},
                   .direction_until_ns = 5 * kSecond,
                   .expiry_ns = 9 * kSecond};
  State next = sent;
  next.stamp_ns = kSecond;
  EXPECT_TRUE(StandsIn(bounds, sent, next));
  const auto expect_told = [&](const char* what, const auto& change) {
    State changed = next;
    change(&changed);
    EXPECT_FALSE(StandsIn(bounds, sent, changed)) << what;
  };
  expect_told("discontinuity", [](State* s) { s->discontinuity = true; });
  expect_told("position_error_m", [](State* s) { s->position_error_m = 0.11; });
  expect_told("velocity_error_m_s", [](State* s) { s->velocity_error_m_s = 0.11; });
  expect_told("rotation_error_rad", [](State* s) { s->rotation_error_rad = 0.11; });
  expect_told("thrust_direction", [](State* s) { s->thrust_direction = {{0, 1, 0}}; });
  expect_told("direction_until_ns", [](State* s) { s->direction_until_ns += 1; });
  expect_told("expiry_ns, later", [](State* s) { s->expiry_ns = 9 * kSecond + 1; });
  expect_told("expiry_ns, earlier", [](State* s) { s->expiry_ns = 9 * kSecond - 1; });
  // 1/2 M s² = 1 m, the errors 0.3 m; M s = 2 m/s, the errors 0.2 m/s; 1/2 α s² = 0.5, α s = 1.
  expect_told("position", [](State* s) { s->position_m = {1.301, 0, 0}; });
  expect_told("position, against the direction", [](State* s) { s->position_m = {-0.301, 0, 0}; });
  expect_told("velocity above the cap", [](State* s) { s->velocity_m_s = {0, 1.101, 0}; });
  expect_told("velocity, against the direction", [](State* s) {
    s->velocity_m_s = {-0.201, 0, 0};
  });
  // Both are within reach, but an agent that arrives there so fast was nearly 2 m away a second
  // ago.
  expect_told("velocity, from elsewhere", [](State* s) {
    s->position_m = {0, -0.9, 0};
    s->velocity_m_s = {0, 1.099, 0};
  });
  expect_told("orientation", [](State* s) { s->orientation = About({0, 0, 1}, 0.701); });
  expect_told("angular velocity", [](State* s) { s->angular_velocity_rad_s = {0, 0, 1.001}; });
  expect_told("back in time", [](State* s) { s->stamp_ns = -1; });
  State within = next;
  within.position_m = {0, 0.549, 0};
  within.velocity_m_s = {0, 1.099, 0};
  within.orientation = About({0, 0, 1}, 0.699);
  within.angular_velocity_rad_s = {0, 0, 0.999};
  within.position_error_m = 0.1;
  EXPECT_TRUE(StandsIn(bounds, sent, within));
  EXPECT_FALSE(StandsIn({.acceleration_max_m_s2 = 0.5}, sent, within)) << "velocity";
  within.position_m = {1.299, 0, 0};
  within.velocity_m_s = {2.199, 0, 0};
  EXPECT_TRUE(StandsIn({.acceleration_max_m_s2 = 2}, sent, within)) << "far and fast";
}

// The orientation of a ball, or of an agent without α, does not matter.
TEST(Contract, OnlyABoundedRotationOfAShapeCounts) {
  const State sent;
  const State turned{.stamp_ns = kSecond, .orientation = {0, 1, 0, 0}};
  EXPECT_TRUE(StandsIn({.angular_acceleration_max_rad_s2 = 0}, sent, turned));
  EXPECT_TRUE(StandsIn({.turns = true}, sent, turned));
  EXPECT_FALSE(StandsIn({.angular_acceleration_max_rad_s2 = 0, .turns = true}, sent, turned));
}

// The greatest allowed values cause neither NaN nor overflow.
TEST(Contract, ExtremesAreDecided) {
  const State far{.stamp_ns = -(std::int64_t{1} << 62),
                  .position_m = {1e15, 1e15, 1e15},
                  .velocity_m_s = {1e9, 1e9, 1e9}};
  State later = far;
  later.stamp_ns = std::int64_t{1} << 62;
  EXPECT_TRUE(StandsIn({.acceleration_max_m_s2 = 1e18, .time_step_s = 3600}, far, later));
  EXPECT_FALSE(StandsIn({}, far, later));
}

}  // namespace
}  // namespace collision::client
