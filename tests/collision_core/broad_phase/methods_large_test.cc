// Goal:   what methods do only for many agents (grids of many cells, a crowd queried first, levels,
//         hashed rows) changes no answer either; and no pair that may meet is missing among those
//         that are reported as near.
// Method: hundreds and thousands of agents evenly, in clusters, of all sizes, speeds and stamps;
//         the oracle calls the canonical routine for every pair. Work counters show that the pass
//         over a grid was taken where it should.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "collision_core/numeric/seconds.h"
#include "tests/collision_core/broad_phase/method_scenes.h"
#include "tests/support/sanitized.h"

namespace collision::broad_phase {
namespace {

constexpr int kSizes[] = {140, 600, kSanitized ? 1200 : 2300};

constexpr double kWindow = 1;

/// The intersection of hypertrapezoids takes long to compute for every pair.
constexpr int kHypertrapezoidsMax = 600;

struct LargeScene {
  const char* name;
  /// Agent i of n; sizes are such that few touch at the start.
  AgentBound (*make)(int i, int n, Random* random);
};

/// Half the side of a cube in which each has so much room.
double Half(int n, double volume) { return 0.5 * std::cbrt(n * volume); }

const LargeScene kLargeScenes[] = {
    {"sparse",
     [](int, int n, Random* r) -> AgentBound { return BoundIn(Half(n, 3000), 0.5, 3, 1, r); }},
    {"dense",
     [](int, int n, Random* r) -> AgentBound { return BoundIn(Half(n, 30), 0.2, 3, 1, r); }},
    {"at rest",
     [](int, int n, Random* r) -> AgentBound { return BoundIn(Half(n, 2000), 0.5, 0, 0.5, r); }},
    {"far away, in a moving frame",
     [](int, int n, Random* r) -> AgentBound {
       motion::SpaceTimeBound bound = BoundIn(Half(n, 3000), 0.5, 3, 1, r);
       bound.state.p_WA.array() += 1e9;
       bound.state.v_WA.y() += 3e3;
       return bound;
     }},
    {"clusters",
     [](int i, int n, Random* r) -> AgentBound {
       motion::SpaceTimeBound bound = BoundIn(Half(n / 5, 200), 0.2, 3, 1, r);
       bound.state.p_WA.x() += 1e6 * (i % 5);
       return bound;
     }},
    {"all sizes",
     [](int, int n, Random* r) -> AgentBound {
       return BoundIn(Half(n, 1e5), r->LogUniform(1e-3, 30), r->LogUniform(1e-2, 10), 1, r);
     }},
    {"a plate",
     [](int i, int n, Random* r) -> AgentBound {
       motion::SpaceTimeBound bound = BoundIn(3 * std::sqrt(n), 0.2, 2, 1, r);
       bound.state.p_WA.z() = 1e-3 * (i % 3);
       return bound;
     }},
    {"a row",
     [](int i, int, Random* r) -> AgentBound {
       motion::SpaceTimeBound bound = BoundIn(1, 0.2, 2, 1, r);
       bound.state.p_WA.x() += 3 * i;
       return bound;
     }},
    {"some still, some fast",
     [](int i, int n, Random* r) -> AgentBound {
       if (i % 50 == 7) return BoundIn(Half(n, 3000), 0.5, 300, 1, r);
       return i % 3 == 0 ? BoundIn(Half(n, 3000), 0.5, 0, 0, r)
                         : BoundIn(Half(n, 3000), 0.5, 3, 1, r);
     }},
    {"masks, stamps and errors",
     [](int i, int n, Random* r) -> AgentBound {
       AgentBound agent = BoundIn(Half(n, 3000), 0.5, 3, 1, r);
       agent.filter.group = 1u << (i % 3);
       agent.filter.mask = i % 7 == 0 ? 0 : 6;
       agent.bound.state.stamp = numeric::AddRoundedUp(kMethodStart, -r->Uniform(0, 0.5));
       agent.bound.state.position_error = r->Uniform(0, 0.1);
       return agent;
     }},
};

class LargeMethods : public testing::TestWithParam<LargeScene> {};

std::vector<intersection::IntersectingPair> AllMeetings(const std::vector<AgentBound>& bounds,
                                                        const intersection::BroadQuery& query) {
  std::vector<intersection::IntersectingPair> meetings;
  for (std::uint32_t a = 0; a < bounds.size(); ++a) {
    for (std::uint32_t b = a + 1; b < bounds.size(); ++b) {
      const intersection::IntersectingPair meeting{
          a, b, EarliestIntersectionOf(query, bounds[a], bounds[b])};
      if (!meeting.time.instant().is_never()) meetings.push_back(meeting);
    }
  }
  return meetings;
}

TEST_P(LargeMethods, FindTheFirstMeetingAndEveryNearPair) {
  const LargeScene& scene = GetParam();
  std::size_t reported = 0, expected = 0;
  for (const int count : kSizes) {
    Random random(count);
    std::vector<AgentBound> bounds;
    AllPairs all_pairs;
    SpatialIndex index;
    for (int i = 0; i < count; ++i) {
      bounds.push_back(scene.make(i, count, &random));
      all_pairs.Set(i, bounds.back());
      index.Set(i, bounds.back());
    }
    for (const intersection::BoundKind kind :
         {intersection::BoundKind::kHorn, intersection::BoundKind::kHypertrapezoid}) {
      if (kind == intersection::BoundKind::kHypertrapezoid && count > kHypertrapezoidsMax) continue;
      const intersection::BroadQuery query{kind, kMethodStart,
                                           numeric::AddRoundedUp(kMethodStart, kWindow)};
      const std::vector<intersection::IntersectingPair> meetings = AllMeetings(bounds, query);
      const auto first = std::min_element(meetings.begin(), meetings.end());
      expected += meetings.size();
      for (SweepingIndex* method :
           {static_cast<SweepingIndex*>(&all_pairs), static_cast<SweepingIndex*>(&index)}) {
        const std::string what = std::string(scene.name) + ", " + std::to_string(count) +
                                 (method == &index ? ", index" : ", all pairs");
        const auto answer = method->Earliest(query);
        ASSERT_EQ(answer.has_value(), !meetings.empty()) << what;
        if (answer) {
          ASSERT_EQ(std::pair(answer->lower, answer->higher),
                    std::pair(first->lower, first->higher))
              << what;
          ASSERT_EQ(answer->time.seconds, first->time.seconds) << what;
        }
        std::vector<NearPair> near;
        method->FindNearPairs(query, &near);
        std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
        for (const NearPair& pair : near) {
          ASSERT_LT(pair.lower, pair.higher) << what;
          ASSERT_TRUE(pairs.insert({pair.lower, pair.higher}).second) << what << ": twice";
          ASSERT_TRUE(CanMeet(bounds[pair.lower].filter, bounds[pair.higher].filter));
        }
        for (const intersection::IntersectingPair& meeting : meetings) {
          ASSERT_TRUE(pairs.contains({meeting.lower, meeting.higher})) << what << ": missing";
        }
        reported += near.size();
      }
    }
  }
  // For both methods together: a filter may pass more, but rules out nearly all of millions.
  EXPECT_GT(expected, 5u);
  EXPECT_LT(reported, 2 * (30 * expected + 20'000));
}

INSTANTIATE_TEST_SUITE_P(All, LargeMethods, testing::ValuesIn(kLargeScenes), [](const auto& test) {
  std::string name = test.param.name;
  for (char& letter : name) letter = std::isalnum(letter) ? letter : '_';
  return name;
});

// Four fast ones fly through a crowd at rest. Placed long after, they have a long way back.
TEST(LargeMethods, AQueryFromLongBeforeTheLastOneLosesNoNeighbour) {
  constexpr int kFast = 4;
  for (int seed = 0; seed < 10; ++seed) {
    for (const double back : {1e2, 1e3, 1e4, 3e4, 1e5}) {
      Random random(seed);
      std::vector<motion::SpaceTimeBound> bounds;
      for (int i = 0; i < 300; ++i) {
        motion::SpaceTimeBound bound = BoundIn(5, 0.5, 0, 0, &random);
        if (i < kFast) {
          bound.state.v_WA = {(i % 2 ? -1 : 1) * random.Uniform(500, 1000), 0, 0};
          bound.state.p_WA = -bound.state.v_WA;
          for (int axis : {1, 2}) bound.state.p_WA[axis] += random.Uniform(-0.4, 0.4);
        }
        bounds.push_back(bound);
      }
      AllPairs all_pairs;
      SpatialIndex index;
      const intersection::BroadQuery late{intersection::BoundKind::kHorn,
                                          numeric::AddRoundedUp(kMethodStart, back),
                                          numeric::AddRoundedUp(kMethodStart, back + 1)};
      const intersection::BroadQuery early{intersection::BoundKind::kHorn, kMethodStart,
                                           numeric::AddRoundedUp(kMethodStart, 3)};
      for (SweepingIndex* method :
           {static_cast<SweepingIndex*>(&all_pairs), static_cast<SweepingIndex*>(&index)}) {
        for (std::uint32_t i = 0; i < bounds.size(); ++i) method->Set(i, bounds[i]);
        method->EarliestOf(1, late);
        for (std::uint32_t i = 0; i < kFast; ++i) {
          std::optional<intersection::IntersectingPair> first;
          std::size_t count = 0;
          for (std::uint32_t j = 0; j < bounds.size(); ++j) {
            if (j == i) continue;
            const intersection::IntersectingPair meeting{
                std::min(i, j), std::max(i, j),
                EarliestIntersectionOf(early, bounds[i], bounds[j])};
            if (meeting.time.instant().is_never()) continue;
            ++count;
            if (!first || meeting < *first) first = meeting;
          }
          const auto got = method->EarliestOf(i, early);
          ASSERT_TRUE(first && got);
          ASSERT_EQ(got->time.seconds, first->time.seconds) << "seed " << seed << ", " << back;
          std::vector<Neighbour> meetings;
          method->FindNeighbours(
              i, {early.from, early.until, early.until}, [](std::uint32_t) { return false; },
              &meetings);
          ASSERT_EQ(meetings.size(), count) << "seed " << seed << ", " << back;
        }
      }
    }
  }
}

// One far away: the rest crowd in one of the cells that suit all.
TEST(LargeMethods, NearPairsAreFoundOnceInAnyWindow) {
  Random random(1);
  SpatialIndex index;
  for (int i = 0; i < 200; ++i) {
    motion::SpaceTimeBound bound = BoundIn(20, 0.5, 5, 2, &random);
    if (i == 0) bound.state.p_WA.x() = 5e10;
    index.Set(i, bound);
  }
  for (const double window : {0.1, 1.0, 10.0, 100.0, 1e3, 1e4}) {
    std::vector<NearPair> pairs;
    index.FindNearPairs(
        {intersection::BoundKind::kHorn, kMethodStart, numeric::AddRoundedUp(kMethodStart, window)},
        &pairs);
    const std::size_t reported = pairs.size();
    EXPECT_GT(reported, 0u);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    EXPECT_EQ(pairs.size(), reported) << window;
  }
}

// With a half-space held, and for an unfilterable agent.
TEST(LargeMethods, AbsentAgentsMeetNoneAndUnfilterableOnesAreTestedOnce) {
  constexpr std::uint32_t kCount = 500;
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, kMethodStart,
                                       numeric::AddRoundedUp(kMethodStart, 1e6)};
  AllPairs all_pairs;
  SpatialIndex index;
  SweepBesideIndex sweep;
  Random random(2);
  for (SweepingIndex* method :
       {static_cast<SweepingIndex*>(&all_pairs), static_cast<SweepingIndex*>(&index),
        static_cast<SweepingIndex*>(&sweep)}) {
    HalfSpace floor;
    floor.normal = {0, 0, 1};
    floor.offset = -1e9;
    ASSERT_TRUE(method->SetHalfSpace(3, floor));
    EXPECT_FALSE(method->EarliestOf(7, query).has_value());
    std::vector<Neighbour> meetings;
    method->FindNeighbours(
        7, {query.from, query.until, query.until}, [](std::uint32_t) { return false; }, &meetings);
    EXPECT_TRUE(meetings.empty());
  }
  for (std::uint32_t i = 0; i < kCount; ++i) {
    motion::SpaceTimeBound bound = BoundIn(1e9, 0.5, 1, 0, &random);
    if (i == 5) bound.state.v_WA.x() = 0x1p41;
    index.Set(i, bound);
  }
  const std::uint64_t before = index.work().pair_queries;
  index.EarliestOf(5, query);
  EXPECT_LE(index.work().pair_queries - before, kCount);
}

// Queries start where agents are close together: few of them bound the answer for all.
TEST(LargeMethods, ACrowdMakesTheWindowShort) {
  Random random(1);
  SpatialIndex index;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) index.Set(i, BoundIn(Half(kCount, 40), 0.2, 3, 1, &random));
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, kMethodStart,
                                       numeric::AddRoundedUp(kMethodStart, 100)};
  ASSERT_TRUE(index.Earliest(query).has_value());
  EXPECT_LT(index.work().filter_tests, 20u * kCount);
  EXPECT_LT(index.work().pair_queries, 400u);
}

}  // namespace
}  // namespace collision::broad_phase
