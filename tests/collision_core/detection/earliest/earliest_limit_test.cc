// Goal:   an answer that a limit cuts short is a lower bound of the exact one, costs no more than
//         the limit, and names an agent; where few agents are about equally near it is exact.
// Method: lattices and jittered lattices in two detectors alike, of which one has a limit.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

constexpr std::uint32_t kRow = 20, kAgents = kRow * kRow;
constexpr double kSpacing = 100, kStep = 1.0 / 8;
constexpr std::size_t kLimit = 16;
/// More than there are agents whose bounds come due in one step.
constexpr std::size_t kEnough = kAgents;
/// One agent's query, with the pair queries of all whom it may meet first, may be under way when
/// the limit is reached.
constexpr std::size_t kUnderWay = 1;

/// Agents at rest, M = 1 m/s²: two neighbours may meet after some 14 s.
class Lattice {
 public:
  Lattice(double jitter, std::uint64_t seed) : random_(seed) {
    for (std::uint32_t slot = 0; slot < kAgents; ++slot) {
      const Vector3d offset{random_.Uniform(-1, 1), random_.Uniform(-1, 1), 0};
      places_.push_back(kSpacing * Vector3d(slot % kRow, slot / kRow, 0) + jitter * offset);
      Both([&](Detector* detector) {
        detector->Admit(Id(slot), {.limits = {1, 1}}, StateOf(slot), At(0));
      });
    }
    Advance();
  }

  /// All tell their states; one in `jump_every` is elsewhere by chance.
  void Step(std::uint32_t jump_every = 0) {
    now_ += kStep;
    for (std::uint32_t slot = 0; slot < kAgents; ++slot) {
      motion::MotionState state = StateOf(slot);
      if (jump_every != 0 && random_.Below(jump_every) == 0) {
        places_[slot] = {random_.Uniform(0, kRow * kSpacing), random_.Uniform(0, kRow * kSpacing),
                         random_.Uniform(0, 50)};
        state = StateOf(slot);
        state.discontinuity = random_.Chance(0.5);  // otherwise a breach
      }
      Both([&](Detector* detector) { detector->Update(Id(slot), state, At(now_)); });
    }
    Advance();
  }

  Instant now() const { return At(now_); }
  double SecondsUntil(Instant when) const {
    return 1e-9 * static_cast<double>(when.nanoseconds() - now().nanoseconds());
  }
  EarliestAnswer Exact() const { return exact_.Earliest(); }
  EarliestAnswer Limited(std::size_t limit = kLimit) const { return limited_.Earliest(limit); }
  std::uint64_t queries() const { return limited_.counters().queries; }

 private:
  motion::MotionState StateOf(std::uint32_t slot) const {
    return State(now_, places_[slot], {0, 0, 0});
  }

  template <typename Call>
  void Both(Call call) {
    call(&exact_);
    call(&limited_);
  }

  void Advance() {
    Both([&](Detector* detector) {
      for (std::uint32_t slot = 0; slot < kAgents; ++slot) {
        detector->SetHeardUntil(OwnerOf(Id(slot)), At(now_));
      }
      detector->Advance(At(now_));
      detector->Validate();
    });
  }

  Random random_;
  Detector exact_{{}}, limited_{{}};
  std::vector<Vector3d> places_;
  double now_ = 0;
};

TEST(EarliestLimit, ALatticeCostsTheLimitAndGivesALowerBound) {
  Lattice lattice(0, 1);
  double last_share = 0;
  for (int step = 0; step < 100; ++step) {
    const EarliestAnswer exact = lattice.Exact();
    const std::uint64_t before = lattice.queries();
    const EarliestAnswer limited = lattice.Limited();
    ASSERT_LE(lattice.queries() - before, kLimit + kUnderWay);
    ASSERT_TRUE(exact.found && limited.found);
    ASSERT_LE(limited.earliest, exact.earliest) << step;
    ASSERT_GE(limited.earliest, lattice.now()) << step;
    ASSERT_LE(limited.lower, limited.higher);
    last_share = lattice.SecondsUntil(limited.earliest) / lattice.SecondsUntil(exact.earliest);
    lattice.Step();
  }
  // The bounds are refreshed in turn: each is at most kAgents / kLimit calls old.
  EXPECT_GT(last_share, 1 - 1.1 * kAgents / kLimit * kStep / std::sqrt(kSpacing - 2));
}

TEST(EarliestLimit, WhereNoneTieTheAnswerIsSoonExact) {
  Lattice lattice(20, 2);
  // At first only the keys are known.
  for (int call = 0; call < 20; ++call) {
    ASSERT_LE(lattice.Limited(kEnough).earliest, lattice.Exact().earliest);
  }
  for (int step = 0; step < 100; ++step) {
    const EarliestAnswer exact = lattice.Exact(), limited = lattice.Limited(kEnough);
    ASSERT_EQ(limited.earliest, exact.earliest) << step;
    ASSERT_EQ(limited.lower, exact.lower) << step;
    ASSERT_EQ(limited.higher, exact.higher) << step;
    lattice.Step();
  }
}

TEST(EarliestLimit, IsNeverLateWhereAgentsJumpAndBreakTheirBounds) {
  int cut_short = 0, exact_answers = 0;
  for (const std::uint64_t seed : {3u, 4u, 5u}) {
    Lattice lattice(5, seed);
    for (int step = 0; step < 150; ++step) {
      lattice.Step(200);
      const EarliestAnswer exact = lattice.Exact(), limited = lattice.Limited();
      ASSERT_LE(limited.earliest, exact.earliest) << seed << ", " << step;
      ++(limited.earliest == exact.earliest ? exact_answers : cut_short);
    }
  }
  EXPECT_GT(cut_short, 0);
  EXPECT_GT(exact_answers, 100);
}

}  // namespace
}  // namespace collision::detection
