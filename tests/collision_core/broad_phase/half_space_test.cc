// Goal:   an agent's meeting with a half-space is never late and not idle, with margins and speed
//         caps; the filter before it rules out nothing that meets, and most of what does not.
// Method: exact rational arithmetic. The distance to the plane, n·c − offset − |n| (ρ + margin), is
//         concave in time, so that it is positive between two times where it is so at both; its
//         sign is that of squares, as |n| is irrational.
#include "collision_core/broad_phase/half_space.h"

#include <gtest/gtest.h>

#include "collision_core/broad_phase/filter/horn_table.h"
#include "collision_core/motion/speed_cap.h"
#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/exact.h"

namespace collision::broad_phase {
namespace {

constexpr int kCases = kSanitized ? 1000 : 40000;

constexpr Instant kFrom = Instant::FromNanoseconds(2'000'000'000);
constexpr intersection::BroadQuery kForever{intersection::BoundKind::kHorn, kFrom,
                                            Instant::Never()};

/// What is added to the reach, as a part of all that enters: the inputs' last digits.
constexpr double kForced = 16 * 0x1p-53;

class ExactPlane {
 public:
  /// No skew: |v| κ would be irrational.
  ExactPlane(const HalfSpace& half_space, const motion::SpaceTimeBound& bound, double margin,
             Instant base)
      : half_space_(half_space), bound_(bound), since_(ExactSeconds(bound.state.stamp, base)) {
    for (int i = 0; i < 3; ++i)
      square_ += Exact(half_space.normal[i]) * Exact(half_space.normal[i]);
    radius_ = Exact(bound.limits.radius) + Exact(margin);
    if (!HasSpeedCap(bound.limits)) return;
    const Instant from = CapStartOf(bound);
    if (!from.is_never()) cap_ = ExactSeconds(bound.state.stamp, from);
  }

  /// Is it certainly out of reach from the base until `x` seconds after it, by one of the balls?
  bool FreeBefore(const Exact& x, double forced) const {
    const Exact end = since_ + x;
    if (IsOut(since_, since_, forced) && IsOut(end, end, forced)) return true;
    if (!cap_) return false;
    // The horn's ball until the cap takes over, then the capped one: a concave distance each.
    const Exact turn = std::min(std::max(*cap_, since_), end);
    return IsOut(since_, std::min(since_, *cap_), forced) &&
           IsOut(turn, std::min(turn, *cap_), forced) && IsOut(end, std::min(end, *cap_), forced);
  }

  /// Does it stay out for ever, by one of the balls?
  bool FreeForEver() const {
    const Exact M = bound_.limits.acceleration_max;
    const Exact error = bound_.state.velocity_error;
    Exact along = 0;
    for (int i = 0; i < 3; ++i) along += Exact(half_space_.normal[i]) * Exact(bound_.state.v_WA[i]);
    const bool horn = M == 0 && along >= 0 && along * along >= square_ * error * error &&
                      IsOut(since_, since_, 0);
    const Exact turn = cap_ ? std::max(*cap_, since_) : Exact(0);
    const bool cap = cap_ && bound_.limits.speed_max == 0 && M == 0 &&
                     IsOut(since_, std::min(since_, *cap_), 0) && IsOut(turn, *cap_, 0);
    return horn || cap;
  }

 private:
  /// At `tau` seconds after the stamp, of a ball that was the horn's until `turn`. At the edge is
  /// not out, except that a promise up to an instant does not count that instant itself.
  bool IsOut(const Exact& tau, const Exact& turn, double forced) const {
    const motion::MotionLimits& limits = bound_.limits;
    const Exact M = limits.acceleration_max, step = limits.time_step;
    Exact reach = radius_ + Exact(bound_.state.position_error) +
                  Exact(bound_.state.velocity_error) * turn + M * turn * (turn + step) / 2;
    if (tau > turn) reach += (Exact(limits.speed_max) + M * step / 2) * (tau - turn);
    Exact distance = -Exact(half_space_.offset), magnitude = abs(distance);
    for (int i = 0; i < 3; ++i) {
      const Exact n = half_space_.normal[i], way = Exact(bound_.state.v_WA[i]) * turn;
      distance += n * (Exact(bound_.state.p_WA[i]) + way);
      magnitude += abs(n) * (abs(Exact(bound_.state.p_WA[i])) + abs(way));
    }
    distance -= Exact(forced) * magnitude;
    reach += Exact(forced) * reach;
    return distance >= 0 && distance * distance >= square_ * reach * reach;
  }

  const HalfSpace& half_space_;
  const motion::SpaceTimeBound& bound_;
  Exact since_, radius_, square_ = 0;
  std::optional<Exact> cap_;  ///< Seconds after the stamp when it takes over.
};

struct Case {
  HalfSpace half_space;
  motion::SpaceTimeBound bound;
  double margin = 0;
};

/// Any magnitudes, in front of the plane, touching it within some units in the last place, or
/// behind it.
Case Draw(bool caps, Random* random) {
  Case c;
  const double size = random->LogUniform(1e-9, 1e9), length = random->LogUniform(1e-9, 1e9);
  c.half_space.normal = length * random->UnitVector();
  if (random->Chance(0.2)) c.half_space.normal = {0, 0, length};
  motion::MotionState& state = c.bound.state;
  motion::MotionLimits& limits = c.bound.limits;
  state.stamp = Instant::FromNanoseconds(static_cast<std::int64_t>(random->Below(3'000'000'000)));
  state.p_WA = size * random->LogUniform(1e-3, 1e6) * random->UnitVector();
  if (random->Chance(0.8)) state.v_WA = size * random->LogUniform(1e-3, 10) * random->UnitVector();
  if (random->Chance(0.3)) state.v_WA.setZero();
  if (random->Chance(0.8)) limits.radius = size * random->LogUniform(1e-6, 1);
  if (random->Chance(0.7)) limits.acceleration_max = size * random->LogUniform(1e-3, 10);
  if (random->Chance(0.2)) state.position_error = 0.01 * size;
  if (random->Chance(0.2)) state.velocity_error = 0.1 * state.v_WA.norm();
  if (random->Chance(0.2)) limits.time_step = 0.01;
  if (random->Chance(0.3)) c.margin = size * random->LogUniform(1e-6, 10);
  if (caps) limits.speed_max = state.v_WA.norm() * random->Uniform(1, 2);
  const double since = std::max(0.0, numeric::SecondsBetween(state.stamp, kFrom).upper);
  const double along = c.half_space.normal.dot(state.p_WA + since * state.v_WA);
  double gap = limits.radius + c.margin + state.position_error + state.velocity_error * since +
               0.5 * limits.acceleration_max * since * (since + limits.time_step);
  if (random->Chance(0.7)) gap += size * random->LogUniform(1e-6, 10);
  if (random->Chance(0.1)) gap = -gap;
  c.half_space.offset = along - c.half_space.normal.norm() * gap;
  return c;
}

/// Fatal failures tell; counts what met later than at once.
void Judge(const Case& c, int* met) {
  const intersection::IntersectionTime time =
      EarliestIntersectionOf(kForever, c.half_space, c.bound, c.margin);
  ASSERT_EQ(time.base, std::max(kFrom, c.bound.state.stamp));
  if (NeverMoves(c.bound)) {
    ASSERT_EQ(time.seconds, numeric::kInfinity);
    return;
  }
  const ExactPlane plane(c.half_space, c.bound, c.margin, time.base);
  if (time.seconds == numeric::kInfinity) {
    // Or so far ahead that it is no instant.
    ASSERT_TRUE(plane.FreeForEver() || plane.FreeBefore(Exact(9e9), 0)) << "never is too late";
    return;
  }
  if (time.seconds > 0) {
    ++*met;
    ASSERT_TRUE(plane.FreeBefore(Exact(time.seconds), 0)) << "late: " << time.seconds;
  }
  const Exact ahead = Exact(time.seconds) * Exact(1 + 1e-9);
  ASSERT_FALSE(plane.FreeBefore(ahead, kForced)) << "idle: " << time.seconds;
}

TEST(HalfSpace, MeetingsAreNeitherLateNorIdle) {
  Random random(1);
  int met = 0;
  for (int i = 0; i < kCases; ++i) {
    Judge(Draw(false, &random), &met);
    ASSERT_FALSE(HasFatalFailure()) << "case " << i;
  }
  EXPECT_GT(met, kCases / 4);
}

TEST(HalfSpace, SpeedCapsPostponeThem) {
  Random random(2);
  int met = 0, later = 0;
  for (int i = 0; i < kCases; ++i) {
    Case c = Draw(true, &random);
    Judge(c, &met);
    ASSERT_FALSE(HasFatalFailure()) << "case " << i;
    const double capped = EarliestIntersectionOf(kForever, c.half_space, c.bound, c.margin).seconds;
    c.bound.limits.speed_max = numeric::kInfinity;
    const double without =
        EarliestIntersectionOf(kForever, c.half_space, c.bound, c.margin).seconds;
    ASSERT_TRUE(NeverMoves(c.bound) || capped >= without);
    later += capped > without;
  }
  EXPECT_GT(met, kCases / 8);
  EXPECT_GT(later, kCases / 16);
}

motion::SpaceTimeBound Falling() {
  motion::SpaceTimeBound bound;
  bound.state.p_WA = {100, -200, 7};
  bound.state.v_WA = {3, 0, -2};
  bound.limits.radius = 1;
  return bound;
}

double Seconds(const HalfSpace& half_space, const AgentBound& bound, Instant until,
               double margin = 0) {
  return EarliestIntersectionOf({intersection::BoundKind::kHorn, Instant(), until}, half_space,
                                bound, margin)
      .seconds;
}

// Goal:   by hand: 6 m above the floor at 2 m/s, so at 3 s; with 2 m of margin at 2 s; whatever the
//         normal's length, and of either kind of bound.
TEST(HalfSpace, FallsToTheFloor) {
  for (const double length : {1.0, 0.25, 1024.0}) {
    const HalfSpace floor{{0, 0, length}, 0};
    EXPECT_LE(Seconds(floor, Falling(), Instant::Never()), 3);
    EXPECT_GE(Seconds(floor, Falling(), Instant::Never()), 3 - 1e-9);
    EXPECT_LE(Seconds(floor, Falling(), Instant::Never(), 2), 2);
    EXPECT_GE(Seconds(floor, Falling(), Instant::Never(), 2), 2 - 1e-9);
    const Instant until = Instant::FromNanoseconds(4'000'000'000);
    EXPECT_EQ(EarliestIntersectionOf({intersection::BoundKind::kHypertrapezoid, Instant(), until},
                                     floor, Falling())
                  .seconds,
              Seconds(floor, Falling(), until));
  }
}

// Goal:   agents that cannot meet the floor never do: masks in either direction, no motion, an
//         expiry, the query's end.
TEST(HalfSpace, MeetsOnlyWhatItMay) {
  HalfSpace floor{{0, 0, 1}, 0, {}};
  AgentBound agent = Falling();
  motion::SpaceTimeBound& bound = agent.bound;
  const Instant just_before = Instant::FromNanoseconds(2'999'999'990);
  EXPECT_EQ(Seconds(floor, agent, just_before), numeric::kInfinity);
  EXPECT_LT(Seconds(floor, agent, Instant::FromNanoseconds(3'000'000'000)), numeric::kInfinity);
  bound.state.expiry = just_before;
  EXPECT_EQ(Seconds(floor, agent, Instant::Never()), numeric::kInfinity);
  bound.state.expiry = Instant::FromNanoseconds(3'000'000'010);
  EXPECT_LT(Seconds(floor, agent, Instant::Never()), numeric::kInfinity);
  floor.filter = {.group = 2, .mask = 1};
  EXPECT_LT(Seconds(floor, agent, Instant::Never()), numeric::kInfinity);
  agent.filter.mask = 1;
  EXPECT_EQ(Seconds(floor, agent, Instant::Never()), numeric::kInfinity);
  agent.filter.mask = 2;
  EXPECT_LT(Seconds(floor, agent, Instant::Never()), numeric::kInfinity);
  agent.filter.group = 4;
  EXPECT_EQ(Seconds(floor, agent, Instant::Never()), numeric::kInfinity);
  agent = Falling();
  bound.state.v_WA.setZero();
  bound.state.p_WA.z() = -5;
  EXPECT_EQ(Seconds(HalfSpace(), agent, Instant::Never()), numeric::kInfinity)
      << "inside, but still";
  bound.limits.acceleration_max = 1e-9;
  EXPECT_EQ(Seconds(HalfSpace(), agent, Instant::Never()), 0);
}

TEST(HalfSpaces, AreKeptInOrderAndFew) {
  HalfSpaces list;
  for (std::uint32_t i = 0; i < HalfSpaces::kCountMax; ++i) {
    ASSERT_TRUE(list.Set(1000 - i, HalfSpace()));
  }
  EXPECT_FALSE(list.Set(5, HalfSpace()));
  EXPECT_EQ(list.Find(5), nullptr);
  HalfSpace other;
  other.offset = 3;
  EXPECT_TRUE(list.Set(1000, other));
  EXPECT_EQ(list.Find(1000)->half_space.offset, 3);
  EXPECT_TRUE(std::is_sorted(list.begin(), list.end(),
                             [](const auto& a, const auto& b) { return a.agent < b.agent; }));
  EXPECT_TRUE(list.Remove(1000));
  EXPECT_FALSE(list.Remove(1000));
  EXPECT_TRUE(list.Set(5, HalfSpace()));
}

TEST(HalfSpaces, RefuseWhatIsNone) {
  HalfSpaces list;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Vector3d& normal :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 1e-101, 0), Eigen::Vector3d(1, 2e100, 0),
        Eigen::Vector3d(1, nan, 0), Eigen::Vector3d(numeric::kInfinity, 0, 0)}) {
    EXPECT_FALSE(list.Set(1, {normal, 0}));
  }
  EXPECT_FALSE(list.Set(1, {Eigen::Vector3d::UnitX(), nan}));
  EXPECT_FALSE(list.Set(1, {Eigen::Vector3d::UnitX(), numeric::kInfinity}));
  EXPECT_EQ(list.size(), 0u);
}

// Goal:   the filter passes all that meets within the limit, and not much else.
TEST(HalfSpaces, TheFilterRulesOutNothingThatMeets) {
  Random random(3);
  int passed = 0, idle = 0, ruled_out = 0;
  for (int i = 0; i < kCases; ++i) {
    const Case c = Draw(i % 4 == 0, &random);
    HalfSpaces list;
    ASSERT_TRUE(list.Set(1, c.half_space));
    HornTable table;
    table.Set(0, c.bound);
    if (table.row(0).unfilterable || table.row(0).still) continue;
    const intersection::IntersectionTime time =
        EarliestIntersectionOf(kForever, c.half_space, c.bound, c.margin);
    const double waited = numeric::SecondsBetween(kFrom, time.base).upper,
                 meets = waited + time.seconds;
    const numeric::QuickBall horn = table.At(0, kFrom);
    const auto may = [&](double limit) { return MayReach(*list.begin(), horn, c.margin, limit); };
    if (time.seconds < numeric::kInfinity) {
      ASSERT_TRUE(may(meets)) << "case " << i;
      ASSERT_TRUE(may(1.5 * meets)) << "case " << i;
      ++passed;
    }
    // Caps are left to the canonical routine, and stamps to come cost some.
    if (!HasSpeedCap(c.bound.limits) && waited == 0 && meets > 1e-3) {
      ++(may(std::min(0.99 * meets, 1e9)) ? idle : ruled_out);
    }
  }
  EXPECT_GT(passed, kCases / 4);
  EXPECT_GT(ruled_out, kCases / 8);
  EXPECT_LT(idle, ruled_out / 50);
}

}  // namespace
}  // namespace collision::broad_phase
