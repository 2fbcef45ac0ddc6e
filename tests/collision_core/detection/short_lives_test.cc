// Goal:   agents that come, jump and go within one step are judged like any other: whatever two of
//         them met while both were there is told, and no contact that was none.
// Method: random lives of balls, and steps from a tenth of a second to the whole run; each step is
//         told an agent's first state, its jumps and where it is in the end; against the exact
//         contacts of the balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/ball_contacts.h"

namespace collision::detection {
namespace {

constexpr std::uint32_t kLives = 40;
constexpr double kAccelerationMax = 2, kRadius = 1;
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kEnd = 10 * kSecond;
// The truth is worked out in doubles: what is known of it.
constexpr std::int64_t kTolerance = 100;  // [ns]
constexpr double kGrazing = 1e-6;         // [m]

/// What tells that nothing follows: the last state expires, while its owner goes on; or the owner
/// has reported nothing beyond.
enum class Ending { kExpiry, kRemoval };

struct Life {
  PiecewiseMotion motion;
  std::int64_t from_ns = 0, until_ns = 0;
};

/// Up to three seconds in a ball of 12 m.
Life Draw(Random* random) {
  const auto place = [&] { return Vector3d(6 * random->Uniform(0, 1) * random->UnitVector()); };
  Life life;
  life.from_ns = static_cast<std::int64_t>(random->Uniform(0, 0.9) * static_cast<double>(kEnd));
  life.until_ns = std::min(
      kEnd, life.from_ns + static_cast<std::int64_t>(random->LogUniform(0.05, 3) * kSecond));
  std::int64_t start_ns = life.from_ns;
  while (start_ns < life.until_ns) {
    std::int64_t end = life.until_ns;
    if (random->Chance(0.5)) {
      end = std::min(end, start_ns + static_cast<std::int64_t>(random->Uniform(0.1, 1) * kSecond));
    }
    if (start_ns > life.from_ns) life.motion.jumps_ns.push_back(start_ns);
    life.motion.pieces.push_back({.start_ns = start_ns,
                                  .end_ns = end,
                                  .p = place(),
                                  .v = 5 * random->UnitVector(),
                                  .a = 0.9 * kAccelerationMax * random->UnitVector()});
    start_ns = end;
  }
  return life;
}

motion::MotionState StateAt(const Life& life, std::int64_t t_ns) {
  const MotionPiece piece = life.motion.At(t_ns).From(t_ns);
  motion::MotionState state;
  state.stamp = Instant::FromNanoseconds(t_ns);
  state.p_WA = piece.p;
  state.v_WA = piece.v;
  state.position_error = 1e-9;
  state.velocity_error = 1e-9;
  return state;
}

class ShortLives : public testing::TestWithParam<Ending> {
 protected:
  /// What the agent does after `begin_ns`, up to `end_ns`: its first state, its jumps and where it
  /// is in the end.
  void Tell(std::uint32_t slot, const Life& life, std::int64_t begin_ns, std::int64_t end_ns) {
    if (life.until_ns <= begin_ns || life.from_ns > end_ns) return;
    const Instant granted = Instant::FromNanoseconds(end_ns);
    if (life.from_ns > begin_ns) {
      detector_.Admit(Id(slot), {.limits = {kRadius, kAccelerationMax}},
                      StateAt(life, life.from_ns), granted);
    }
    for (const std::int64_t jump_ns : life.motion.jumps_ns) {
      if (jump_ns <= begin_ns || jump_ns > end_ns) continue;
      motion::MotionState state = StateAt(life, jump_ns);
      state.discontinuity = true;
      detector_.Update(Id(slot), state, granted);
    }
    const bool leaves = life.until_ns <= end_ns;
    motion::MotionState last = StateAt(life, std::min(end_ns, life.until_ns));
    if (leaves && GetParam() == Ending::kExpiry) last.expiry = last.stamp;
    detector_.Update(Id(slot), last, granted);
    if (!leaves || GetParam() == Ending::kExpiry) {
      detector_.SetHeardUntil(OwnerOf(Id(slot)), granted);
    }
    if (leaves) detector_.Remove(Id(slot));
  }

  void Fly(const std::vector<Life>& lives, Random* random) {
    detector_ = Detector({});
    events_.clear();
    for (std::int64_t begin_ns = -1; begin_ns < kEnd;) {
      const auto end_ns = std::min(
          kEnd, begin_ns + static_cast<std::int64_t>(random->LogUniform(0.1, 10) * kSecond));
      for (std::uint32_t slot = 0; slot < lives.size(); ++slot) {
        Tell(slot, lives[slot], begin_ns, end_ns);
      }
      detector_.Advance(Instant::FromNanoseconds(end_ns));
      detector_.Validate();
      events_.insert(events_.end(), detector_.events().begin(), detector_.events().end());
      begin_ns = end_ns;
    }
  }

  static bool IsCertain(const CollisionEvent& event) {
    return event.status == EventStatus::kConfirmed || event.status == EventStatus::kEnded;
  }

  bool IsTold(std::uint32_t a, std::uint32_t b, std::int64_t begin_ns) const {
    return std::any_of(events_.begin(), events_.end(), [&](const CollisionEvent& event) {
      if (event.lower != Id(a) || event.higher != Id(b)) return false;
      const Instant latest = IsCertain(event) ? event.begin.latest : event.end.latest;
      return event.begin.earliest.nanoseconds() - kTolerance <= begin_ns &&
             (latest.is_never() || begin_ns <= latest.nanoseconds() + kTolerance);
    });
  }

  static std::vector<BallContact> ContactsOf(const Life& a, const Life& b) {
    const std::int64_t from = std::max(a.from_ns, b.from_ns), to = std::min(a.until_ns, b.until_ns);
    if (from >= to) return {};
    return BallContacts(a.motion, b.motion, 2 * kRadius, from, to);
  }

  Detector detector_{{}};
  std::vector<CollisionEvent> events_;
};

TEST_P(ShortLives, WhateverTheyMetIsToldAndNothingElse) {
  int contacts = 0, certain = 0;
  for (std::uint64_t seed = 1; seed <= (kSanitized ? 20 : 200); ++seed) {
    Random random(seed);
    std::vector<Life> lives;
    for (std::uint32_t slot = 0; slot < kLives; ++slot) lives.push_back(Draw(&random));
    Fly(lives, &random);
    for (std::uint32_t a = 0; a < kLives; ++a) {
      for (std::uint32_t b = a + 1; b < kLives; ++b) {
        for (const BallContact& contact : ContactsOf(lives[a], lives[b])) {
          if (contact.depth < kGrazing) continue;
          ++contacts;
          EXPECT_TRUE(IsTold(a, b, contact.begin_ns))
              << "seed " << seed << ": " << a << " and " << b << " at " << contact.begin_ns;
        }
      }
    }
    for (const CollisionEvent& event : events_) {
      if (!IsCertain(event)) continue;
      ++certain;
      const std::int64_t touching = event.begin.latest.nanoseconds();
      const auto all = ContactsOf(lives[event.lower.slot], lives[event.higher.slot]);
      EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                              [&](const BallContact& contact) {
                                return contact.begin_ns - kTolerance <= touching &&
                                       touching <= contact.end_ns + kTolerance;
                              }))
          << "seed " << seed << ": " << event.lower.slot << " and " << event.higher.slot << " at "
          << touching;
    }
  }
  EXPECT_GT(contacts, kSanitized ? 200 : 2000);
  EXPECT_GT(certain, contacts / 2);
}

/// A ball at rest at the origin, of which nothing has been heard since 0 s, and one that passes
/// through it from 3 to 4 s and leaves then; they touch from 3.25 to 3.75 s.
std::vector<CollisionEvent> EventsOfPassing(Instant still_until) {
  Detector detector({});
  const AgentDeclaration ball{.limits = {0.5, 0.01}};
  detector.Admit(Id(0), ball, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  detector.SetHeardUntil(OwnerOf(Id(0)), At(0), still_until);
  detector.Advance(At(0));
  detector.Admit(Id(1), ball, State(3, {-2, 0, 0}, {4, 0, 0}), At(10));
  motion::MotionState last = State(4, {2, 0, 0}, {4, 0, 0});
  last.expiry = last.stamp;
  detector.Update(Id(1), last, At(10));
  detector.Remove(Id(1));
  detector.Advance(At(10));
  return detector.events();
}

TEST(ShortLife, AContactWithOneThatMakesNoStepMeanwhileIsCertain) {
  const std::vector<CollisionEvent> events = EventsOfPassing(At(15));
  ASSERT_EQ(events.back().status, EventStatus::kEnded);
  EXPECT_LE(events.back().begin.earliest, At(3.25));
  EXPECT_GE(events.back().begin.latest, At(3.25));
  EXPECT_LE(events.back().begin.latest, At(3.3));
  EXPECT_LE(events.back().end.earliest, At(3.75));
  EXPECT_GE(events.back().end.latest, At(3.75));
}

TEST(ShortLife, WithOneThatMayHaveJumpedItIsADoubt) {
  const std::vector<CollisionEvent> events = EventsOfPassing(Instant::Always());
  ASSERT_EQ(events.back().status, EventStatus::kUndecided);
  EXPECT_LE(events.back().begin.earliest, At(3.25));
  EXPECT_GE(events.back().begin.earliest, At(3.2));
  EXPECT_GE(events.back().end.latest, At(3.75));
  EXPECT_LE(events.back().end.latest, At(3.8));
}

TEST(ShortLife, WhatTouchesForAnInstantOnlyIsADoubt) {
  for (const auto& [touches, jumps] :
       {std::pair(true, false), std::pair(false, false), std::pair(true, true)}) {
    Detector detector({});
    const AgentDeclaration ball{.limits = {0.5, 0.01}};
    detector.Admit(Id(0), ball, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
    // The second one jumps there, and is told again with its end.
    motion::MotionState only = State(5, {touches ? 0.75 : 3, 0, 0}, {0, 0, 0});
    if (jumps) {
      detector.Admit(Id(1), ball, State(4, {100, 0, 0}, {0, 0, 0}), At(10));
      only.discontinuity = true;
      detector.Update(Id(1), only, At(10));
      only.discontinuity = false;
    } else {
      detector.Admit(Id(1), ball, only, At(10));
    }
    only.expiry = only.stamp;
    detector.Update(Id(1), only, At(10));
    detector.Remove(Id(1));
    detector.Advance(At(10));
    if (!touches) {
      EXPECT_TRUE(detector.events().empty());
      continue;
    }
    ASSERT_FALSE(detector.events().empty());
    EXPECT_EQ(detector.events().back().status, EventStatus::kUndecided);
    EXPECT_EQ(detector.events().back().begin, (TimeBracket{At(5), At(5)}));
  }
}

INSTANTIATE_TEST_SUITE_P(Endings, ShortLives, testing::Values(Ending::kExpiry, Ending::kRemoval));

}  // namespace
}  // namespace collision::detection
