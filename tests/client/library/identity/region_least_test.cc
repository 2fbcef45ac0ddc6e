// Goal:   with one region a clearance is as told; with several the least of all counts, and a
//         region that has not spoken allows nothing.
// Method: samples of two regions by hand.
#include "client/library/identity/region_least.h"

#include <gtest/gtest.h>

#include <limits>

namespace collision::client {
namespace {

v1::Clearance Chunk(std::uint32_t region, std::int64_t granted_ns, std::int64_t clear_ns) {
  v1::Clearance chunk;
  chunk.set_simulator_id(9);
  chunk.set_region(region);
  chunk.set_granted_until_ns(granted_ns);
  v1::AgentClearance& agent = *chunk.add_agents();
  agent.set_slot(3);
  agent.set_generation(1);
  agent.set_clear_until_ns(clear_ns);
  agent.set_state_wanted_ns(clear_ns - 1);
  return chunk;
}

TEST(RegionLeast, OneRegionIsAsTold) {
  RegionLeast least;
  const v1::Clearance told = Chunk(0, 10, 20);
  EXPECT_EQ(&least.Take(told, {}), &told);
  EXPECT_EQ(&least.Take(told, {0}), &told);
}

TEST(RegionLeast, OfSeveralTheLeastCounts) {
  RegionLeast least;
  const v1::Clearance& first = least.Take(Chunk(1, 10, 20), {1, 2});
  EXPECT_EQ(first.granted_until_ns(), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(first.agents_size(), 0) << "region 2 has not spoken";
  const v1::Clearance& both = least.Take(Chunk(2, 30, 15), {1, 2});
  EXPECT_EQ(both.granted_until_ns(), 10);
  ASSERT_EQ(both.agents_size(), 1);
  EXPECT_EQ(both.agents(0).clear_until_ns(), 15);
  EXPECT_EQ(both.agents(0).state_wanted_ns(), 14);
  EXPECT_EQ(least.Take(Chunk(1, 40, 50), {1, 2}).granted_until_ns(), 30);
  least.Clear();
  EXPECT_EQ(least.Take(Chunk(1, 40, 50), {1, 2}).agents_size(), 0);
}

TEST(RegionLeast, AnAgentThatOneRegionDoesNotNameHasNoPromise) {
  RegionLeast least;
  v1::Clearance without = Chunk(2, 30, 15);
  without.mutable_agents(0)->set_generation(2);
  least.Take(without, {1, 2});
  EXPECT_EQ(least.Take(Chunk(1, 10, 20), {1, 2}).agents_size(), 0);
}

}  // namespace
}  // namespace collision::client
