// Goal:   a crowd costs in proportion to what is published about it: contacts that cannot end are
//         not evaluated, those that may end take a glance, a saturated agent costs one pair query;
//         and no event comes later because of that.
// Method: counted work; many contacts at once against each of them alone.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

struct Crowd {
  Crowd(std::uint32_t count, std::uint32_t pairs_max) : agents(count) {
    DetectorOptions options;
    options.agents_max = agents;
    options.pairs_max = pairs_max;
    detector.emplace(options);
    for (std::uint32_t slot = 0; slot < agents; ++slot) {
      detector->Admit(Id(slot), {.limits = {.radius = 1, .acceleration_max = 1}},
                      State(0, {0, 0, 0}, {0, 0, 0}), At(0));
    }
    Step(0);
  }

  /// Every `every`-th agent has a new state; the time heard advances for all.
  void Step(std::uint32_t every) {
    const double now = step / 64.0;
    for (std::uint32_t slot = 0; slot < agents; ++slot) {
      if (every > 0 && slot % every == step % every) {
        detector->Update(Id(slot), State(now, {0, 0, 0}, {0, 0, 0}), At(now));
      }
      detector->SetHeardUntil(OwnerOf(Id(slot)), At(now));
    }
    detector->Advance(At(now));
    if (step % 16 == 0) detector->Validate();
    confirmed += std::count_if(
        detector->events().begin(), detector->events().end(),
        [](const CollisionEvent& event) { return event.status == EventStatus::kConfirmed; });
    ++step;
  }

  std::uint32_t agents;
  std::uint32_t step = 0;
  std::ptrdiff_t confirmed = 0;
  std::optional<Detector> detector;
};

// Each is queried again after 1/8 to 1/4 s, though all of them became saturated at once.
TEST(ACrowd, IsNotQueriedInOneStep) {
  constexpr std::uint32_t kAgents = 256;
  Crowd crowd(kAgents, 10);
  for (int i = 0; i < 64; ++i) crowd.Step(0);
  const std::uint64_t before = crowd.detector->counters().queries;
  std::uint64_t most = 0;
  for (int i = 0; i < 64; ++i) {
    const std::uint64_t queries = crowd.detector->counters().queries;
    crowd.Step(0);
    most = std::max(most, crowd.detector->counters().queries - queries);
  }
  EXPECT_LE(most, kAgents / 2);
  EXPECT_GE(crowd.detector->counters().queries - before, 3 * kAgents);
}

// In two seconds each contact is judged ten times or so, not 128 times.
TEST(ACrowd, ContactsThatCannotEndRest) {
  constexpr std::uint32_t kPairs = 4000;
  Crowd crowd(300, kPairs);
  for (int i = 0; i < 4; ++i) crowd.Step(0);
  ASSERT_EQ(crowd.confirmed, kPairs);
  const DetectorCounters before = crowd.detector->counters();
  std::uint64_t most = 0;
  for (int i = 0; i < 128; ++i) {
    const std::uint64_t segments = crowd.detector->counters().segments;
    crowd.Step(0);
    most = std::max(most, crowd.detector->counters().segments - segments);
  }
  const DetectorCounters& after = crowd.detector->counters();
  EXPECT_LT(after.segments - before.segments, 20 * kPairs);
  EXPECT_GT(after.segments - before.segments, 5 * kPairs);
  // Not all in the same step.
  EXPECT_LT(most, kPairs * 3 / 4);
  EXPECT_EQ(crowd.confirmed, kPairs);
  EXPECT_TRUE(crowd.detector->ClearanceOf(Id(0))->in_contact);
}

// Contacts of an agent with a new state are evaluated: two segments each, mostly at a glance.
TEST(ACrowd, ANewStateHasItsContactsEvaluatedAtAGlance) {
  constexpr std::uint32_t kPairs = 4000;
  Crowd crowd(300, kPairs);
  for (int i = 0; i < 64; ++i) crowd.Step(16);
  const DetectorCounters before = crowd.detector->counters();
  for (int i = 0; i < 64; ++i) crowd.Step(16);
  const DetectorCounters& after = crowd.detector->counters();
  const std::uint64_t segments = after.segments - before.segments;
  EXPECT_LT(segments, 64 * kPairs);
  EXPECT_GT(after.quick_segments - before.quick_segments, 0.95 * static_cast<double>(segments));
}

// Eight times in a second each agent without room is queried again. A query of the broad phase
// would find all others.
TEST(ACrowd, ASaturatedAgentIsQueriedAtTheCostOfOnePair) {
  constexpr std::uint32_t kAgents = 2000;
  Crowd crowd(kAgents, 600);
  ASSERT_TRUE(crowd.detector->ClearanceOf(Id(kAgents - 1))->saturated);
  // Those before the table was full did find all.
  EXPECT_LT(crowd.detector->counters().filter_tests, 20 * kAgents);
  const DetectorCounters before = crowd.detector->counters();
  for (int i = 0; i < 64; ++i) crowd.Step(0);
  const DetectorCounters& after = crowd.detector->counters();
  EXPECT_GT(after.queries - before.queries, 2 * kAgents);
  EXPECT_LT(after.filter_tests - before.filter_tests, kAgents);
  EXPECT_LT(after.pair_queries - before.pair_queries, 10 * kAgents);
  EXPECT_TRUE(crowd.detector->ClearanceOf(Id(kAgents - 1))->saturated);
  // An agent that jumps away from the crowd has no partner in its way, and needs no room.
  motion::MotionState away = State(1, {1e6, 0, 0}, {0, 0, 0});
  away.discontinuity = true;
  crowd.detector->Update(Id(kAgents - 2), away, At(1));
  crowd.Step(0);
  EXPECT_FALSE(crowd.detector->ClearanceOf(Id(kAgents - 2))->saturated);
  EXPECT_FALSE(crowd.detector->ClearanceOf(Id(kAgents - 2))->not_clear);
  // Once the others go away, the agent gets a full query.
  for (std::uint32_t slot = 0; slot + 1 < kAgents; ++slot) crowd.detector->Remove(Id(slot));
  for (int i = 0; i < 64; ++i) crowd.Step(0);
  EXPECT_FALSE(crowd.detector->ClearanceOf(Id(kAgents - 1))->saturated);
  EXPECT_FALSE(crowd.detector->ClearanceOf(Id(kAgents - 1))->not_clear);
}

// Agents jump into a crowd and out of it: each saturated agent has a clearance of now, and counts
// for the earliest intersection, which is that of the lowest ids; no other agent does.
TEST(ACrowd, ASaturatedAgentCountsHoweverOthersComeAndGo) {
  constexpr std::uint32_t kAgents = 24;
  DetectorOptions options;
  options.pairs_max = 4;
  Detector detector(options);
  Random random(9);
  const auto place = [&](std::uint32_t slot, bool inside, double now) {
    motion::MotionState state = State(now, {inside ? 0 : 1e5 * (slot + 1), 0, 0}, {0, 0, 0});
    state.discontinuity = true;
    return state;
  };
  for (std::uint32_t slot = 0; slot < kAgents; ++slot) {
    detector.Admit(Id(slot), {.limits = {.radius = 1, .acceleration_max = 0.1}},
                   place(slot, true, 0), At(0));
  }
  std::size_t saturated = 0, all_clear = 0, fresh = 0;
  for (int step = 1; step <= 600; ++step) {
    const double now = step / 64.0;
    for (int k = 0; k < 3; ++k) {
      const auto slot = static_cast<std::uint32_t>(random.Below(kAgents));
      detector.Update(Id(slot), place(slot, random.Chance(step % 100 < 60 ? 0.8 : 0.02), now),
                      At(now));
    }
    detector.Advance(At(now));
    if (step % 16 == 0) detector.Validate();
    std::set<std::uint32_t> told;
    for (const AgentClearance& clearance : detector.TakeChangedClearances()) {
      if (clearance.saturated) told.insert(clearance.agent.slot);
    }
    std::size_t now_saturated = 0;
    std::uint32_t lowest = kAgents;
    bool any_not_clear = false;
    for (std::uint32_t slot = 0; slot < kAgents; ++slot) {
      const AgentClearance clearance = *detector.ClearanceOf(Id(slot));
      if (clearance.saturated && now_saturated++ == 0) lowest = slot;
      // An agent that may have touched before now had an earlier clearance.
      const bool news = clearance.saturated && clearance.clear_until == At(now);
      if (news) {
        ASSERT_TRUE(told.contains(slot)) << slot << " at " << step;
      }
      if (told.contains(slot)) {
        ASSERT_TRUE(clearance.saturated) << slot << " at " << step;
      }
      fresh += news;
      any_not_clear |= clearance.not_clear;
    }
    const EarliestAnswer earliest = detector.Earliest();
    if (now_saturated > 0) {
      ASSERT_EQ(earliest.earliest, At(now));
      // Equal times: the pair with the lowest ids.
      ASSERT_LE(earliest.lower.slot, lowest);
    } else if (!any_not_clear) {
      ASSERT_GT(earliest.earliest, At(now));
      ++all_clear;
    }
    saturated += now_saturated;
  }
  EXPECT_GT(saturated, 600u);
  EXPECT_GT(fresh, 200u);
  EXPECT_GT(all_clear, 20u);
}

// Pairs far from each other that overlap at first and go apart, some at once and some in seconds;
// some agents have new states now and then.
struct Couples {
  Couples(std::uint32_t begin, std::uint32_t end) : first(begin), last(end) {
    DetectorOptions options;
    options.agents_max = 2 * (last - first);
    detector.emplace(options);
    for (std::uint32_t couple = first; couple < last; ++couple) {
      for (const bool second : {false, true}) {
        detector->Admit(Id(2 * couple + second),
                        {.limits = {.radius = 1, .acceleration_max = Max(couple)}},
                        At(couple, second, 0), collision::At(0));
      }
    }
  }

  static double Max(std::uint32_t couple) { return couple % 3 == 0 ? 0 : 0.02; }

  motion::MotionState At(std::uint32_t couple, bool second, double t) const {
    Random random(couple);
    const Vector3d p(1000.0 * couple, 0, 0), v = random.UnitVector() * random.Uniform(0, 3);
    if (!second) return State(t, p + t * v, v);
    const Vector3d d = random.UnitVector() * random.Uniform(0, 1.9);
    const Vector3d w = random.UnitVector() * random.LogUniform(0.3, 10);
    return State(t, p + d + t * (v + w), v + w);
  }

  /// What was published about each couple in this step.
  void Step() {
    const double now = step / 64.0;
    for (std::uint32_t couple = first; couple < last; ++couple) {
      for (const bool second : {false, true}) {
        const std::uint32_t slot = 2 * couple + second;
        if (slot % 4 < 3 && (step + slot) % 40 == 0) {
          detector->Update(Id(slot), At(couple, second, now), collision::At(now));
        }
        detector->SetHeardUntil(OwnerOf(Id(slot)), collision::At(now));
      }
    }
    detector->Advance(collision::At(now));
    if (step % 16 == 0) detector->Validate();
    for (const CollisionEvent& event : detector->events()) {
      log[event.lower.slot / 2].push_back(
          {step, static_cast<std::int64_t>(event.status), event.begin.earliest.nanoseconds(),
           event.begin.latest.nanoseconds(), event.end.earliest.nanoseconds(),
           event.end.latest.nanoseconds(), event.continuous});
    }
    for (const AgentClearance& told : detector->TakeChangedClearances()) {
      const std::vector<std::int64_t> contact = {told.agent.slot, told.in_contact, told.not_clear,
                                                 told.unsettled_until.nanoseconds()};
      std::vector<std::int64_t>& before = contacts[told.agent.slot];
      if (contact == before) continue;
      log[told.agent.slot / 2].push_back(contact);
      log[told.agent.slot / 2].push_back({step});
      before = contact;
    }
    ++step;
  }

  std::uint32_t first, last;
  std::uint32_t step = 0;
  std::map<std::uint32_t, std::vector<std::int64_t>> contacts;          // by agent: as last told
  std::map<std::uint32_t, std::vector<std::vector<std::int64_t>>> log;  // by couple
  std::optional<Detector> detector;
};

TEST(ACrowd, AContactThatRestsIsPublishedWhenItEnds) {
  constexpr std::uint32_t kCouples = 600;
  constexpr int kSteps = 6 * 64;
  Couples all(0, kCouples);
  for (int i = 0; i < kSteps; ++i) all.Step();
  int ended = 0;
  std::uint64_t segments = 0;
  for (std::uint32_t couple = 0; couple < kCouples; ++couple) {
    Couples alone(couple, couple + 1);
    for (int i = 0; i < kSteps; ++i) alone.Step();
    ASSERT_EQ(all.log[couple], alone.log[couple]) << couple;
    for (const auto& told : alone.log[couple]) {
      ended += told.size() == 7 && told[1] == static_cast<std::int64_t>(EventStatus::kEnded);
    }
    segments += alone.detector->counters().segments;
  }
  EXPECT_GT(ended, kCouples * 9 / 10);
  EXPECT_LT(all.detector->counters().segments, segments * 9 / 10);
}

}  // namespace
}  // namespace collision::detection
