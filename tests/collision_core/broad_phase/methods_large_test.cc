// Goal:   what methods do only for many agents (grids of many cells, a crowd asked first, levels,
//         hashed rows) changes no answer either; and no pair that may meet is missing among those
//         that are told as near.
// Method: hundreds and thousands of agents evenly, in clusters, of all sizes, speeds and stamps; the
//         oracle asks the canonical routine for every pair. Work counters show that the pass over a
//         grid was taken where it should.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "tests/collision_core/broad_phase/method_scenes.h"

namespace collision {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kSizes[] = {140};
#else
constexpr int kSizes[] = {140, 600, 2300};
#endif

constexpr double kWindow = 1;

/// To ask every pair for the meeting of two hypertrapezoids takes long.
constexpr int kHypertrapezoidsMax = 600;

struct LargeScene {
  const char* name;
  /// Agent i of n; sizes are such that few touch at the start.
  SpaceTimeBound (*make)(int i, int n, Random* random);
};

/// Half the side of a cube in which each has so much room.
double Half(int n, double volume) { return 0.5 * std::cbrt(n * volume); }

const LargeScene kLargeScenes[] = {
    {"sparse", [](int, int n, Random* r) { return BoundIn(Half(n, 3000), 0.5, 3, 1, r); }},
    {"dense", [](int, int n, Random* r) { return BoundIn(Half(n, 30), 0.2, 3, 1, r); }},
    {"at rest", [](int, int n, Random* r) { return BoundIn(Half(n, 2000), 0.5, 0, 0.5, r); }},
    {"far away, in a moving frame",
     [](int, int n, Random* r) {
       SpaceTimeBound bound = BoundIn(Half(n, 3000), 0.5, 3, 1, r);
       bound.state.p_WA.array() += 1e9;
       bound.state.v_WA.y() += 3e3;
       return bound;
     }},
    {"clusters",
     [](int i, int n, Random* r) {
       SpaceTimeBound bound = BoundIn(Half(n / 5, 200), 0.2, 3, 1, r);
       bound.state.p_WA.x() += 1e6 * (i % 5);
       return bound;
     }},
    {"all sizes",
     [](int, int n, Random* r) {
       return BoundIn(Half(n, 1e5), r->LogUniform(1e-3, 30), r->LogUniform(1e-2, 10), 1, r);
     }},
    {"a plate",
     [](int i, int n, Random* r) {
       SpaceTimeBound bound = BoundIn(3 * std::sqrt(n), 0.2, 2, 1, r);
       bound.state.p_WA.z() = 1e-3 * (i % 3);
       return bound;
     }},
    {"a row",
     [](int i, int, Random* r) {
       SpaceTimeBound bound = BoundIn(1, 0.2, 2, 1, r);
       bound.state.p_WA.x() += 3 * i;
       return bound;
     }},
    {"some still, some fast",
     [](int i, int n, Random* r) {
       if (i % 50 == 7) return BoundIn(Half(n, 3000), 0.5, 300, 1, r);
       return i % 3 == 0 ? BoundIn(Half(n, 3000), 0.5, 0, 0, r)
                         : BoundIn(Half(n, 3000), 0.5, 3, 1, r);
     }},
    {"masks, stamps and errors",
     [](int i, int n, Random* r) {
       SpaceTimeBound bound = BoundIn(Half(n, 3000), 0.5, 3, 1, r);
       bound.declaration.group = 1u << (i % 3);
       bound.declaration.mask = i % 7 == 0 ? 0 : 6;
       bound.state.stamp = AddRoundedUp(kMethodStart, -r->Uniform(0, 0.5));
       bound.state.position_error = r->Uniform(0, 0.1);
       return bound;
     }},
};

class LargeMethods : public testing::TestWithParam<LargeScene> {};

std::vector<PairMeeting> AllMeetings(const std::vector<SpaceTimeBound>& bounds,
                                     const BroadQuery& query) {
  std::vector<PairMeeting> meetings;
  for (std::uint32_t a = 0; a < bounds.size(); ++a) {
    for (std::uint32_t b = a + 1; b < bounds.size(); ++b) {
      const PairMeeting meeting{a, b, MeetingTime(query, bounds[a], bounds[b])};
      if (!meeting.time.instant().is_never()) meetings.push_back(meeting);
    }
  }
  return meetings;
}

TEST_P(LargeMethods, FindTheFirstMeetingAndEveryNearPair) {
  const LargeScene& scene = GetParam();
  std::size_t told = 0, expected = 0;
  for (const int count : kSizes) {
    Random random(count);
    std::vector<SpaceTimeBound> bounds;
    AllPairs all_pairs;
    SpatialIndex index;
    for (int i = 0; i < count; ++i) {
      bounds.push_back(scene.make(i, count, &random));
      all_pairs.Put(i, bounds.back());
      index.Put(i, bounds.back());
    }
    for (const BoundKind kind : {BoundKind::kHorn, BoundKind::kHypertrapezoid}) {
      if (kind == BoundKind::kHypertrapezoid && count > kHypertrapezoidsMax) continue;
      const BroadQuery query{kind, kMethodStart, AddRoundedUp(kMethodStart, kWindow)};
      const std::vector<PairMeeting> meetings = AllMeetings(bounds, query);
      const auto first = std::min_element(meetings.begin(), meetings.end());
      expected += meetings.size();
      for (BroadPhase* method :
           {static_cast<BroadPhase*>(&all_pairs), static_cast<BroadPhase*>(&index)}) {
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
        method->NearPairs(query, &near);
        std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
        for (const NearPair& pair : near) {
          ASSERT_LT(pair.lower, pair.higher) << what;
          ASSERT_TRUE(pairs.insert({pair.lower, pair.higher}).second) << what << ": twice";
          ASSERT_TRUE(CanMeet(bounds[pair.lower].declaration, bounds[pair.higher].declaration));
        }
        for (const PairMeeting& meeting : meetings) {
          ASSERT_TRUE(pairs.contains({meeting.lower, meeting.higher})) << what << ": missing";
        }
        told += near.size();
      }
    }
  }
  // Of both methods; a filter, but one that rules out nearly all of millions.
  EXPECT_GT(expected, 5u);
  EXPECT_LT(told, 2 * (30 * expected + 20'000));
}

INSTANTIATE_TEST_SUITE_P(All, LargeMethods, testing::ValuesIn(kLargeScenes));

// Asked first where agents are close together, a few bound the answer for all.
TEST(LargeMethods, ACrowdMakesTheWindowShort) {
  Random random(1);
  SpatialIndex index;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) index.Put(i, BoundIn(Half(kCount, 40), 0.2, 3, 1, &random));
  const BroadQuery query{BoundKind::kHorn, kMethodStart, AddRoundedUp(kMethodStart, 100)};
  ASSERT_TRUE(index.Earliest(query).has_value());
  EXPECT_LT(index.work().filter_tests, 20u * kCount);
  EXPECT_LT(index.work().pair_queries, 400u);
}

}  // namespace
}  // namespace collision
