// Goal:   an agent has the shape that it refers to exactly while that is visible and fits into its
//         ball; what is refused is told at once, what is missing in time; what no agent and no
//         writer needs is freed.
// Method: one simulator in a world without a bus, a store whose shapes are built when they are made
//         visible, and cubes.
#include "server/intake/agent_shapes.h"

#include <gtest/gtest.h>

#include "server/config/config.h"
#include "tests/server/shapes/shapes.h"

namespace collision::server {
namespace {

class AgentShapesTest : public testing::Test {
 protected:
  static constexpr std::int64_t kSecond = 1'000'000'000;

  static v1::Config MakeConfig() {
    v1::Config config;
    config.mutable_clock()->set_kind(v1::Clock::LOCK_STEP);
    config.set_undescribed_after_s(3);
    return CompleteConfig(config);
  }

  AgentShapesTest() {
    const std::string name = "alpha";
    alpha = world.ClaimFor(SimulatorId(name), 10, 1, &name).simulator;
    SetTime(0);
  }

  void SetTime(std::int64_t ns) { world.SetReading({.wall_ns = ns, .monotonic_ns = ns}); }

  /// An agent of this radius, in the detector, that refers to no shape yet.
  Agent* Add(std::uint32_t slot, double radius) {
    return Add(slot, {.limits = {.radius = radius}, .shape_awaited = true});
  }
  Agent* Add(std::uint32_t slot, const detection::AgentDeclaration& declaration) {
    Agent* agent = alpha->agents().Add(slot, {1, 1, declaration});
    motion::MotionState state;
    state.stamp = Instant::FromNanoseconds(0);
    EXPECT_TRUE(detectors.Admit(alpha->IdOf(slot, 1), declaration, state, state.stamp));
    alpha->agents().Admit(slot, state.stamp, 1);
    return agent;
  }
  void Refer(std::uint32_t slot, const std::string& to) {
    shapes.Refer(alpha, slot, to, alpha->agents().Find(slot));
  }
  void Write(const std::vector<v1::ShapePart>& sent) {
    for (const v1::ShapePart& part : sent) EXPECT_FALSE(store.Take(part));
  }
  void MakeReady(const std::string& which) {
    v1::ShapeReady ready;
    ready.set_content_hash(which);
    shapes.TakeReady(ready);
  }
  void ReportAt(std::int64_t ns) {
    SetTime(ns);
    shapes.ReportMissing();
  }
  /// The field of each rejection so far: all are of shapes.
  std::vector<std::string> TakeFields() {
    std::vector<std::string> fields;
    for (const v1::Rejection& rejection : rejections.Take()) {
      EXPECT_EQ(rejection.reason(), v1::REJECTED_BAD_SHAPE);
      fields.push_back(rejection.field());
      detail = rejection.detail();
    }
    return fields;
  }

  const v1::Config config = MakeConfig();
  World world{config};
  Detectors detectors{config};
  const detection::Detector& detector = detectors.contacts();
  Rejections rejections{100, &world};
  InlineShapeBuilder builder{BuildOptions{.triangles_max = 10000}};
  ShapeStore store{config, &builder, &world.quotas()};
  AgentShapes shapes{config, &world, &detectors, &rejections, &store};
  Simulator* alpha = nullptr;
  std::string detail;  // of the last rejection
  const std::string bytes = EncodeShape(Cube(1, UnusedFor(2)));
  const std::string hash = Sha256(bytes);
  const std::vector<v1::ShapePart> parts = PartsOf("alpha", bytes);
};

using Fields = std::vector<std::string>;

TEST_F(AgentShapesTest, AnAgentHasItsShapeFromWhenItIsReady) {
  Agent* agent = Add(0, 2);
  Refer(0, hash);
  Write(parts);
  EXPECT_EQ(agent->declaration.shape, nullptr);
  EXPECT_TRUE(agent->declaration.shape_awaited);
  MakeReady(hash);
  EXPECT_EQ(agent->declaration.shape, store.Find(hash));
  EXPECT_NE(agent->declaration.shape, nullptr);
  EXPECT_FALSE(agent->declaration.shape_awaited);
  EXPECT_EQ(agent->declaration.limits.radius, 2);
  EXPECT_EQ(detector.counters().widenings, 0u) << "it lowers no promise";
  EXPECT_TRUE(TakeFields().empty());
}

TEST_F(AgentShapesTest, TimeWaitsForAShapeWhileARealAgentRefersToIt) {
  for (const std::uint32_t slot : {0, 1})
    Add(slot, {.limits = {.radius = 2}, .filter = {.side = kHypotheticalSide}});
  for (const std::uint32_t slot : {2, 3}) Add(slot, 2);
  const auto waits_after = [this](std::uint32_t slot, const std::string& to) {
    Refer(slot, to);
    return shapes.wait().Holds(0);
  };
  EXPECT_FALSE(waits_after(0, hash)) << "a hypothetical agent holds no time";
  EXPECT_TRUE(waits_after(2, hash));
  EXPECT_TRUE(waits_after(3, hash));
  EXPECT_TRUE(waits_after(3, hash)) << "a revision with the same shape";
  EXPECT_TRUE(waits_after(1, hash));
  EXPECT_TRUE(waits_after(0, {}));
  EXPECT_TRUE(waits_after(2, {}));
  EXPECT_FALSE(waits_after(3, {})) << "the last real one";
  EXPECT_TRUE(waits_after(2, hash)) << "another attempt";
}

TEST_F(AgentShapesTest, AnAgentThatRefersToAReadyShapeHasItAtOnce) {
  Write(parts);
  MakeReady(hash);
  Agent* agent = Add(0, 2);
  Refer(0, hash);
  EXPECT_NE(agent->declaration.shape, nullptr);
  EXPECT_EQ(agent->shape_hash, hash);
  EXPECT_EQ(shapes.NextDue(), std::nullopt);
}

TEST_F(AgentShapesTest, OnlyAgentsThatReferToAShapeGetIt) {
  Agent* other = Add(1, 2);
  Add(0, 2);
  Refer(0, hash);
  Write(parts);
  MakeReady(hash);
  EXPECT_EQ(other->declaration.shape, nullptr);
}

TEST_F(AgentShapesTest, AShapeBeyondTheBallIsRefusedAndTheAgentStaysItsBall) {
  Agent* agent = Add(0, 1.5);
  Refer(0, hash);
  Write(parts);
  MakeReady(hash);
  EXPECT_EQ(TakeFields(), Fields{"radius_m"});
  EXPECT_EQ(agent->declaration.shape, nullptr);
  EXPECT_TRUE(agent->declaration.shape_awaited);
}

// Goal: an agent with a margin has its shape grown by it, the same body from description to
//       description, for as long as it refers to the shape.
TEST_F(AgentShapesTest, AnAgentWithAMarginHasItsShapeGrownByIt) {
  Write(parts);
  MakeReady(hash);
  Agent* agent = Add(0, 2.5);
  const auto refer = [&](const std::string& to, double margin) {
    agent->declaration.margin = margin;
    agent->declaration.shape = nullptr;
    agent->declaration.shape_awaited = !to.empty();
    Refer(0, to);
    return agent->declaration.shape;
  };
  const auto plain_bytes = world.quotas().Used(alpha->id(), Resource::kTreeBytes);
  const auto grown = refer(hash, 0.5);
  ASSERT_NE(grown, nullptr);
  EXPECT_NEAR(grown->facts().radius, store.Find(hash)->facts().radius + 0.5, 1e-12);
  EXPECT_GT(world.quotas().Used(alpha->id(), Resource::kTreeBytes), plain_bytes);
  EXPECT_EQ(refer(hash, 0.5), grown) << "described anew";
  EXPECT_NE(refer(hash, 0.25), grown);
  EXPECT_EQ(refer(hash, 0), store.Find(hash));
  EXPECT_EQ(world.quotas().Used(alpha->id(), Resource::kTreeBytes), plain_bytes);
  refer(hash, 0.5);
  refer("", 0.5);
  EXPECT_EQ(agent->grown, std::nullopt);
  EXPECT_TRUE(TakeFields().empty());
  EXPECT_EQ(refer(hash, 1), nullptr) << "beyond its ball";
  EXPECT_EQ(TakeFields(), Fields{"radius_m"});
}

// The sender's radius may be the corner's, rounded otherwise.
TEST_F(AgentShapesTest, ABallThatIsTooSmallByRoundingGrowsToItsShape) {
  Write(parts);
  MakeReady(hash);
  const double radius = store.Find(hash)->facts().radius;
  Agent* agent = Add(0, radius * (1 - 0.5 * wire::kShapeRadiusTolerance));
  Refer(0, hash);
  EXPECT_NE(agent->declaration.shape, nullptr);
  EXPECT_EQ(agent->declaration.limits.radius, radius);
  agent = Add(1, radius * (1 - 2 * wire::kShapeRadiusTolerance));
  Refer(1, hash);
  EXPECT_EQ(agent->declaration.shape, nullptr);
  EXPECT_EQ(TakeFields(), Fields{"radius_m"});
}

TEST_F(AgentShapesTest, AShapeThatIsMissingIsReportedOnceWhenItIsOverdue) {
  Add(0, 2);
  Refer(0, hash);
  EXPECT_EQ(shapes.NextDue(), 3 * kSecond);
  Refer(0, hash);  // a revision with the same shape
  Write({parts[0]});
  ReportAt(3 * kSecond - 1);
  EXPECT_TRUE(TakeFields().empty());
  ReportAt(3 * kSecond);
  EXPECT_EQ(TakeFields(), Fields{"shape_hash"});
  EXPECT_NE(detail.find("1 of 3 parts"), std::string::npos) << detail;
  ReportAt(9 * kSecond);
  EXPECT_TRUE(TakeFields().empty());
}

TEST_F(AgentShapesTest, AShapeIsNotReportedIfItIsWholeOrNoLongerReferredTo) {
  Add(0, 2);
  Refer(0, hash);
  Write(parts);
  Add(1, 2);
  Refer(1, Sha256("another"));
  Refer(1, {});
  ReportAt(4 * kSecond);
  EXPECT_TRUE(TakeFields().empty());
  EXPECT_EQ(shapes.NextDue(), std::nullopt);
}

TEST_F(AgentShapesTest, ABodyWithoutOneOfItsCornersIsReportedToItsWriter) {
  ShapeContent content = Cube(1);
  content.triangles[0] = {0, 1, 99};
  const std::string broken = EncodeShape(content);
  Agent* agent = Add(0, 2);
  Refer(0, Sha256(broken));
  Write(PartsOf("alpha", broken));
  MakeReady(Sha256(broken));
  EXPECT_EQ(TakeFields(), Fields{"bytes"});
  EXPECT_EQ(agent->declaration.shape, nullptr);
}

TEST_F(AgentShapesTest, AShapeIsKeptWhileAnAgentRefersToIt) {
  Add(0, 2);
  Refer(0, hash);
  Write(parts);
  MakeReady(hash);
  for (std::uint32_t part = 0; part < parts.size(); ++part) store.Dispose(alpha->id(), hash, part);
  EXPECT_NE(store.Find(hash), nullptr);
  Refer(0, Sha256("another"));
  EXPECT_EQ(store.Find(hash), nullptr);
}

TEST_F(AgentShapesTest, WhatASimulatorThatLeftHadWrittenIsFreed) {
  Write(parts);
  MakeReady(hash);
  shapes.ReleaseLeft();
  EXPECT_NE(store.Find(hash), nullptr);
  alpha->SetAlive(false, 0);
  ASSERT_TRUE(alpha->has_left());
  shapes.ReleaseLeft();
  EXPECT_EQ(store.Find(hash), nullptr);
}

// Its trees come one after the other; the owner has been told with the first.
TEST_F(AgentShapesTest, ACoarseTreeIsReplacedAndAShapeThatDidNotFitIsNotReportedAgain) {
  const std::string fine = EncodeShape(FineCube(20));
  Agent* fits = Add(0, 2);
  Agent* does_not = Add(1, 1.5);
  for (const std::uint32_t slot : {0, 1}) Refer(slot, Sha256(fine));
  Write(PartsOf("alpha", fine));
  v1::ShapeReady coarse;
  coarse.set_content_hash(Sha256(fine));
  coarse.set_coarse(true);
  shapes.TakeReady(coarse);
  const std::shared_ptr<const shape::Shape> first = fits->declaration.shape;
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(TakeFields(), Fields{"radius_m"});
  MakeReady(Sha256(fine));
  EXPECT_NE(fits->declaration.shape, first);
  EXPECT_TRUE(fits->declaration.shape->IsSameBodyAs(*first));
  EXPECT_EQ(does_not->declaration.shape, nullptr);
  EXPECT_TRUE(TakeFields().empty());
}

}  // namespace
}  // namespace collision::server
