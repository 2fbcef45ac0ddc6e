// Goal:   what a detector hands out of its agents lets another one go on with them: it finds the
//         same contacts from then on, and no bound is narrower than in the first.
// Method: agents on a line, taken over by a second detector in mid-flight; changes of declarations
//         that no state has followed yet.
#include <gtest/gtest.h>

#include "collision_core/shape/shape.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/meshes.h"

namespace collision::detection {
namespace {

std::vector<HeldAgent> HeldBy(const Detector& detector) {
  std::vector<HeldAgent> held;
  detector.ForEachAgent([&](const HeldAgent& one) { held.push_back(one); });
  return held;
}

/// A detector that goes on with what another one holds.
Line TakenOver(const Line& from) {
  Line next;
  next.now = from.now;
  next.agents = from.agents;
  for (const HeldAgent& held : HeldBy(from.detector)) {
    EXPECT_TRUE(next.detector.Admit(held.id, held.in_force, held.state, held.state.stamp));
    EXPECT_TRUE(next.detector.Redeclare(held.id, held.declared, held.state.stamp));
    next.detector.SetHeardUntil(OwnerOf(held.id), held.heard_until);
  }
  next.Step();
  return next;
}

TEST(HeldAgents, AreTakenOverInMidFlight) {
  Line first;
  first.Add(1, {0, 0, 0}, {0, 0, 0});
  first.Add(2, {22, 0, 0}, {-4, 0, 0});
  first.Add(3, {0, 500, 0}, {0, 0, 0});
  first.RunTo(2);
  Line second = TakenOver(first);
  first.events.clear();
  first.RunTo(7);
  second.RunTo(7);
  const auto expected = first.With(EventStatus::kConfirmed),
             found = second.With(EventStatus::kConfirmed);
  ASSERT_FALSE(found.empty());
  EXPECT_LE(found.back().begin.earliest, At(5)) << "|22 - 4 t| = 2";
  EXPECT_GE(found.back().begin.latest, At(5));
  EXPECT_EQ(found.back().begin.latest, expected.back().begin.latest);
  EXPECT_FALSE(found.back().began_before);
  EXPECT_EQ(second.With(EventStatus::kEnded).size(), 1u);
}

TEST(HeldAgents, HaveTheWiderBoundUntilTheNextState) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0}, 3);
  line.RunTo(1);
  ASSERT_TRUE(line.detector.Redeclare(Id(1), {.limits = {1, 0.5}}, At(1)));
  const auto held = HeldBy(line.detector);
  ASSERT_EQ(held.size(), 1u);
  EXPECT_EQ(held[0].id, Id(1));
  EXPECT_EQ(held[0].in_force.limits.radius, 3);
  EXPECT_EQ(held[0].in_force.limits.acceleration_max, 1);
  EXPECT_EQ(held[0].declared.limits.radius, 1);
  EXPECT_EQ(held[0].state.stamp, At(1));
  EXPECT_EQ(held[0].heard_until, At(1));
}

// Goal:   a shape that was declared anew is unknown up to the next state, in the second detector,
//         too: somewhere in the agent's ball, so that nothing there touches it for certain or is
//         certainly free of it. A third detector knows no more.
// Method: a ball within that of a cube, which was declared as a smaller one before the take-over.
TEST(HeldAgents, HaveNoShapeOnceItWasDeclaredAnew) {
  const std::shared_ptr<const shape::Shape> cube = shape::Shape::Build(Cube(1)),
                                            smaller = shape::Shape::Build(Cube(0.5));
  const double radius = cube->facts().radius;
  Line line;
  line.detector.Admit(Id(1), {.limits = {radius, 0}, .shape = cube}, State(0, {0, 0, 0}, {0, 0, 0}),
                      At(0));
  line.detector.Redeclare(Id(1), {.limits = {radius, 0}, .shape = smaller}, At(0));
  Line second = TakenOver(line), third = TakenOver(second);
  for (Line* one : {&second, &third}) {
    EXPECT_EQ(HeldBy(one->detector)[0].declared.shape, smaller);
    one->Add(2, {1.3, 0, 0}, {0, 0, 0}, 0.2);
    one->detector.SetHeardUntil(OwnerOf(Id(1)), At(1));
    one->RunTo(1);
    EXPECT_FALSE(one->With(EventStatus::kPossible).empty());
    EXPECT_TRUE(one->With(EventStatus::kConfirmed).empty()) << "it counts as a ball";
    EXPECT_TRUE(one->With(EventStatus::kDismissed).empty()) << "it has the smaller shape already";
  }
}

TEST(HeldAgents, AreNoneThatAreRemoved) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {9, 0, 0}, {0, 0, 0});
  line.RunTo(1);
  line.detector.Remove(Id(1));
  ASSERT_EQ(HeldBy(line.detector).size(), 1u);
  EXPECT_EQ(HeldBy(line.detector)[0].id, Id(2));
  EXPECT_EQ(line.detector.departing(), 1u);
  line.Step();
  EXPECT_EQ(line.detector.departing(), 0u) << "evaluated a last time";
}

}  // namespace
}  // namespace collision::detection
