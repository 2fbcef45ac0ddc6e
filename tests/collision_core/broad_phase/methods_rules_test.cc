// Goal:   excluded pairs, margins and half-spaces: every method gives the same answer, same pair,
//         same bits, and what is not used costs nothing.
// Method: seeded scenes of all kinds through histories in which agents, half-spaces and rules come,
//         change and go and indices are used again; beside a plain table that asks the canonical
//         routines for every pair. Work is compared as counted.
#include <gtest/gtest.h>

#include <set>

#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "collision_core/numeric/seconds.h"
#include "tests/collision_core/broad_phase/rules_table.h"
#include "tests/support/sanitized.h"

namespace collision::broad_phase {
namespace {

constexpr int kHistories = kSanitized ? 1 : 4;
constexpr int kSteps = 40;

std::vector<std::string> Texts(const std::vector<Neighbour>& meetings) {
  std::vector<std::string> texts;
  for (const Neighbour& meeting : meetings) {
    texts.push_back(Text(intersection::IntersectingPair{meeting.partner, 0, meeting.time}));
  }
  return texts;
}

/// Queries about one agent and, with `of_all`, about all: those place all agents anew, the others
/// do not.
void ExpectAlike(const RulesTable& table, SweepingIndex& method, Instant now, bool of_all,
                 Random* random) {
  const auto one = static_cast<std::uint32_t>(random->Below(table.end()));
  for (const intersection::BoundKind kind :
       {intersection::BoundKind::kHorn, intersection::BoundKind::kHypertrapezoid}) {
    const intersection::BroadQuery query{kind, now,
                                         numeric::AddRoundedUp(now, random->LogUniform(0.01, 5))};
    if (of_all) {
      ASSERT_EQ(Text(method.Earliest(query)), Text(table.Earliest(query)));
    }
    if (!table.Holds(one)) continue;
    ASSERT_EQ(Text(method.EarliestOf(one, query)),
              Text(table.Earliest(query, static_cast<int>(one))));
  }
  if (!table.Holds(one)) return;
  const Instant from = random->Chance(0.3) ? numeric::AddRoundedUp(now, -0.2) : now;
  const Instant until = numeric::AddRoundedUp(from, random->LogUniform(0.01, 5));
  const Instant horizon = random->Chance(0.5) ? Instant::Never() : numeric::AddRoundedUp(until, 2);
  std::vector<Neighbour> meetings;
  const auto none = [](std::uint32_t) { return false; };
  method.FindNeighbours(one, {from, until, horizon}, none, &meetings);
  ASSERT_EQ(Texts(meetings), Texts(table.Meetings(one, from, until, horizon))) << "of " << one;
}

/// Each pair once, none that is excluded, all that meet.
void ExpectAllNear(const RulesTable& table, SweepingIndex& method,
                   const intersection::BroadQuery& query) {
  std::vector<NearPair> pairs;
  method.FindNearPairs(query, &pairs);
  std::set<std::pair<std::uint32_t, std::uint32_t>> reported;
  for (const NearPair& pair : pairs) {
    ASSERT_TRUE(reported.insert({pair.lower, pair.higher}).second)
        << pair.lower << " " << pair.higher;
    ASSERT_EQ(method.rules().Of(pair.lower, pair.higher).excluded, false);
  }
  for (std::uint32_t a = 0; a < table.end(); ++a) {
    for (std::uint32_t b = a + 1; b < table.end(); ++b) {
      if (table.TimeOf(query, a, b).instant().is_never()) continue;
      ASSERT_TRUE(reported.count({a, b})) << a << " x " << b;
    }
  }
}

void Change(RulesTable* table, const NamedScene& scene, Instant now, Random* random) {
  const auto i = static_cast<std::uint32_t>(random->Below(table->end()));
  const auto other = static_cast<std::uint32_t>(random->Below(table->end()));
  const double kind = random->Uniform(0, 1);
  if (kind < 0.3) {
    table->SetRule(i, other, DrawRule(random));
  } else if (kind < 0.38) {
    table->Remove(i);
  } else if (kind < 0.45) {
    table->SetHalfSpace(i, DrawHalfSpace(*table, random));
  } else if (kind < 0.6 || !table->Moves(i)) {  // also where a half-space was
    AgentBound agent = *scene.make(random).front();
    agent.bound.state.stamp = now;
    table->Set(i, agent);
  } else if (table->bound(i).bound.state.stamp < now) {  // a kept state, on the straight line
    AgentBound agent = table->bound(i);
    motion::MotionState& state = agent.bound.state;
    state.p_WA += state.v_WA * numeric::SecondsBetween(state.stamp, now).lower;
    state.stamp = now;
    table->Tighten(i, agent);
  }
}

std::unique_ptr<SweepingIndex> MakeChosen() { return std::make_unique<AdaptiveBroadPhase>(); }

class MethodsWithRules : public testing::TestWithParam<NamedMethod> {};

TEST_P(MethodsWithRules, AgreeThroughLongHistories) {
  for (const NamedScene& scene : kMethodScenes) {
    for (int history = 0; history < kHistories; ++history) {
      Random random(500 + history);
      const auto method = GetParam().make();
      RulesTable table(method.get());
      const SceneAgents agents = scene.make(&random);
      for (std::uint32_t a = 0; a < agents.size(); ++a) table.Set(a, *agents[a]);
      table.SetHalfSpace(table.end() + 1, DrawHalfSpace(table, &random));
      Instant now = numeric::AddRoundedUp(kMethodStart, 1);
      for (int step = 0; step < kSteps; ++step) {
        for (int change = 0; change < 8; ++change) Change(&table, scene, now, &random);
        ExpectAlike(table, *method, now, step % 8 == 0, &random);
        method->Validate();
        ASSERT_FALSE(HasFatalFailure()) << scene.name << ", " << history << ", step " << step;
        ASSERT_EQ(method->rules().size(), table.rules());
        now = numeric::AddRoundedUp(now, random.Uniform(0, 0.05));
      }
      const intersection::BroadQuery query{intersection::BoundKind::kHorn, now,
                                           numeric::AddRoundedUp(now, 0.5)};
      ExpectAllNear(table, *method, query);
      ASSERT_FALSE(HasFatalFailure()) << scene.name << ", " << history;
    }
  }
}

/// Queries `count` agents in a cube in turn; returns the work that the queries took.
BroadPhaseWork WorkOfQueries(SweepingIndex* method, std::uint32_t count) {
  const BroadPhaseWork before = method->work();
  for (std::uint32_t agent = 0; agent < count; agent += 7) {
    const Instant from = numeric::AddRoundedUp(kMethodStart, 1e-3 * agent);
    std::vector<Neighbour> meetings;
    const auto none = [](std::uint32_t) { return false; };
    method->FindNeighbours(agent, {from, numeric::AddRoundedUp(from, 0.5), Instant::Never()}, none,
                           &meetings);
    method->Earliest({intersection::BoundKind::kHorn, from, numeric::AddRoundedUp(from, 1)});
  }
  const BroadPhaseWork after = method->work();
  return {after.pair_queries - before.pair_queries, after.filter_tests - before.filter_tests,
          after.visits - before.visits, after.rebuilds - before.rebuilds};
}

void Fill(SweepingIndex* method, std::uint32_t count, double extent) {
  Random random(9);
  for (std::uint32_t a = 0; a < count; ++a) {
    method->Set(a, BoundIn(extent, 0.5, 5, 2, &random));
  }
}

void ExpectSameWork(const BroadPhaseWork& a, const BroadPhaseWork& b) {
  EXPECT_EQ(a.pair_queries, b.pair_queries);
  EXPECT_EQ(a.filter_tests, b.filter_tests);
  EXPECT_EQ(a.visits, b.visits);
  EXPECT_EQ(a.rebuilds, b.rebuilds);
}

// Goal:   rules that are removed, or of agents that are not held, cost no counted work, and
//         half-spaces that no agent's mask names cost no test.
TEST_P(MethodsWithRules, CostNothingWhereUnused) {
  constexpr std::uint32_t kAgents = 300;
  const auto plain = GetParam().make(), ruled = GetParam().make();
  Fill(plain.get(), kAgents, 20);
  for (std::uint32_t a = 1; a < 40; ++a) {
    ASSERT_TRUE(ruled->SetMargin(a, a + 3, 5));
    ASSERT_TRUE(ruled->Exclude(a + 1000, a + 1003));
  }
  Fill(ruled.get(), kAgents, 20);
  for (std::uint32_t a = 1; a < 40; ++a) ruled->ClearRule(a + 3, a);
  ASSERT_TRUE(ruled->SetHalfSpace(kAgents, {{0, 0, 1}, 1, 1, 2}));
  ASSERT_TRUE(ruled->SetHalfSpace(kAgents + 1, {{0, 0, 1}, 1}));
  ruled->Remove(kAgents + 1);
  ExpectSameWork(WorkOfQueries(ruled.get(), kAgents), WorkOfQueries(plain.get(), kAgents));
}

// Goal:   an excluded pair is not tested. Method: all pairs are excluded; none is tested.
TEST_P(MethodsWithRules, DoNotAskExcludedPairs) {
  constexpr std::uint32_t kAgents = 60;
  const auto method = GetParam().make();
  Fill(method.get(), kAgents, 1);
  EXPECT_GT(WorkOfQueries(method.get(), kAgents).pair_queries, 0u);
  for (std::uint32_t a = 0; a < kAgents; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) ASSERT_TRUE(method->Exclude(a, b));
  }
  EXPECT_EQ(WorkOfQueries(method.get(), kAgents).pair_queries, 0u);
  EXPECT_FALSE(
      method->Earliest({intersection::BoundKind::kHypertrapezoid, kMethodStart, kMethodStart}));
  std::vector<NearPair> pairs;
  method->FindNearPairs({intersection::BoundKind::kHorn, kMethodStart, kMethodStart}, &pairs);
  EXPECT_TRUE(pairs.empty());
}

// Goal:   of two half-spaces the one that is met first counts, also before a second agent's stamp,
//         when no pair can meet yet; an agent alone meets them too.
TEST_P(MethodsWithRules, MeetHalfSpacesBeforeOthersAreThere) {
  const auto method = GetParam().make();
  motion::SpaceTimeBound bound;
  bound.state.stamp = kMethodStart;
  bound.state.p_WA = {3, 4, 7};
  bound.state.v_WA = {0, 0, -2};
  bound.limits.radius = 1;
  method->Set(0, bound);
  ASSERT_TRUE(method->SetHalfSpace(1, {{0, 0, 1}, 0}));  // at 3 s
  ASSERT_TRUE(method->SetHalfSpace(2, {{0, 0, 2}, 4}));  // at 2 s
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, kMethodStart,
                                       Instant::Never()};
  const auto alone = method->Earliest(query);
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->higher, 2u);
  EXPECT_LE(alone->time.seconds, 2);
  EXPECT_GE(alone->time.seconds, 2 - 1e-8);
  bound.state.stamp = numeric::AddRoundedUp(kMethodStart, 10);
  method->Set(3, bound);
  EXPECT_EQ(Text(method->Earliest(query)), Text(alone));
}

// Goal:   what is refused changes nothing.
TEST_P(MethodsWithRules, RefuseBeyondTheLimits) {
  const auto method = GetParam().make();
  Fill(method.get(), 2, 1);
  EXPECT_FALSE(method->SetMargin(0, 1, -1));
  EXPECT_FALSE(method->Exclude(1, 1));
  EXPECT_TRUE(method->rules().empty());
  for (std::uint32_t i = 0; i < HalfSpaces::kCountMax; ++i) {
    ASSERT_TRUE(method->SetHalfSpace(10 + i, HalfSpace()));
  }
  EXPECT_FALSE(method->SetHalfSpace(1, HalfSpace())) << "an agent's index, and it stays";
  EXPECT_EQ(method->half_spaces().size(), HalfSpaces::kCountMax);
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, kMethodStart,
                                       Instant::Never()};
  const auto expected = method->EarliestOf(1, query);
  ASSERT_TRUE(expected);
  EXPECT_FALSE(method->SetHalfSpace(9, HalfSpace()));
  EXPECT_FALSE(method->SetHalfSpace(12, {{0, 0, 0}, 0}));
  EXPECT_EQ(Text(method->EarliestOf(1, query)), Text(expected));
}

const NamedMethod kAll[] = {kMethods[0], kMethods[1], kMethods[2], {"Chosen", &MakeChosen}};

INSTANTIATE_TEST_SUITE_P(All, MethodsWithRules, testing::ValuesIn(kAll),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace collision::broad_phase
