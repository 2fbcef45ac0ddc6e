// Goal:   events of agents with shapes: contacts confirmed with brackets that contain the truth,
//         near passes dismissed, shapes that arrive late or change, jumps, containment; the same
//         calls give the same events.
// Method: few agents on lines whose contacts are exact; states 64 times a second, one clock.
#include <gtest/gtest.h>

#include "collision_core/shape/shape.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/meshes.h"

namespace collision::detection {
namespace {

// Enough for twenty triangles face to face, of which many pairs are equally near.
constexpr std::uint64_t kUnits = 100000;

const std::shared_ptr<const shape::Shape>& Ship() {
  static const auto ship = shape::Shape::Build(LShape());
  return ship;
}

AgentDeclaration Declared(const std::shared_ptr<const shape::Shape>& shape, double radius,
                          double M = 1) {
  AgentDeclaration declaration;
  declaration.limits.radius = radius;
  declaration.limits.acceleration_max = M;
  declaration.limits.angular_acceleration_max = 0.5;
  declaration.shape = shape;
  return declaration;
}

AgentDeclaration Awaited(double radius) {
  AgentDeclaration declaration = Declared(nullptr, radius);
  declaration.shape_awaited = true;
  return declaration;
}

// Agents on lines that do not turn; the detector receives states 64 times a second.
class Scene : public Line {
 public:
  explicit Scene(std::uint64_t units = kUnits) : Line(WithBudget(units)) {}

  static DetectorOptions WithBudget(std::uint64_t units) {
    DetectorOptions options;
    options.work_units_per_evaluation = units;
    return options;
  }

  void Put(std::uint32_t slot, const AgentDeclaration& declaration, const Vector3d& p,
           const Vector3d& v) {
    detector.Admit(Id(slot), declaration, State(now, p, v), At(now));
    agents.push_back({slot, p, v, now});
  }

  void Run(double end) {
    while (now < end) {
      now += 1.0 / 64;
      for (const Mover& agent : agents) {
        const double dt = now - agent.since;
        detector.Update(Id(agent.slot), State(now, agent.p + agent.v * dt, agent.v), At(now));
        detector.SetHeardUntil(OwnerOf(Id(agent.slot)), At(now));
      }
      Step();
      for (const Mover& agent : agents) {
        const auto clearance = detector.ClearanceOf(Id(agent.slot));
        if (clearance && clearance->not_clear && !clearance->in_contact) ++not_clear;
      }
    }
  }
  int not_clear = 0;
};

void ExpectBracket(const TimeBracket& bracket, double truth, double width) {
  EXPECT_LE(bracket.earliest, At(truth));
  EXPECT_GE(bracket.earliest, At(truth - width));
  EXPECT_GE(bracket.latest, At(truth));
  EXPECT_LE(bracket.latest, At(truth + width));
}

// The arm of the L (y < 0) meets the other's: 1 and 1 from the middles, as reference points lie
// there.
TEST(DetectorShapes, ConfirmedAndEndedWithinTheirBrackets) {
  Scene scene;
  scene.Put(1, Declared(Ship(), 2), {0, 0, 0}, {0, 0, 0});
  scene.Put(2, Declared(Ship(), 2), {8, 0, 0.1}, {-2, 0, 0});
  scene.Run(8);
  ASSERT_EQ(scene.With(EventStatus::kPossible).size() > 0, true);
  const auto confirmed = scene.With(EventStatus::kConfirmed);
  const auto ended = scene.With(EventStatus::kEnded);
  ASSERT_GE(confirmed.size(), 1u);
  ASSERT_EQ(ended.size(), 1u);
  EXPECT_EQ(scene.With(EventStatus::kUndecided).size(), 0u);
  ExpectBracket(ended[0].begin, 3, 1e-3);
  ExpectBracket(ended[0].end, 5, 1e-3);
  EXPECT_TRUE(ended[0].continuous);
  for (const CollisionEvent& event : confirmed) {
    EXPECT_LE(event.separation_lower, event.separation_upper);
    EXPECT_LE(event.separation_upper, 0);
    EXPECT_LT(event.normal_error, 0.2);
    EXPECT_LE((event.normal - Vector3d(1, 0, 0)).norm(), event.normal_error);
    EXPECT_LT(event.point_error, 0.5);
    EXPECT_NEAR(event.p_WC.x(), 1, event.point_error + 1e-3);
    EXPECT_GT(event.work, 0u);
  }
}

TEST(DetectorShapes, PassWithinTheBallsButNotTheMeshesIsNeverConfirmed) {
  Scene scene;
  const auto rod = shape::Shape::Build(Rod(2, 0.1));
  scene.Put(1, Declared(rod, 2.1), {0, 0, 0}, {0, 0, 0});
  scene.Put(2, Declared(rod, 2.1), {12, 0.5, 0.2}, {-4, 0, 0});
  scene.Run(10);
  EXPECT_EQ(scene.With(EventStatus::kConfirmed).size(), 0u);
  EXPECT_EQ(scene.With(EventStatus::kUndecided).size(), 0u);
  EXPECT_GE(scene.With(EventStatus::kPossible).size(), 1u);
  EXPECT_GE(scene.With(EventStatus::kDismissed).size(), 1u);
  // 0.3 m apart at 4 m/s and 1 m/s² each: always free for a while.
  EXPECT_EQ(scene.not_clear, 0);
}

TEST(DetectorShapes, AwaitedShapeIsPossibleAndNeverConfirmed) {
  Scene scene;
  scene.Put(1, Declared(Ship(), 2), {0, 0, 0}, {0, 0, 0});
  scene.Put(2, Awaited(2), {8, 0, 0}, {-2, 0, 0});
  scene.Run(9);
  EXPECT_GE(scene.With(EventStatus::kPossible).size(), 1u);
  EXPECT_EQ(scene.With(EventStatus::kConfirmed).size(), 0u);
  ASSERT_EQ(scene.With(EventStatus::kUndecided).size(), 1u);
  const CollisionEvent event = scene.With(EventStatus::kUndecided)[0];
  EXPECT_LE(event.begin.earliest, At(3));
  EXPECT_GE(event.end.latest, At(5));
  EXPECT_EQ(event.normal_error, std::numbers::pi);
  EXPECT_EQ(event.depth_lower, 0);
}

TEST(DetectorShapes, ArrivalCountsAtOnce) {
  for (const double arrival : {2.5, 3.5}) {
    Scene scene;
    scene.Put(1, Declared(Ship(), 2), {0, 0, 0}, {0, 0, 0});
    scene.Put(2, Awaited(2), {8, 0, 0.1}, {-2, 0, 0});
    scene.Run(arrival);
    ASSERT_TRUE(scene.detector.Redeclare(Id(2), Declared(Ship(), 2), At(scene.now)));
    scene.detector.SetHeardUntil(OwnerOf(Id(2)), At(scene.now));
    scene.Run(8);
    const auto ended = scene.With(EventStatus::kEnded);
    ASSERT_EQ(ended.size(), 1u) << arrival;
    EXPECT_LE(ended[0].begin.earliest, At(3));
    EXPECT_GE(ended[0].begin.latest, At(3));
    EXPECT_LE(ended[0].begin.latest, At(std::max(3.0, arrival) + 0.05)) << arrival;
    ExpectBracket(ended[0].end, 5, 1e-3);
    EXPECT_EQ(scene.detector.counters().widenings, 0u);
  }
}

TEST(DetectorShapes, ChangedShapeIsUnknownUntilTheNextState) {
  Scene scene;
  const auto rod = shape::Shape::Build(Rod(2, 0.1));
  // Thin, they pass each other at 0.5 m; the ship that the second becomes at 2.75 s reaches across.
  scene.Put(1, Declared(rod, 2.1), {0, 0, 0}, {0, 0, 0});
  scene.Put(2, Declared(rod, 2.1), {8, 0.7, 0}, {-2, 0, 0});
  scene.Run(1.5);
  scene.detector.TakeChangedClearances();
  ASSERT_TRUE(scene.detector.Redeclare(Id(2), Declared(Ship(), 2.1), At(scene.now)));
  scene.detector.Advance(At(scene.now));
  EXPECT_GE(scene.detector.counters().widenings, 1u);
  EXPECT_EQ(scene.With(EventStatus::kConfirmed).size(), 0u);
  scene.Run(8);
  const auto ended = scene.With(EventStatus::kEnded);
  ASSERT_EQ(ended.size(), 1u);
  // 2 and 1 from the middles.
  ExpectBracket(ended[0].begin, 2.5, 1e-3);
  ExpectBracket(ended[0].end, 5.5, 1e-3);
}

// Both stand where the ships overlap; nothing but declarations comes after the first states.
struct Standing : Scene {
  explicit Standing(const AgentDeclaration& second) {
    Put(1, Declared(Ship(), 2), {0, 0, 0}, {0, 0, 0});
    Put(2, second, {1.5, 0, 0.1}, {0, 0, 0});
    Step();
  }

  std::size_t ConfirmedAfter(const AgentDeclaration& second) {
    detector.Redeclare(Id(2), second, At(now));
    detector.SetHeardUntil(OwnerOf(Id(1)), At(now + 0.0625));
    detector.SetHeardUntil(OwnerOf(Id(2)), At(now + 0.0625));
    now += 0.0625;
    Step();
    return With(EventStatus::kConfirmed).size();
  }
};

TEST(DetectorShapes, WithoutAStateOnlyAnArrivalCounts) {
  EXPECT_EQ(Standing(Awaited(2)).ConfirmedAfter(Declared(Ship(), 2)), 1u);
  EXPECT_EQ(Standing(Awaited(2)).ConfirmedAfter(Awaited(2)), 0u);
  // Thin and far up it touches nothing; since when it is a ship instead is not known.
  const auto rod = shape::Shape::Build(Moved(Rod(0.5, 0.01), {0, 0, 1.5}));
  EXPECT_EQ(Standing(Declared(rod, 2)).ConfirmedAfter(Declared(Ship(), 2)), 0u);
}

TEST(DetectorShapes, BallsBuildNothing) {
  Scene scene;
  scene.Put(1, Declared(nullptr, 1), {0, 0, 0}, {0, 0, 0});
  scene.Put(2, Declared(nullptr, 1), {8, 0, 0}, {-2, 0, 0});
  scene.Run(8);
  EXPECT_EQ(scene.With(EventStatus::kEnded).size(), 1u);
  // A segment of two balls is one unit, and so is the proximity in an event.
  EXPECT_LE(scene.detector.counters().work_units,
            scene.detector.counters().segments + scene.With(EventStatus::kConfirmed).size());
}

TEST(DetectorShapes, AdmittedInsideAnother) {
  Scene scene;
  scene.Put(1, Declared(shape::Shape::Build(Cube(5)), 9), {0, 0, 0}, {0, 0, 0});
  scene.Put(2, Declared(shape::Shape::Build(Scaled(LShape(), 0.2)), 0.5), {4.5, 4.5, 4.5},
            {0.01, 0, 0});
  scene.Run(1);
  const auto confirmed = scene.With(EventStatus::kConfirmed);
  ASSERT_GE(confirmed.size(), 1u);
  EXPECT_TRUE(confirmed[0].began_before);
  EXPECT_GT(confirmed[0].depth_lower, 0);
}

TEST(DetectorShapes, JumpIntoTheOther) {
  Scene scene;
  scene.Put(1, Declared(Ship(), 2), {0, 0, 0}, {0, 0, 0});
  scene.Put(2, Declared(Ship(), 2), {100, 0, 0}, {0, 0, 0});
  scene.Run(1);
  motion::MotionState jump = State(scene.now, {1.5, 0, 0.1}, {0, 0, 0});
  jump.discontinuity = true;
  jump.stamp = At(scene.now + 1.0 / 128);
  EXPECT_EQ(scene.detector.Update(Id(2), jump, At(scene.now)), UpdateOutcome::kJumped);
  scene.detector.SetHeardUntil(OwnerOf(Id(2)), jump.stamp);
  scene.agents[1] = {2, jump.p_WA, {0, 0, 0}, scene.now};
  scene.Run(2);
  const auto confirmed = scene.With(EventStatus::kConfirmed);
  ASSERT_GE(confirmed.size(), 1u);
  EXPECT_GE(confirmed[0].begin.latest, jump.stamp);
  EXPECT_LE(confirmed[0].begin.earliest, jump.stamp);
}

// More turning than declared between two states is a broken promise.
TEST(DetectorShapes, TurningFasterThanDeclaredIsABreach) {
  Scene scene;
  scene.Put(1, Declared(Ship(), 2), {0, 0, 0}, {0, 0, 0});
  scene.Put(2, Declared(Ship(), 2), {3.5, 0, 0}, {0, 0, 0});
  scene.Run(1);
  motion::MotionState turned = State(scene.now + 1.0 / 64, {3.5, 0, 0}, {0, 0, 0});
  turned.w_WB = {0, 0, 1};
  EXPECT_EQ(scene.detector.Update(Id(2), turned, turned.stamp), UpdateOutcome::kBreached);
}

std::vector<CollisionEvent> EventsWith(std::uint64_t units, int* not_clear = nullptr) {
  Scene scene(units);
  scene.Put(1, Declared(Ship(), 2), {0, 0, 0}, {0, 0, 0});
  scene.Put(2, Declared(Ship(), 2), {8, 0.3, 0.1}, {-2, 0, 0});
  scene.Put(3, Declared(Ship(), 2), {0, 9, 0.1}, {0, -2, 0.1});
  scene.Run(7);
  if (not_clear) *not_clear = scene.not_clear;
  return scene.events;
}

TEST(DetectorShapes, SameCallsSameEvents) {
  const auto once = EventsWith(10000), twice = EventsWith(10000);
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].begin, twice[i].begin);
    EXPECT_EQ(once[i].end, twice[i].end);
    EXPECT_EQ(once[i].p_WC, twice[i].p_WC);
    EXPECT_EQ(once[i].normal, twice[i].normal);
    EXPECT_EQ(once[i].work, twice[i].work);
    EXPECT_EQ(once[i].separation_upper, twice[i].separation_upper);
  }
}

// The less it may spend the less is certain; what is certain stays true.
TEST(DetectorShapes, WithoutBudgetNothingIsWrong) {
  for (const std::uint64_t units : {0, 100, 1000, 3000}) {
    bool covered = false;
    for (const CollisionEvent& event : EventsWith(units)) {
      if (event.lower != Id(1) || event.higher != Id(2)) continue;
      if (event.status == EventStatus::kConfirmed || event.status == EventStatus::kEnded) {
        EXPECT_LE(event.begin.earliest, At(3)) << units;
        EXPECT_GE(event.begin.latest, At(3)) << units;
        EXPECT_LE(event.end.earliest, At(5)) << units;
        EXPECT_GE(event.end.latest, At(5)) << units;
      }
      if (event.status == EventStatus::kUndecided) {
        EXPECT_EQ(event.limited_by, narrow_phase::BracketLimit::kBudget) << units;
      }
      const bool over =
          event.status == EventStatus::kUndecided || event.status == EventStatus::kEnded;
      covered |= over && event.begin.earliest <= At(3) && event.end.latest >= At(5);
    }
    EXPECT_TRUE(covered) << units;
  }
}

}  // namespace
}  // namespace collision::detection
