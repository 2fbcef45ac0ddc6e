// Goal:   the structures of the index are whole after every step of a history, and a walk of them
//         tells a broken one; what a constructor requires is checked.
// Method: agents of all sizes come, move and go in random order, with queries in between; each
//         structure is walked after each step. A row is broken on purpose.
#include <gtest/gtest.h>

#include "collision_core/base/check.h"
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
  return {{x, 0, 0}, {1, 0, 0}, 1, 1, 0.5f, 0.25f, agent};
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

TEST(Validate, ASearchWithoutAStoreIsRefused) {
  EXPECT_THROW(WindowedSearch(nullptr), CheckFailure);
}

}  // namespace
}  // namespace collision::broad_phase
