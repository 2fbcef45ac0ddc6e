// Goal:   a shape is grown once for all agents of a simulator with its margin, counts against its
//         simulator's trees while one uses it, and is refused beyond; twins stay twins.
// Method: a world of two simulators; cubes and sheets.
#include "server/shapes/grown_shapes.h"

#include <gtest/gtest.h>

#include "idl/identity.h"
#include "server/config/config.h"
#include "tests/support/meshes.h"

namespace collision::server {
namespace {

class GrownShapesTest : public testing::Test {
 protected:
  GrownShapesTest() {
    quotas.Enter(1, "a");
    quotas.Enter(2, "b");
  }
  static v1::Config ConfigOf() {
    v1::Config config;
    config.set_simulators_max(2);
    return CompleteConfig(config);
  }
  std::shared_ptr<const shape::Shape> Use(GrownShapes* grown, const GrownShapes::Key& key,
                                          const std::shared_ptr<const shape::Shape>& shape) {
    const GrownShapes::Grown result = grown->Use(key, shape);
    refusal = std::holds_alternative<std::string>(result) ? std::get<std::string>(result) : "";
    return refusal.empty() ? std::get<0>(result) : nullptr;
  }
  std::uint64_t Used(std::uint64_t simulator) const {
    return quotas.Used(simulator, Resource::kTreeBytes);
  }

  const v1::Config config = ConfigOf();
  SimulatorQuotas quotas{config};
  const std::shared_ptr<const shape::Shape> cube = shape::Shape::Build(Cube(1));
  std::string refusal;
};

TEST_F(GrownShapesTest, AgentsOfASimulatorShareIt) {
  GrownShapes grown(config.tree_bytes_max(), &quotas);
  const auto first = Use(&grown, {1, "h", 0.5}, cube);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(Use(&grown, {1, "h", 0.5}, cube), first);
  EXPECT_NE(Use(&grown, {1, "h", 0.25}, cube), first);
  EXPECT_NE(Use(&grown, {2, "h", 0.5}, cube), first);
  EXPECT_EQ(Used(1) + Used(2), grown.bytes());
  EXPECT_EQ(Used(1), 2 * Used(2));
  grown.Drop({1, "h", 0.5});
  EXPECT_EQ(Use(&grown, {1, "h", 0.5}, cube), first) << "one agent still uses it";
  for (int i = 0; i < 2; ++i) grown.Drop({1, "h", 0.5});
  grown.Drop({1, "h", 0.25});
  grown.Drop({2, "h", 0.5});
  EXPECT_EQ(grown.bytes(), 0u);
  EXPECT_EQ(Used(1) + Used(2), 0u);
}

TEST_F(GrownShapesTest, AFinerTreeTakesThePlaceOfTheCoarseOne) {
  GrownShapes grown(config.tree_bytes_max(), &quotas);
  const auto fine =
      shape::Shape::Build(Cube(1), {.builder = sphere_tree::TreeBuilder::kFitted}, cube.get());
  const auto before = Use(&grown, {1, "h", 0.5}, cube);
  const auto after = Use(&grown, {1, "h", 0.5}, fine);
  ASSERT_NE(after, nullptr);
  EXPECT_NE(after, before);
  EXPECT_TRUE(after->IsSameBodyAs(*before));
  EXPECT_EQ(Used(1), after->bytes());
  for (int i = 0; i < 2; ++i) grown.Drop({1, "h", 0.5});
  EXPECT_EQ(Used(1), 0u);
}

TEST_F(GrownShapesTest, WhatDoesNotFitIsRefused) {
  GrownShapes tight(1000, &quotas);
  EXPECT_EQ(Use(&tight, {1, "h", 0.5}, cube), nullptr);
  EXPECT_EQ(refusal.substr(0, 15), "0.5; no room fo") << refusal;
  EXPECT_EQ(Used(1), 0u);
  GrownShapes grown(config.tree_bytes_max(), &quotas);
  EXPECT_EQ(Use(&grown, {1, "s", 0.5}, shape::Shape::Build(Sheet(1, 46))), nullptr);
  EXPECT_EQ(refusal,
            "0.5 with a shape of 4232 triangles and 0 solids; allowed with a margin: 4096 of both. "
            "The agent stays its ball");
}

}  // namespace
}  // namespace collision::server
