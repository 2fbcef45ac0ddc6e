// Goal:   a step costs what has changed and what is due, an update inside its bound nothing; and
//         the results of long histories are those computed from scratch.
// Method: counted work and counted allocations; random histories of everything that can happen to
//         an agent, against every pair computed anew, with every method of the broad phase.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/numeric/seconds.h"
#include "tests/collision_core/broad_phase/draw_filter.h"
#include "tests/collision_core/detection/allocations.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"

namespace collision::detection {
namespace {

Instant Exactly(std::int64_t ns) { return Instant::FromNanoseconds(ns); }

// Agents far apart near a lattice; each has a new state once a second, at its own time.
class Lattice {
 public:
  Lattice(std::uint32_t side, double spacing) : side_(side), spacing_(spacing) {
    DetectorOptions options;
    options.agents_max = side * side;
    detector.emplace(options);
    for (std::uint32_t slot = 0; slot < side * side; ++slot) {
      detector->Admit(Id(slot), {.limits = {.radius = 1, .acceleration_max = 0.01}},
                      StateOf(slot, At(0)), At(0));
    }
  }

  motion::MotionState StateOf(std::uint32_t slot, Instant t) const {
    motion::MotionState state;
    state.stamp = t;
    // Off the lattice, so that no two are equally near to a third.
    Random random(slot);
    state.p_WA = {spacing_ * (slot % side_), spacing_ * (slot / side_),
                  random.Uniform(0, spacing_)};
    return state;
  }

  /// A sixtieth of the agents have new states; returns what the updates allocated.
  std::size_t Step() {
    ++step_;
    const Instant now = Exactly(step_ * 1'000'000'000 / 60);
    const std::size_t before = Allocations();
    for (auto slot = static_cast<std::uint32_t>(step_ % 60); slot < side_ * side_; slot += 60) {
      EXPECT_EQ(detector->Update(Id(slot), StateOf(slot, now), now), UpdateOutcome::kKept);
      detector->SetHeardUntil(OwnerOf(Id(slot)), now);
    }
    const std::size_t allocated = Allocations() - before;
    detector->Advance(now);
    if (step_ % 16 == 0) detector->Validate();
    detector->TakeChangedClearances();
    detector->Earliest();
    return allocated;
  }

  std::optional<Detector> detector;

 private:
  std::uint32_t side_;
  double spacing_;
  std::int64_t step_ = 0;
};

TEST(Incremental, AKeptUpdateAllocatesNothing) {
  Lattice lattice(30, 1000);
  for (int i = 0; i < 4 * 60; ++i) lattice.Step();
  for (int i = 0; i < 2 * 60; ++i) EXPECT_EQ(lattice.Step(), 0u);
  EXPECT_EQ(lattice.detector->counters().updates_kept, 6u * 900);
}

// Two seconds in which nothing comes near: no agent is queried except for the earliest of all,
// which gets later with every state. A walk over all agents or pairs would show as 2500 a step.
TEST(Incremental, AStepCostsWhatIsDue) {
  Lattice lattice(50, 1000);
  lattice.detector->Advance(At(0));
  lattice.detector->Earliest();
  const DetectorCounters first = lattice.detector->counters();
  EXPECT_EQ(first.queries, 2500u);
  for (int i = 0; i < 120; ++i) lattice.Step();
  const DetectorCounters& later = lattice.detector->counters();
  EXPECT_EQ(later.updates_kept, 2u * 2500);
  EXPECT_LT(later.queries - first.queries, 120u * 60);
  EXPECT_EQ(lattice.detector->pairs_tracked(), 0u);
}

// The output of 10,000 agents at one point is: each is saturated. Asking about every pair would be
// 50 million queries; tracked are no more pairs than there is room for, and asking goes no
// further.
TEST(Incremental, ACrowdAtOnePointCostsWhatIsPublished) {
  const std::uint32_t agents = kSanitized ? 1000 : 10000;
  DetectorOptions options;
  options.agents_max = agents;
  options.pairs_max = 1000;
  options.pairs_per_agent_max = 16;
  Detector detector(options);
  for (std::uint32_t slot = 0; slot < agents; ++slot) {
    detector.Admit(Id(slot), {.limits = {.radius = 1, .acceleration_max = 1}},
                   State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  }
  detector.Advance(At(0));
  const std::vector<AgentClearance> told = detector.TakeChangedClearances();
  ASSERT_EQ(told.size(), agents);
  for (const AgentClearance& clearance : told) {
    EXPECT_TRUE(clearance.saturated);
    EXPECT_TRUE(clearance.not_clear);
    EXPECT_LE(clearance.clear_until, At(0));
  }
  EXPECT_LE(detector.pairs_tracked(), 1000u);
  // With few agents the tracked pairs are a larger part; all pairs would be half the square.
  const std::uint64_t most = (kSanitized ? 200u : 40u) * agents;
  EXPECT_LT(detector.counters().pair_queries, most);
  EXPECT_EQ(detector.Earliest().earliest, At(0));
  const std::uint64_t before = detector.counters().pair_queries;
  for (int step = 1; step <= 20; ++step) {
    detector.Advance(At(step / 64.0));
    detector.Earliest();
  }
  detector.Validate();
  // One more query for each finds whether it is still saturated.
  EXPECT_LT(detector.counters().pair_queries - before,
            20u * 3 * 1000 + (kSanitized ? 40u : 10u) * agents);
}

// What cannot be tracked counts for the earliest intersection as well.
TEST(Incremental, TheEarliestCountsSaturatedAgents) {
  DetectorOptions options;
  options.pairs_per_agent_max = 1;
  Detector detector(options);
  detector.Admit(Id(1), {.limits = {.radius = 1}}, State(0, {0, 0, 0}, {1, 0, 0}), At(0));
  detector.Admit(Id(2), {.limits = {.radius = 1}}, State(0, {3, 0, 0}, {0, 0, 0}), At(0));
  detector.Advance(At(0));
  EXPECT_EQ(detector.Earliest().higher, Id(2));
  detector.Admit(Id(3), {.limits = {.radius = 1}}, State(0, {-2.5, 0, 0}, {2, 0, 0}), At(0));
  detector.Advance(At(0));
  const EarliestAnswer earliest = detector.Earliest();
  EXPECT_TRUE(detector.ClearanceOf(Id(1))->saturated);
  EXPECT_TRUE(detector.ClearanceOf(Id(3))->saturated);
  EXPECT_EQ(earliest.earliest, At(0));
  EXPECT_EQ(earliest.lower, Id(1));
  EXPECT_EQ(earliest.higher, Id(3));
}

// Among intersections at equal times, the pair with the lowest ids is the earliest, even though
// neither of its agents is the partner that the other one's key names.
TEST(Incremental, EqualMeetingsGoByTheIds) {
  Detector detector{DetectorOptions{}};
  const std::pair<std::uint32_t, double> places[] = {{8, 0}, {9, 300}, {1, 100}, {2, 200}};
  for (const auto& [slot, x] : places) {
    detector.Admit(Id(slot), {.limits = {.radius = 1, .acceleration_max = 1}},
                   State(0, {x, 0, 0}, {0, 0, 0}), At(0));
  }
  detector.Advance(At(0));
  const EarliestAnswer earliest = detector.Earliest();
  EXPECT_EQ(earliest.lower, Id(1));
  EXPECT_EQ(earliest.higher, Id(2));
}

// Everything that can happen to an agent, at random; with what is known of each, for the oracle.
class RandomHistory {
 public:
  RandomHistory(std::uint64_t seed, double box, broad_phase::BroadPhaseMethod method,
                bool assemblies = false)
      : random_(seed), box_(box), assemblies_(assemblies) {
    DetectorOptions options;
    options.broad_phase = method;
    detector_.emplace(options);
  }

  void Step(int agents_wanted) {
    now_ += 1'000'000'000 / 32;
    const Instant now = Exactly(now_);
    while (static_cast<int>(known_.size()) < agents_wanted) Admit(now);
    const std::vector<std::uint32_t> slots = Slots();
    for (const std::uint32_t slot : slots) {
      if (random_.Chance(0.3)) SendState(slot, now);
      if (random_.Chance(0.002)) {
        detector_->Remove(Id(slot));
        known_.erase(slot);
      }
    }
    for (const auto& [slot, bound] : known_) detector_->SetHeardUntil(OwnerOf(Id(slot)), now);
    detector_->Advance(now);
    detector_->Validate();
    for (const AgentClearance& told : detector_->TakeChangedClearances()) {
      clearances_[told.agent.slot] = told;
      log_.push_back(told.clear_until.nanoseconds());
    }
    for (const CollisionEvent& event : detector_->events()) {
      log_.insert(log_.end(), {static_cast<std::int64_t>(event.status), event.lower.slot,
                               event.higher.slot, event.begin.earliest.nanoseconds()});
    }
  }

  /// No clearance is later than any meeting, and the earliest of all is the one from scratch.
  void Compare() {
    const Instant now = Exactly(now_);
    EarliestAnswer scratch;
    bool contact = false;
    bool unsure = false;
    for (const auto& [slot, bound] : known_) {
      contact |= clearances_.at(slot).in_contact;
      unsure |= clearances_.at(slot).not_clear;
    }
    // Every change was published.
    for (const auto& [slot, bound] : known_) {
      const AgentClearance clearance = *detector_->ClearanceOf(Id(slot));
      ASSERT_EQ(clearances_.at(slot).clear_until, clearance.clear_until) << slot;
      ASSERT_EQ(clearances_.at(slot).in_contact, clearance.in_contact) << slot;
    }
    for (auto a = known_.begin(); a != known_.end(); ++a) {
      for (auto b = std::next(a); b != known_.end(); ++b) {
        const Instant when = EarliestIntersection(a->second, b->second, now).instant();
        if (when.is_never()) continue;
        // What an older state certified may be later than the canonical answer by its rounding.
        const Instant rounded = numeric::AddRoundedUp(when, 2e-9);
        for (const std::uint32_t slot : {a->first, b->first}) {
          const AgentClearance& told = clearances_.at(slot);
          ASSERT_TRUE(told.clear_until <= rounded || told.in_contact)
              << a->first << "-" << b->first << " at " << now_ << " told "
              << told.clear_until.nanoseconds() << " may meet " << when.nanoseconds();
        }
        if (when < scratch.earliest) scratch = {true, when, Id(a->first), Id(b->first)};
      }
    }
    const EarliestAnswer kept = detector_->Earliest();
    log_.push_back(kept.earliest.nanoseconds());
    if (contact) return;
    ASSERT_LE(kept.earliest, scratch.earliest) << now_;
    if (unsure) return;  // something may touch for what came before the newest states
    ++compared_;
    ASSERT_EQ(kept.found, scratch.found) << now_;
    ASSERT_EQ(kept.earliest, scratch.earliest) << now_;
    ASSERT_EQ(kept.lower, scratch.lower) << now_;
    ASSERT_EQ(kept.higher, scratch.higher) << now_;
  }

  int compared() const { return compared_; }
  const std::vector<std::int64_t>& log() const { return log_; }
  const DetectorCounters& counters() const { return detector_->counters(); }

 private:
  std::vector<std::uint32_t> Slots() const {
    std::vector<std::uint32_t> slots;
    for (const auto& [slot, bound] : known_) slots.push_back(slot);
    return slots;
  }

  Vector3d Place() {
    return {random_.Uniform(0, box_), random_.Uniform(0, box_), random_.Uniform(0, box_)};
  }

  AgentDeclaration Declaration() {
    AgentDeclaration declaration;
    declaration.limits.radius = random_.LogUniform(0.1, 4);
    declaration.limits.acceleration_max = random_.Chance(0.3) ? 0 : random_.LogUniform(0.01, 5);
    if (random_.Chance(0.2)) declaration.limits.speed_max = 20;
    if (random_.Chance(0.2)) declaration.filter.mask = 1u << random_.Below(2);
    if (assemblies_) declaration.filter = broad_phase::DrawFilter(&random_);
    return declaration;
  }

  void Admit(Instant now) {
    const std::uint32_t slot = slots_++;
    motion::MotionState state;
    state.stamp = now;
    state.p_WA = Place();
    state.v_WA = random_.UnitVector() * random_.Uniform(0, 8);
    const AgentDeclaration declaration = Declaration();
    ASSERT_TRUE(detector_->Admit(Id(slot), declaration, state, now));
    known_[slot] = {motion::SpaceTimeBound{state, declaration.limits, 0}, declaration.filter};
  }

  void SendState(std::uint32_t slot, Instant now) {
    motion::SpaceTimeBound& bound = known_[slot].bound;
    const double s = numeric::SecondsBetween(bound.state.stamp, now).middle();
    const double pull = 0.9 * bound.limits.acceleration_max;
    const Vector3d a = random_.UnitVector() * random_.Uniform(0, pull);
    motion::MotionState state = bound.state;
    state.stamp = now;
    state.p_WA += state.v_WA * s + a * (s * s / 2);
    state.v_WA += a * s;
    const double cap = bound.limits.speed_max;
    if (state.v_WA.norm() > cap) state.v_WA *= 0.999 * cap / state.v_WA.norm();
    state.discontinuity = false;
    if (random_.Chance(0.01)) {
      state.p_WA = Place();
      state.discontinuity = true;
    } else if (random_.Chance(0.01)) {
      state.v_WA = random_.UnitVector() * random_.Uniform(0, 8);  // a breach, most likely
    } else if (random_.Chance(0.01)) {
      state.position_error = random_.Uniform(0, 0.5);
    }
    if (random_.Chance(0.01)) {
      const AgentDeclaration declaration = Declaration();
      known_[slot] = {motion::SpaceTimeBound{bound.state, declaration.limits, 0},
                      declaration.filter};
      detector_->Redeclare(Id(slot), declaration, now);
    }
    detector_->Update(Id(slot), state, now);
    bound.state = state;
  }

  Random random_;
  const double box_;
  const bool assemblies_;
  std::optional<Detector> detector_;
  std::map<std::uint32_t, broad_phase::AgentBound> known_;
  std::map<std::uint32_t, AgentClearance> clearances_;
  std::vector<std::int64_t> log_;
  std::int64_t now_ = 0;
  std::uint32_t slots_ = 0;
  int compared_ = 0;
};

void ExpectHistoriesLikeScratch(bool assemblies) {
  const int steps = kSanitized ? 60 : 600;
  for (const double box : {60, 150, 400}) {
    std::optional<std::vector<std::int64_t>> log;
    for (const broad_phase::BroadPhaseMethod method :
         {broad_phase::BroadPhaseMethod::kAllPairs, broad_phase::BroadPhaseMethod::kSpatialIndex,
          broad_phase::BroadPhaseMethod::kExhaustive, broad_phase::BroadPhaseMethod::kAuto}) {
      SCOPED_TRACE(Name(method));
      RandomHistory history(static_cast<std::uint64_t>(box), box, method, assemblies);
      for (int step = 0; step < steps; ++step) {
        history.Step(40);
        history.Compare();
        if (testing::Test::HasFatalFailure()) return;
      }
      if (!log) {
        log = history.log();
        EXPECT_GT(history.compared(), steps / 10);
        EXPECT_GT(history.counters().jumps, 5u);
        EXPECT_GT(history.counters().breaches, 5u);
        EXPECT_GT(history.counters().widenings, kSanitized ? 2u : 5u);
        EXPECT_GT(history.counters().updates_kept, 500u);
      }
      EXPECT_EQ(history.log(), *log);
    }
  }
}

TEST(Incremental, LongHistoriesEqualScratchWithEveryMethod) { ExpectHistoriesLikeScratch(false); }

TEST(Incremental, LongHistoriesWithAssembliesAndListsEqualScratchWithEveryMethod) {
  ExpectHistoriesLikeScratch(true);
}

// An agent whose owner was granted more time has jumped away in the future; before that it crosses
// the place where another one appears now. The contact lies before its newest state.
TEST(Incremental, AnAgentThatJumpsAheadIsMetBeforeItsJump) {
  Detector detector{DetectorOptions{}};
  const AgentDeclaration ball{.limits = {.radius = 1}};
  detector.Admit(Id(1), ball, State(0, {-8, 0, 0}, {8, 0, 0}), At(0));
  detector.Admit(Id(2), ball, State(0, {0, 5000, 0}, {0, 0, 0}), At(0));
  detector.Advance(At(0));
  motion::MotionState away = State(3, {9000, 0, 0}, {8, 0, 0});
  away.discontinuity = true;
  detector.Update(Id(1), away, At(3));
  detector.SetHeardUntil(OwnerOf(Id(1)), At(3));
  motion::MotionState here = State(0.25, {0, 0, 0}, {0, 0, 0});
  here.discontinuity = true;
  detector.Update(Id(2), here, At(0.25));
  detector.SetHeardUntil(OwnerOf(Id(2)), At(0.25));
  detector.Advance(At(0.25));
  EXPECT_LE(detector.ClearanceOf(Id(2))->clear_until, At(0.75));
  detector.SetHeardUntil(OwnerOf(Id(2)), At(3));
  std::vector<CollisionEvent> events = detector.events();
  for (const double now : {1.0, 2.0, 3.0}) {
    detector.Advance(At(now));
    events.insert(events.end(), detector.events().begin(), detector.events().end());
  }
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const CollisionEvent& event) {
    return event.status == EventStatus::kConfirmed && event.begin.earliest <= At(0.75) &&
           At(0.75) <= event.begin.latest;
  }));
}

// Likewise with a partner whose states lie ahead: it passes the place before its newest state.
TEST(Incremental, AStateAheadIsMetBeforeIt) {
  Detector detector{DetectorOptions{}};
  const AgentDeclaration ball{.limits = {.radius = 1}};
  detector.Admit(Id(1), ball, State(0, {-8, 0, 0}, {8, 0, 0}), At(0));
  detector.Admit(Id(2), ball, State(0, {0, 5000, 0}, {0, 0, 0}), At(0));
  detector.Advance(At(0));
  detector.Update(Id(1), State(3, {16, 0, 0}, {8, 0, 0}), At(3));
  detector.SetHeardUntil(OwnerOf(Id(1)), At(3));
  motion::MotionState here = State(0.25, {0, 0, 0}, {0, 0, 0});
  here.discontinuity = true;
  detector.Update(Id(2), here, At(0.25));
  detector.SetHeardUntil(OwnerOf(Id(2)), At(0.25));
  detector.Advance(At(0.25));
  EXPECT_LE(detector.ClearanceOf(Id(2))->clear_until, At(0.75));
  // An agent that passes elsewhere changes nothing.
  EXPECT_EQ(detector.pairs_tracked(), 1u);
}

// An owner that was granted much time reports where its agent will be long after it has passed
// another one, which is queried first. The time before that state begins more than announce_within
// earlier, and is not forgotten.
TEST(Incremental, AStateFarAheadIsMetBeforeIt) {
  Detector detector{DetectorOptions{}};
  detector.Admit(Id(1), {.limits = {.radius = 1, .acceleration_max = 1}},
                 State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  detector.Admit(Id(2), {.limits = {.radius = 1}}, State(0, {-80, 5, 0}, {8, 0, 0}), At(0));
  detector.Advance(At(0));
  detector.Advance(At(1));
  EXPECT_EQ(detector.Update(Id(2), State(12, {16, 5, 0}, {8, 0, 0}), At(12)), UpdateOutcome::kKept);
  for (int step = 4; step < 40; ++step) {
    detector.Advance(At(step / 4.0));
    // At 10 s it is 3 m away, where the other one can be since 2.5 s.
    EXPECT_LE(detector.ClearanceOf(Id(1))->clear_until, At(10)) << step;
    EXPECT_LE(detector.ClearanceOf(Id(2))->clear_until, At(10)) << step;
  }
}

// A teleport with a clock that may be off concerns near agents, not all of them.
TEST(Incremental, ATeleportWithSkewTracksOnlyNearAgents) {
  DetectorOptions options;
  options.skew = 0.01;
  Detector detector(options);
  for (std::uint32_t slot = 0; slot < 400; ++slot) {
    detector.Admit(Id(slot), {.limits = {.radius = 1}}, State(0, {100.0 * slot, 0, 0}, {0, 1, 0}),
                   At(0));
  }
  detector.Advance(At(0));
  EXPECT_EQ(detector.pairs_tracked(), 0u);
  motion::MotionState jump = State(1, {10001, 1, 0}, {0, 1, 0});
  jump.discontinuity = true;
  detector.Update(Id(7), jump, At(1));
  detector.Advance(At(1));
  EXPECT_EQ(detector.pairs_tracked(), 1u);
  EXPECT_TRUE(detector.ClearanceOf(Id(100))->not_clear);
  EXPECT_FALSE(detector.ClearanceOf(Id(200))->not_clear);
}

}  // namespace
}  // namespace collision::detection
