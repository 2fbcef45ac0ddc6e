// Goal:   of each agent half the margin counts as its body: never less, and no more than a rounding
//         more; a shape that cannot be grown counts as anywhere in its agent's ball.
// Method: what the detector is given of balls of random sizes, of a floor, and of cubes.
#include "server/detectors/grown_detector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "collision_core/shape/fixed_half_space.h"
#include "server/config/config.h"
#include "server/detectors/detector_options.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

using detection::AgentDeclaration;
using ShapePtr = std::shared_ptr<const shape::Shape>;

constexpr std::uint64_t kAmple = 1 << 30;

class GrownDetectorTest : public testing::Test {
 protected:
  GrownDetector Of(double margin, std::uint64_t shape_bytes_max = kAmple) const {
    return {LevelDetectorOptions(config_, 1, 2), margin, &level_, shape_bytes_max};
  }

  static detection::AgentId Id(std::uint32_t slot) { return {1, slot, 1, 1}; }

  static AgentDeclaration Ball(double radius, double margin = 0) {
    AgentDeclaration ball;
    ball.limits.radius = radius;
    ball.margin = margin;
    return ball;
  }

  /// As the service does: the ball of the shape.
  static AgentDeclaration Of(const ShapePtr& shape) {
    AgentDeclaration declaration = Ball(shape->facts().radius);
    declaration.shape = shape;
    return declaration;
  }

  static void Admit(const AgentDeclaration& declaration, std::uint32_t slot,
                    GrownDetector* detector) {
    motion::MotionState state;
    state.p_WA.x() = 1000.0 * slot;
    detector->Admit(Id(slot), declaration, state, Instant());
  }

  static AgentDeclaration Grown(const GrownDetector& detector, std::uint32_t slot) {
    AgentDeclaration grown;
    detector.detector().ForEachAgent([&](const detection::HeldAgent& held) {
      if (held.id == Id(slot)) grown = held.declared;
    });
    return grown;
  }

  const v1::Config config_ = CompleteConfig({});
  const Level level_;
};

/// a + b <= sum < a + b by a rounding. Exact: neither is 1000 times the other, so that their sum
/// has no more digits than a long double.
testing::AssertionResult IsSumRoundedUp(double sum, double a, double b) {
  const long double exact = static_cast<long double>(a) + b;
  if (sum >= exact && std::nextafter(sum, 0) < exact) return testing::AssertionSuccess();
  return testing::AssertionFailure() << sum << " of " << a << " and " << b;
}

TEST_F(GrownDetectorTest, RadiusAndMarginGrowByHalfTheMarginRoundedUp) {
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const double radius = random.Uniform(1, 30), own = random.Uniform(1, 30);
    const double margin = random.Uniform(1, 30);
    GrownDetector detector = Of(margin);
    Admit(Ball(radius, own), 0, &detector);
    EXPECT_TRUE(IsSumRoundedUp(Grown(detector, 0).limits.radius, radius, margin / 2));
    EXPECT_TRUE(IsSumRoundedUp(Grown(detector, 0).margin, own, margin / 2));
    detector.Redeclare(Id(0), Ball(radius + 1, own), Instant());
    EXPECT_GT(Grown(detector, 0).limits.radius, radius + 1);
  }
}

TEST_F(GrownDetectorTest, AHalfSpaceGrowsAlongItsNormal) {
  GrownDetector detector = Of(3);
  AgentDeclaration floor;
  floor.half_space = shape::FixedHalfSpace::Build({0, 0, 1}, 0.1);
  Admit(floor, 0, &detector);
  EXPECT_TRUE(IsSumRoundedUp(Grown(detector, 0).half_space->offset(), 0.1, 1.5));
  EXPECT_EQ(Grown(detector, 0).half_space->normal(), floor.half_space->normal());
}

// Goal:   the grown shape lies within its agent's ball, and reaches half the margin farther; agents
//         of one shape share it.
TEST_F(GrownDetectorTest, AShapeGrowsAndItsBallHoldsIt) {
  Random random(8);
  for (int i = 0; i < 20; ++i) {
    const double margin = random.LogUniform(0.1, 10);
    GrownDetector detector = Of(margin);
    const ShapePtr cube = shape::Shape::Build(Cube(random.LogUniform(0.1, 10)));
    for (const std::uint32_t slot : {0u, 1u}) Admit(Of(cube), slot, &detector);
    const AgentDeclaration grown = Grown(detector, 0);
    ASSERT_NE(grown.shape, nullptr);
    EXPECT_FALSE(grown.shape_awaited);
    EXPECT_GE(grown.shape->facts().radius, cube->facts().radius + margin / 2);
    EXPECT_GE(grown.limits.radius, grown.shape->facts().radius);
    EXPECT_EQ(Grown(detector, 1).shape, grown.shape);
  }
}

TEST_F(GrownDetectorTest, ATwinStaysTheSameBody) {
  const geometry::TriangleMesh mesh = Cube(1);
  const ShapePtr coarse = shape::Shape::Build(mesh, {.triangles_per_leaf = 16});
  const ShapePtr fine = shape::Shape::Build(mesh, {}, coarse.get());
  ASSERT_TRUE(fine->IsSameBodyAs(*coarse));
  GrownDetector detector = Of(1);
  Admit(Of(coarse), 0, &detector);
  const ShapePtr before = Grown(detector, 0).shape;
  detector.Redeclare(Id(0), Of(fine), Instant());
  const ShapePtr after = Grown(detector, 0).shape;
  EXPECT_NE(after, before);
  EXPECT_TRUE(after->IsSameBodyAs(*before));
}

TEST_F(GrownDetectorTest, AShapeWithoutRoomCountsAsAnywhereInItsBall) {
  const ShapePtr cube = shape::Shape::Build(Cube(1)), other = shape::Shape::Build(Cube(2));
  GrownDetector measure = Of(1);
  Admit(Of(cube), 0, &measure);
  GrownDetector detector = Of(1, measure.shape_bytes());
  Admit(Of(cube), 0, &detector);
  Admit(Of(other), 1, &detector);
  EXPECT_NE(Grown(detector, 0).shape, nullptr);
  EXPECT_EQ(Grown(detector, 1).shape, nullptr);
  EXPECT_TRUE(Grown(detector, 1).shape_awaited);
  EXPECT_GE(Grown(detector, 1).limits.radius, other->facts().radius + 0.5);
  EXPECT_LE(detector.shape_bytes(), measure.shape_bytes());
}

// Goal:   the room of a shape is free again once no agent has it, and not before.
TEST_F(GrownDetectorTest, AShapeIsKeptWhileAnAgentHasIt) {
  const ShapePtr cube = shape::Shape::Build(Cube(1));
  GrownDetector detector = Of(1);
  for (const std::uint32_t slot : {0u, 1u}) Admit(Of(cube), slot, &detector);
  const std::uint64_t bytes = detector.shape_bytes();
  detector.Remove(Id(0));
  detector.Advance(Instant::FromNanoseconds(1), nullptr);
  EXPECT_EQ(detector.shape_bytes(), bytes);
  Admit(Of(cube), 2, &detector);
  EXPECT_EQ(Grown(detector, 2).shape, Grown(detector, 1).shape);
  for (const std::uint32_t slot : {1u, 2u}) detector.Remove(Id(slot));
  detector.Advance(Instant::FromNanoseconds(2), nullptr);
  EXPECT_EQ(detector.shape_bytes(), 0u);
}

}  // namespace
}  // namespace collision::server
