// Goal:   with margins a contact begins where two agents come within the sum of them, and ends
//         where they leave it, in certified brackets, for balls, solids and surfaces alike; a pair
//         that keeps its distance is no contact; events tell the margin.
// Method: bodies on lines that pass each other at exact times.
#include <gtest/gtest.h>

#include <cmath>

#include "collision_core/numeric/rounding.h"
#include "collision_core/shape/grown_shape.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/meshes.h"

namespace collision::detection {
namespace {

enum class Kind { kBall, kSolid, kSurface };

std::shared_ptr<const shape::Shape> ShapeOf(Kind kind) {
  if (kind == Kind::kBall) return nullptr;
  if (kind == Kind::kSurface) return shape::Shape::Build(Cube(0.5));
  return shape::Shape::Compound(
      nullptr, {shape::ConvexSolid::Build(
                   {.core = geometry::ConvexCore::kBox, .half = {0.5, 0.5, 0.5}, .points = {}})});
}

/// A cube of 1 m, or a ball of that diameter, as an edge makes it of a description.
AgentDeclaration WithMargin(Kind kind, double margin) {
  AgentDeclaration declaration;
  declaration.limits.radius = 0.5;
  declaration.limits.acceleration_max = 0.01;
  declaration.limits.angular_acceleration_max = 0;
  declaration.shape = ShapeOf(kind);
  if (declaration.shape) declaration.limits.radius = declaration.shape->facts().radius;
  if (margin == 0) return declaration;
  declaration.margin = margin;
  declaration.limits.radius = numeric::AddUp(declaration.limits.radius, margin);
  if (declaration.shape) {
    declaration.shape = GrownShape(declaration.shape, margin);
    declaration.limits.radius =
        std::max(declaration.limits.radius, declaration.shape->facts().radius);
  }
  return declaration;
}

class MarginTest : public testing::TestWithParam<Kind> {
 protected:
  /// B passes A at 2 m/s along x, `aside` of it along y; returns the events.
  std::vector<CollisionEvent> Pass(double margin_a, double margin_b, double aside) {
    Line line;
    Put(&line, 1, margin_a, {0, 0, 0}, {0, 0, 0});
    Put(&line, 2, margin_b, {4, aside, 0}, {-2, 0, 0});
    line.RunTo(5);
    return line.events;
  }

  void Put(Line* line, std::uint32_t slot, double margin, const Vector3d& p, const Vector3d& v) {
    line->detector.Admit(Id(slot), WithMargin(GetParam(), margin), State(0, p, v), At(0));
    line->agents.push_back({slot, p, v, 0});
  }
};

void ExpectWithin(const TimeBracket& bracket, double truth, double width) {
  EXPECT_LE(bracket.earliest, At(truth));
  EXPECT_GE(bracket.latest, At(truth));
  EXPECT_GE(bracket.earliest, At(truth - width));
  EXPECT_LE(bracket.latest, At(truth + width));
}

TEST_P(MarginTest, AContactBeginsAndEndsWhereTheSumOfTheMarginsIsReached) {
  for (const auto& [a, b] : {std::pair(0.0, 0.0), {0.25, 0.0}, {0.0, 0.5}, {0.125, 0.375}}) {
    // A cube meets the other one's face, a ball the other ball beside its middle.
    const double reach =
        GetParam() == Kind::kBall ? std::sqrt((1 + a + b) * (1 + a + b) - 0.09) : 1 + a + b;
    const std::vector<CollisionEvent> events = Pass(a, b, 0.3);
    ASSERT_FALSE(events.empty());
    const CollisionEvent& last = events.back();
    EXPECT_EQ(last.status, EventStatus::kEnded) << a << " " << b;
    // Faces of several triangles part all at once: that is known at the next state.
    const double width = GetParam() == Kind::kSurface ? 1.0 / 16 : 0.02;
    ExpectWithin(last.begin, (4 - reach) / 2, width);
    ExpectWithin(last.end, (4 + reach) / 2, width);
    for (const CollisionEvent& event : events) EXPECT_EQ(event.margin, a + b);
  }
}

TEST_P(MarginTest, APairThatKeepsItsDistanceIsNoContact) {
  const auto confirmed = [](const std::vector<CollisionEvent>& events) {
    return std::any_of(events.begin(), events.end(), [](const CollisionEvent& event) {
      return event.status == EventStatus::kConfirmed;
    });
  };
  EXPECT_FALSE(confirmed(Pass(0, 0, 1.25)));
  EXPECT_FALSE(confirmed(Pass(0.05, 0.05, 1.25)));
  EXPECT_TRUE(confirmed(Pass(0.25, 0.05, 1.25)));
}

std::string NameOf(const testing::TestParamInfo<Kind>& test) {
  const char* names[] = {"Balls", "Solids", "Surfaces"};
  return names[static_cast<int>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(All, MarginTest,
                         testing::Values(Kind::kBall, Kind::kSolid, Kind::kSurface), NameOf);

}  // namespace
}  // namespace collision::detection
