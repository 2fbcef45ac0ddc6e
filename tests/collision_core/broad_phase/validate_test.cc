// Goal:   the structures of the index are whole after every step of a history, and a walk of them
//         tells a broken one; what a constructor requires is checked.
// Method: agents of all sizes come, move and go in random order, with queries in between; each
//         structure is walked after each step. A row and a grid are broken on purpose; a search
//         is given a store that loses or keeps what it should not.
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "collision_core/broad_phase/filter/filter_row.h"
#include "collision_core/broad_phase/index/grid_level.h"
#include "tests/collision_core/broad_phase/method_scenes.h"
#include "tests/support/sanitized.h"

namespace collision::broad_phase {
namespace {

constexpr int kSteps = kSanitized ? 50 : 300;

template <typename Method>
void ExpectWholeThroughHistory(std::uint64_t seed) {
  Random random(seed);
  Method method;
  const auto none = [](std::uint32_t) { return false; };
  for (int step = 0; step < kSteps; ++step) {
    const auto agent = static_cast<std::uint32_t>(random.Below(200));
    const double kind = random.Uniform(0, 1);
    if (kind < 0.2) {
      method.Remove(agent);
    } else {
      motion::SpaceTimeBound bound =
          BoundIn(random.Chance(0.05) ? 0x1p61 : 100, random.LogUniform(1e-2, 10), 5, 1, &random);
      if (random.Chance(0.2)) bound.state.v_WA.setZero(), bound.limits.acceleration_max = 0;
      method.Set(agent, bound);
    }
    method.Validate();
    std::vector<Neighbour> found;
    const Instant from = numeric::AddRoundedUp(kMethodStart, 0.01 * step);
    method.FindNeighbours(agent, {from, numeric::AddRoundedUp(from, 1), Instant::Never()}, none,
                          &found);
    method.Validate();
    if (step % 50 == 0) {
      method.Earliest({intersection::BoundKind::kHorn, from, numeric::AddRoundedUp(from, 1)});
      method.Validate();
    }
  }
}

TEST(Validate, AllPairsAreWholeThroughHistories) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) ExpectWholeThroughHistory<AllPairs>(seed);
}

TEST(Validate, SpatialIndexIsWholeThroughHistories) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) ExpectWholeThroughHistory<SpatialIndex>(seed);
}

PlacedBall HornOf(std::uint32_t agent, double x) {
  return {{x, 0, 0}, {1, 0, 0}, 1, 1, 0.5f, 0.25f, 0, 0, agent};
}

TEST(Validate, TellsAnAgentThatStandsTwiceInARow) {
  FilterRow row;
  row.Add(HornOf(3, 0));
  row.Add(HornOf(4, 10));
  row.Validate();
  row.Add(HornOf(3, 20));
  EXPECT_THROW(row.Validate(), CheckFailure);
  row.Vacate(0);
  row.Validate();
}

TEST(Validate, TellsANegativeReachInARow) {
  FilterRow row;
  PlacedBall horn = HornOf(0, 0);
  horn.s0 = -1;
  row.Add(horn);
  EXPECT_THROW(row.Validate(), CheckFailure);
}

TEST(Validate, GridIsWholeBesideVacantPlaces) {
  Random random(5);
  HornTable table;
  for (std::uint32_t a = 0; a < 300; ++a) table.Set(a, BoundIn(100, 0.5, 5, 1, &random));
  table.Validate();
  const PlacementFrame frame(
      table, {intersection::BoundKind::kHorn, kMethodStart, Instant::Never()}, kWindowMax);
  std::vector<PlacedBall> horns;
  PlacedExtent extent;
  for (std::uint32_t a = 0; a < table.size(); ++a) {
    horns.push_back(frame.Place(table, a));
    extent.Add(horns.back());
  }
  GridLevel grid;
  grid.Build(frame, horns.data(), static_cast<std::uint32_t>(horns.size()), extent);
  grid.Validate();
  for (std::uint32_t k = 0; k < 100; ++k) grid.Vacate(grid.place(k));
  grid.Validate();
}

TEST(Validate, TellsAnAgentThatStandsInAGridAndBesideIt) {
  Random random(7);
  HornTable table;
  for (std::uint32_t a = 0; a < 50; ++a) table.Set(a, BoundIn(100, 0.5, 5, 1, &random));
  const PlacementFrame frame(
      table, {intersection::BoundKind::kHorn, kMethodStart, Instant::Never()}, kWindowMax);
  std::vector<PlacedBall> horns;
  for (std::uint32_t a = 0; a < table.size(); ++a) horns.push_back(frame.Place(table, a));
  const PlacedBall again = horns[9];
  GridStore store;
  store.PlaceAll({&table, &frame}, &horns);
  store.Validate();
  EXPECT_TRUE(store.Holds(9) && !store.Holds(50));
  store.Place(again);
  EXPECT_THROW(store.Validate(), CheckFailure);
}

/// A store that does not place one agent when it moves, and keeps another one that is taken away.
class ForgetfulStore : public PlacedStore {
 public:
  static constexpr std::uint32_t kLost = 3, kKept = 4;

  void PlaceAll(const PlacedScene& /*scene*/, std::vector<PlacedBall>* horns) override {
    placed_.clear();
    for (const PlacedBall& horn : *horns) placed_.insert(horn.agent);
  }
  void Place(const PlacedBall& horn) override {
    if (horn.agent != kLost) placed_.insert(horn.agent);
  }
  void Unplace(std::uint32_t agent) override {
    if (agent != kKept) placed_.erase(agent);
  }
  bool Join(const PlacedScene& /*scene*/, TimeWindow /*window*/, SearchCost* /*cost*/,
            PairSink* /*sink*/) override {
    return true;
  }
  void FindNear(const PlacedScene& /*scene*/, const PlacedBall& /*horn*/, TimeWindow /*window*/,
                SearchCost* /*cost*/, std::vector<std::uint32_t>* /*near*/) override {}
  bool Holds(std::uint32_t agent) const override { return placed_.contains(agent); }
  void Validate() const override {}

 private:
  std::set<std::uint32_t> placed_;
};

/// Five agents in the store, after one query.
class ForgetfulSearch : public testing::Test {
 protected:
  ForgetfulSearch() {
    for (std::uint32_t agent = 0; agent < 5; ++agent) Move(agent);
    QueryAndValidate();
  }

  void Move(std::uint32_t agent) { search_.Set(agent, BoundIn(100, 1, 5, 1, &random_)); }

  /// In a debug build the query itself walks.
  void QueryAndValidate() {
    std::vector<Neighbour> found;
    const auto none = [](std::uint32_t) { return false; };
    search_.FindNeighbours(0, {kMethodStart, kMethodStart, kMethodStart}, none, &found);
    search_.Validate();
  }

  Random random_{6};
  WindowedSearch search_{std::make_unique<ForgetfulStore>()};
};

TEST_F(ForgetfulSearch, AnAgentThatIsNowhereIsTold) {
  Move(1);
  Move(ForgetfulStore::kKept);
  QueryAndValidate();
  Move(ForgetfulStore::kLost);
  EXPECT_NO_THROW(search_.Validate()) << "it is due to be placed";
  EXPECT_THROW(QueryAndValidate(), CheckFailure);
}

TEST_F(ForgetfulSearch, AnAgentThatIsPlacedButNotHeldIsTold) {
  search_.Remove(1);
  QueryAndValidate();
  search_.Remove(ForgetfulStore::kKept);
  EXPECT_NO_THROW(search_.Validate()) << "it is due to be taken away";
  EXPECT_THROW(QueryAndValidate(), CheckFailure);
}

TEST_F(ForgetfulSearch, AnAgentThatIsPlacedAndUnfilterableIsTold) {
  motion::SpaceTimeBound bound = BoundIn(0x1p61, 1, 5, 1, &random_);
  bound.state.p_WA.x() = 0x1p61;
  search_.Set(1, bound);
  QueryAndValidate();
  search_.Set(ForgetfulStore::kKept, bound);
  EXPECT_THROW(QueryAndValidate(), CheckFailure);
}

/// Lets a test put a half-space where the method does not expect it.
template <typename Method>
class WithHalfSpaces : public Method {
 public:
  using AgentBounds::mutable_half_spaces;
};

template <typename Method>
void ExpectAHalfSpaceOfAnAgentsIndexIsTold() {
  Random random(8);
  WithHalfSpaces<Method> method;
  method.Set(2, BoundIn(100, 1, 5, 1, &random));
  ASSERT_TRUE(method.SetHalfSpace(3, {}));
  method.Validate();
  ASSERT_TRUE(method.mutable_half_spaces().Set(2, {}));
  EXPECT_THROW(method.Validate(), CheckFailure);
}

TEST(Validate, TellsAHalfSpaceOfAnAgentsIndex) {
  ExpectAHalfSpaceOfAnAgentsIndexIsTold<AllPairs>();
  ExpectAHalfSpaceOfAnAgentsIndexIsTold<ExhaustiveIndex>();
  ExpectAHalfSpaceOfAnAgentsIndexIsTold<FaceSweep>();
  ExpectAHalfSpaceOfAnAgentsIndexIsTold<AdaptiveBroadPhase>();
}

TEST(Validate, TellsAHalfSpaceThatNoMethodHas) {
  WithHalfSpaces<AdaptiveBroadPhase> broad_phase;
  ASSERT_TRUE(broad_phase.SetHalfSpace(3, {}));
  broad_phase.Validate();
  ASSERT_TRUE(broad_phase.mutable_half_spaces().Set(4, {}));
  EXPECT_THROW(broad_phase.Validate(), CheckFailure);
  broad_phase.mutable_half_spaces().Remove(3);
  EXPECT_THROW(broad_phase.Validate(), CheckFailure) << "as many, but another";
  broad_phase.mutable_half_spaces().Remove(4);
  EXPECT_THROW(broad_phase.Validate(), CheckFailure) << "a method has one that it has not";
}

// Nothing may be tightened that is not held: a method takes it, the choice between methods does
// not count it.
TEST(Validate, TellsAnAgentThatOnlyAMethodHolds) {
  Random random(9);
  for (const std::uint32_t agent : {1u, 9u}) {
    AdaptiveBroadPhase broad_phase;
    broad_phase.Set(0, BoundIn(100, 1, 5, 1, &random));
    broad_phase.Set(2, BoundIn(100, 1, 5, 1, &random));
    broad_phase.Validate();
    broad_phase.Tighten(agent, BoundIn(100, 1, 5, 1, &random));
    EXPECT_THROW(broad_phase.Validate(), CheckFailure) << agent;
  }
}

// Method: up and down across the numbers of agents at which it changes, with half-spaces between.
TEST(Validate, MethodsAgreeWhileOneIsFilled) {
  Random random(10);
  AdaptiveBroadPhase broad_phase;
  for (int step = 0; step < 3000; ++step) {
    const bool grows = step / 600 % 2 == 0;
    const auto agent = static_cast<std::uint32_t>(random.Below(260));
    if (random.Chance(grows ? 0.1 : 0.9)) {
      broad_phase.Remove(agent);
    } else if (random.Chance(0.02)) {
      ASSERT_TRUE(broad_phase.SetHalfSpace(agent % 30, {}));
    } else {
      broad_phase.Set(agent, BoundIn(100, 1, 5, 1, &random));
    }
    ASSERT_NO_THROW(broad_phase.Validate()) << step;
  }
  EXPECT_GT(broad_phase.changes(), 2u);
}

TEST(Validate, ASearchWithoutAStoreIsRefused) {
  EXPECT_THROW(WindowedSearch(nullptr), CheckFailure);
}

}  // namespace
}  // namespace collision::broad_phase
