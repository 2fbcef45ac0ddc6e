// Goal:   of each pair the newest forecast is told, in the order of publication, and the gate knows
//         the newest of all.
// Method: forecasts in chosen orders.
#include "client/library/network/held_forecasts.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

/// All of one pair slot, which is given to one pair after another.
v1::CollisionEvent Forecast(std::uint32_t pair, std::uint64_t sequence) {
  v1::CollisionEvent event;
  event.mutable_higher()->set_slot(pair);
  event.mutable_stamp()->set_sequence(sequence);
  return event;
}

TEST(HeldForecasts, OfEachPairTheNewestInTheOrderOfPublication) {
  HeldForecasts forecasts;
  for (const auto& [pair, sequence] : {std::pair(1, 9), {2, 4}, {1, 7}, {3, 5}, {3, 6}}) {
    forecasts.Hold(Forecast(pair, sequence));
  }
  std::vector<std::uint64_t> sequences;
  for (const auto& event : forecasts.Take()) sequences.push_back(event.stamp().sequence());
  EXPECT_EQ(sequences, (std::vector<std::uint64_t>{4, 6, 9}));
  EXPECT_TRUE(forecasts.Take().empty());
}

TEST(HeldForecasts, OfEachLevelOne) {
  HeldForecasts forecasts;
  v1::CollisionEvent near = Forecast(1, 3);
  near.set_level("near");
  forecasts.Hold(near);
  forecasts.Hold(Forecast(1, 4));
  EXPECT_EQ(forecasts.Take().size(), 2u);
}

TEST(HeldForecasts, TheNewestCountsAlsoIfItIsAboutOthers) {
  HeldForecasts forecasts;
  EXPECT_EQ(forecasts.newest(), 0u);
  forecasts.Hear(Forecast(1, 9));
  forecasts.Hear(Forecast(2, 4));
  EXPECT_EQ(forecasts.newest(), 9u);
  EXPECT_TRUE(forecasts.Take().empty());
}

}  // namespace
}  // namespace collision::client
