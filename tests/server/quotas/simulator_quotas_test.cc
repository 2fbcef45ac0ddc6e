#include "server/quotas/simulator_quotas.h"

#include <gtest/gtest.h>

#include "idl/identity.h"
#include "server/config/config.h"

namespace collision::server {
namespace {

v1::Config Parsed(const std::string& text) {
  const ConfigResult result = ParseConfig(text, "F");
  EXPECT_TRUE(result.ok());
  return result.config;
}

// Goal:   the first block that fits counts; what it leaves out, and without a block everything, is
//         the limit of the world, with an equal part guaranteed.
TEST(SimulatorQuotas, TheFirstBlockThatFitsCounts) {
  const v1::Config config = Parsed(
      "simulators_max: 9 agents_max: 100 "
      "limits { name: \"a\" agents_max: 3 } limits { name: \"*\" guaranteed: 0.25 agents_max: 50 "
      "}");
  EXPECT_EQ(ShareOf(config, "a", Resource::kAgents).max, 3u);
  EXPECT_EQ(ShareOf(config, "a", Resource::kAgents).guaranteed, 3u) << "10, but it has 3 at most";
  EXPECT_EQ(ShareOf(config, "a", Resource::kShapes).max, config.shapes_max());
  EXPECT_EQ(ShareOf(config, "b", Resource::kAgents).max, 50u);
  EXPECT_EQ(ShareOf(config, "b", Resource::kAgents).guaranteed, 25u);
  const v1::Config none = CompleteConfig({});
  EXPECT_EQ(ShareOf(none, "b", Resource::kAgents).max, 1000u);
  EXPECT_EQ(ShareOf(none, "b", Resource::kAgents).guaranteed, 15u);
  EXPECT_EQ(ShareOf(none, "b", Resource::kPairs).max, 65536u - 1008u) << "kept for a newcomer";
}

// Goal:   a guarantee is kept for a simulator of the world as long as it is there, for one that is
//         named always; one that is alone may have everything.
TEST(SimulatorQuotas, GuaranteesAreKept) {
  SimulatorQuotas quotas(Parsed("simulators_max: 9 agents_max: 100"));
  quotas.Enter(1, "a");
  EXPECT_EQ(quotas.RoomFor(1, Resource::kAgents, 100), 100u);
  quotas.Enter(2, "b");
  quotas.Enter(2, "b");
  EXPECT_EQ(quotas.RoomFor(1, Resource::kAgents, 100), 90u);
  quotas.Take(1, Resource::kAgents, 90);
  EXPECT_EQ(quotas.RoomFor(1, Resource::kAgents, 10), 0u);
  EXPECT_EQ(quotas.RoomFor(2, Resource::kAgents, 10), 10u);
  quotas.Keep([](std::uint64_t id) { return id == 1; });
  EXPECT_EQ(quotas.RoomFor(1, Resource::kAgents, 10), 10u);
  quotas.GiveBack(1, Resource::kAgents, 90);
  EXPECT_EQ(quotas.Used(1, Resource::kAgents), 0u);

  SimulatorQuotas named(Parsed("agents_max: 100 limits { name: \"vip\" guaranteed: 0.3 }"));
  named.Enter(1, "a");
  named.Keep([](std::uint64_t id) { return id == 1; });
  EXPECT_EQ(named.RoomFor(1, Resource::kAgents, 100), 70u);
  EXPECT_EQ(named.RoomFor(SimulatorId("vip"), Resource::kAgents, 30), 29u)
      << "less what is kept for the other";
}

}  // namespace
}  // namespace collision::server
