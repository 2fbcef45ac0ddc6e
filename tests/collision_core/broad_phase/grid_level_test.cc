// Goal:   the ranges of a grid hold every agent that comes within reach, and few others; of two
//         agents one finds the other, and both do not.
// Method: a few agents in one cell, an even box, a crowd, and agents so far apart that rows are
//         found by hashing; each beside all pairs.
#include "collision_core/broad_phase/index/grid_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/random.h"

namespace collision::broad_phase {
namespace {

using Vector = Eigen::Vector3d;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Slow unit balls at these places, in one grid.
struct Scene {
  explicit Scene(const std::vector<Vector>& places) {
    for (std::uint32_t k = 0; k < places.size(); ++k) {
      motion::SpaceTimeBound bound;
      bound.state.p_WA = places[k];
      bound.state.v_WA = {k % 2 == 0 ? 0.25 : -0.25, 0, 0};
      bound.limits.radius = 1;
      table.Set(k, bound);
    }
    frame = PlacementFrame(table, {.from = Instant(), .until = Instant::Never()}, 1);
    PlacedExtent extent;
    for (std::uint32_t k = 0; k < places.size(); ++k) {
      placed.push_back(frame.Place(table, k));
      extent.Add(placed.back());
    }
    grid.Build(frame, placed.data(), size(), extent);
    grid.Validate();
  }
  Scene(const Scene&) = delete;

  std::uint32_t size() const { return static_cast<std::uint32_t>(placed.size()); }
  TimeWindow window() const { return {0, frame.window()}; }
  double ReachOf(std::uint32_t k) const { return frame.Reach(placed[k], window()); }
  double Distance(std::uint32_t a, std::uint32_t b) const {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      square += (placed[a].c[axis] - placed[b].c[axis]) * (placed[a].c[axis] - placed[b].c[axis]);
    }
    return std::sqrt(square);
  }
  bool AreNear(std::uint32_t a, std::uint32_t b) const {
    return Distance(a, b) <= ReachOf(a) + ReachOf(b);
  }

  /// The agents in ranges of places.
  std::vector<std::uint32_t> AgentsIn(const std::vector<FilterRange>& ranges) const {
    std::vector<std::uint32_t> agents;
    for (const FilterRange& range : ranges) {
      for (std::uint32_t k = range.begin; k < range.end; ++k)
        agents.push_back(grid.lanes().agent(k));
    }
    return agents;
  }

  HornTable table;
  PlacementFrame frame;
  std::vector<PlacedBall> placed;
  GridLevel grid;
};

std::vector<Vector> Even(std::uint32_t count, double side) {
  Random random(count);
  std::vector<Vector> places;
  for (std::uint32_t k = 0; k < count; ++k) {
    places.emplace_back(random.Uniform(0, side), random.Uniform(0, side), random.Uniform(0, side));
  }
  return places;
}

/// Pairs that touch, strewn over twelve orders of magnitude.
std::vector<Vector> Strewn(std::uint32_t count) {
  Random random(count);
  std::vector<Vector> places;
  while (places.size() < count) {
    places.push_back(random.UnitVector() * random.LogUniform(1, 1e9));
    places.push_back(places.back() + 1.5 * random.UnitVector());
  }
  return places;
}

std::vector<std::vector<Vector>> AllPlaces() {
  std::vector<Vector> crowd = Even(300, 6);
  crowd.emplace_back(1e7, 0, 0);
  return {Even(20, 8), Even(500, 60), Even(500, 10), crowd, Strewn(400)};
}

/// Each pair that is found, and how often.
std::multiset<Pair> PairsByRanges(const Scene& scene) {
  std::multiset<Pair> pairs;
  for (std::uint32_t k = 0; k < scene.size(); ++k) {
    std::vector<FilterRange> ranges;
    const bool found = scene.grid.Ranges(scene.placed[k].c, scene.ReachOf(k), scene.window(),
                                         scene.grid.place(k), &ranges);
    EXPECT_TRUE(found) << "an agent's own reach is small";
    for (const std::uint32_t other : scene.AgentsIn(ranges)) pairs.insert(std::minmax(k, other));
  }
  return pairs;
}

/// Where rows are found by hashing, two of them may share a place: then a pair may be found again.
void ExpectEachNearPairOnce(const Scene& scene, const std::multiset<Pair>& pairs) {
  const bool may_repeat = !scene.grid.in_rows();
  int near = 0;
  for (std::uint32_t a = 0; a < scene.size(); ++a) {
    EXPECT_TRUE(may_repeat || pairs.count({a, a}) == 0) << "an agent does not find itself";
    for (std::uint32_t b = a + 1; b < scene.size(); ++b) {
      const std::size_t times = pairs.count({a, b});
      EXPECT_TRUE(may_repeat || times <= 1) << a << " " << b;
      if (!scene.AreNear(a, b)) continue;
      ++near;
      EXPECT_GE(times, 1u) << a << " " << b;
    }
  }
  EXPECT_GT(near, 3) << "the scene tests something";
}

TEST(GridLevel, EveryAgentStandsAtAPlaceOfItsOwn) {
  for (const std::vector<Vector>& places : AllPlaces()) {
    const Scene scene(places);
    ASSERT_EQ(scene.grid.size(), scene.size());
    std::set<std::uint32_t> taken;
    for (std::uint32_t k = 0; k < scene.size(); ++k) {
      EXPECT_EQ(scene.grid.lanes().agent(scene.grid.place(k)), k);
      taken.insert(scene.grid.place(k));
      EXPECT_LE(scene.ReachOf(k), scene.grid.ReachMax(scene.window()));
    }
    EXPECT_EQ(taken.size(), scene.size());
  }
}

TEST(GridLevel, RangesHoldEveryAgentThatComesWithinReach) {
  for (const std::vector<Vector>& places : AllPlaces()) {
    const Scene scene(places);
    for (const double reach : {0.0, 1.0, 7.0}) {
      for (std::uint32_t k = 0; k < scene.size(); k += 7) {
        std::vector<FilterRange> ranges;
        if (!scene.grid.Ranges(scene.placed[k].c, reach, scene.window(), PlacedBalls::kNoAgent,
                               &ranges)) {
          EXPECT_TRUE(ranges.empty());
          continue;
        }
        const std::vector<std::uint32_t> found = scene.AgentsIn(ranges);
        const std::set<std::uint32_t> agents(found.begin(), found.end());
        for (std::uint32_t other = 0; other < scene.size(); ++other) {
          if (scene.Distance(k, other) > reach + scene.ReachOf(other)) continue;
          EXPECT_TRUE(agents.contains(other)) << k << " " << other;
        }
      }
    }
  }
}

TEST(GridLevel, OfTwoAgentsThatComeNearOneFindsTheOther) {
  for (const std::vector<Vector>& places : AllPlaces()) {
    const Scene scene(places);
    ExpectEachNearPairOnce(scene, PairsByRanges(scene));
  }
}

// Of 500 agents in a box of 60 m few come within 2 m of each other.
TEST(GridLevel, FewOthersAreFound) {
  const Scene even(Even(500, 60));
  EXPECT_LT(PairsByRanges(even).size(), 500u * 500u / 2 / 8);
  const Scene strewn(Strewn(400));
  EXPECT_LT(PairsByRanges(strewn).size(), 400u * 400u / 2 / 4);
}

TEST(GridLevel, AWalkOverAllPlacesFindsTheSamePairs) {
  for (const std::vector<Vector>& places : AllPlaces()) {
    const Scene scene(places);
    const auto walk = [&](const auto& visit) { scene.grid.ForEachPlace(scene.window(), visit); };
    std::multiset<Pair> pairs;
    std::uint32_t next = 0;
    const auto take = [&](std::uint32_t place, const FilterQuery&,
                          const std::vector<FilterRange>& ranges) {
      EXPECT_EQ(place, next++) << "in order";
      const std::uint32_t agent = scene.grid.lanes().agent(place);
      for (const std::uint32_t other : scene.AgentsIn(ranges)) {
        pairs.insert(std::minmax(agent, other));
      }
      return scene.window().last;
    };
    if (!scene.grid.in_rows()) {
      EXPECT_THROW(walk(take), CheckFailure);
      continue;
    }
    walk(take);
    EXPECT_EQ(next, scene.size());
    ExpectEachNearPairOnce(scene, pairs);
  }
}

TEST(GridLevel, RowsAreThoseOfTheBoxUnlessAgentsAreFarApart) {
  EXPECT_TRUE(Scene(Even(20, 8)).grid.in_rows());
  EXPECT_TRUE(Scene(Even(500, 60)).grid.in_rows());
  EXPECT_FALSE(Scene(Strewn(400)).grid.in_rows());
}

TEST(GridLevel, AReachOverMoreCellsThanAgentsIsRefused) {
  const Scene scene(Strewn(400));
  std::vector<FilterRange> ranges;
  EXPECT_FALSE(
      scene.grid.Ranges(scene.placed[0].c, 1e9, scene.window(), PlacedBalls::kNoAgent, &ranges));
  EXPECT_TRUE(ranges.empty());
}

TEST(GridLevel, TheNumberOfRowsGrowsWithTheReachUpToThatOfAgents) {
  for (const std::vector<Vector>& places : AllPlaces()) {
    const Scene scene(places);
    double before = 0;
    for (const double reach : {0.0, 1.0, 100.0, 1e12}) {
      const double rows = scene.grid.RowsWithin(reach, scene.window());
      EXPECT_GE(rows, before);
      EXPECT_LE(rows, scene.size());
      before = rows;
    }
  }
}

TEST(GridLevel, AVacantPlaceHoldsNoAgentAndTheOthersStay) {
  Scene scene(Even(500, 60));
  const std::uint32_t place = scene.grid.place(17);
  scene.grid.Vacate(place);
  scene.grid.Validate();
  for (std::uint32_t k = 0; k < scene.size(); ++k) {
    const std::uint32_t agent = scene.grid.lanes().agent(scene.grid.place(k));
    EXPECT_EQ(agent, k == 17 ? PlacedBalls::kNoAgent : k);
  }
  EXPECT_EQ(scene.grid.size(), scene.size());
}

TEST(GridLevel, AGridWithoutAgentsIsRefused) {
  GridLevel grid;
  EXPECT_THROW(grid.Build({}, nullptr, 0, {}), CheckFailure);
}

}  // namespace
}  // namespace collision::broad_phase
