// Goal:   an agent that is a half-space meets whatever moves, and nothing else: never late, in
//         narrow brackets, for balls and shapes, whoever comes first and whatever else is there; as
//         many as there are stand on one floor; what is expected of it is told.
// Method: agents that fall on floors and run against walls, which balls' centres decide exactly; a
//         crowd between walls, judged by each agent's true motion.
#include <gtest/gtest.h>

#include <cmath>

#include "collision_core/shape/fixed_half_space.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

AgentDeclaration HalfSpace(const Vector3d& normal, double offset) {
  AgentDeclaration declaration;
  declaration.half_space = shape::FixedHalfSpace::Build(normal, offset);
  return declaration;
}

std::shared_ptr<const shape::Shape> Box(double half) {
  return shape::Shape::Compound(
      nullptr,
      {shape::ConvexSolid::Build(
          {.core = geometry::ConvexCore::kBox, .half = {half, half, half}, .points = {}})});
}

/// Lines and half-spaces.
class Room : public Line {
 public:
  using Line::Line;

  bool AddHalfSpace(std::uint32_t slot, const Vector3d& normal, double offset) {
    if (!detector.Admit(Id(slot), HalfSpace(normal, offset), State(now, {7, 8, 9}, {1, 2, 3}),
                        At(now))) {
      return false;
    }
    half_spaces.push_back(slot);
    return true;
  }

  void AddBox(std::uint32_t slot, const Vector3d& p, const Vector3d& v, double half) {
    AgentDeclaration declaration;
    declaration.shape = Box(half);
    declaration.limits.radius = declaration.shape->facts().radius;
    declaration.limits.acceleration_max = 1;
    declaration.limits.angular_acceleration_max = 0;
    detector.Admit(Id(slot), declaration, State(now, p, v), At(now));
    agents.push_back({slot, p, v, now});
  }

  /// Half-spaces are heard of all the time, as the simulators that have them go on.
  void Run(double end) {
    while (now < end) {
      for (const std::uint32_t slot : half_spaces) {
        detector.SetHeardUntil(OwnerOf(Id(slot)), At(now + 1.0 / 16));
      }
      RunTo(now + 1.0 / 16);
    }
  }

  std::vector<std::uint32_t> half_spaces;
};

void ExpectBracket(const TimeBracket& bracket, double truth, double width) {
  EXPECT_LE(bracket.earliest, At(truth + 1e-9));
  EXPECT_GE(bracket.latest, At(truth - 1e-9));
  EXPECT_GE(bracket.earliest, At(truth - width));
  EXPECT_LE(bracket.latest, At(truth + width));
}

TEST(HalfSpaceAgent, BallsAndBoxesMeetItInNarrowBrackets) {
  for (const bool first : {true, false}) {
    for (const bool box : {true, false}) {
      Room room;
      if (first) room.AddHalfSpace(1, {0, 0, 1}, 0);
      if (box) {
        room.AddBox(2, {1e3, -2e3, 5.1}, {3, 4, -2}, 1);
      } else {
        room.Add(2, {1e3, -2e3, 5.1}, {3, 4, -2});
      }
      if (!first) room.AddHalfSpace(3, {0, 0, 1}, 0);
      room.Run(2.05 - 2.5 / 16);
      EXPECT_TRUE(room.With(EventStatus::kConfirmed).empty());
      EXPECT_EQ(room.With(EventStatus::kPossible).empty(), false);
      room.Run(3);
      const auto confirmed = room.With(EventStatus::kConfirmed);
      ASSERT_FALSE(confirmed.empty()) << first << box;
      ExpectBracket(confirmed.back().begin, 2.05, 0.01);
    }
  }
}

// A floor sends one state, and no other will tell more of where it is.
TEST(HalfSpaceAgent, AContactWithItHasEndedAsSoonAsThePartnersStatesTellSo) {
  for (const bool box : {true, false}) {
    Room room;
    room.AddHalfSpace(1, {0, 0, 1}, 0);
    const Vector3d start{0, 0, 2.98};
    if (box) {
      room.AddBox(2, start, {0, 0, -2}, 1);
    } else {
      room.Add(2, start, {0, 0, -2});
    }
    while (room.now < 3) {
      const double t = room.now += 1.0 / 16;
      room.detector.Update(Id(2), State(t, {0, 0, 0.98 + (t - 2) * (t - 2) / 2}, {0, 0, t - 2}),
                           At(t));
      for (const std::uint32_t slot : {1, 2}) {
        room.detector.SetHeardUntil(OwnerOf(Id(slot)), At(t));
      }
      room.Step();
    }
    const auto ended = room.With(EventStatus::kEnded);
    ASSERT_EQ(ended.size(), 1u) << box;
    ExpectBracket(ended[0].begin, 1.8, 0.01);
    ExpectBracket(ended[0].end, 2.2, 0.01);
    EXPECT_LE(ended[0].now, At(2.2 + 3.0 / 16)) << box;
  }
}

TEST(HalfSpaceAgent, WhatIsExpectedOfItAndHowNearItWasAreTold) {
  Room room;
  room.AddHalfSpace(1, {0, 0, 1}, 0);
  room.AddBox(2, {0, 0, 3}, {0, 0, -1}, 1);
  room.Run(1.0 / 16);
  const auto possible = room.With(EventStatus::kPossible);
  ASSERT_FALSE(possible.empty());
  ASSERT_TRUE(possible.back().expected.has_value());
  EXPECT_EQ(possible.back().expected->outcome, ExpectedOutcome::kTouch);
  ExpectBracket(possible.back().expected->begin, 2, 1e-4);
  room.agents[0] = {2, {0, 0, 2.5 - 1.0 / 16}, {0, 0, 0.3}, room.now};
  room.Run(8);
  const auto dismissed = room.With(EventStatus::kDismissed);
  ASSERT_FALSE(dismissed.empty());
  ASSERT_TRUE(dismissed.back().closest.has_value());
}

// No block is large enough to look endless from there: nothing is expected, nothing dismissed.
TEST(HalfSpaceAgent, WhatIsTooDeepOrTooLargeForItsBlocksMayMeetIt) {
  for (const double offset : {3e7, 4e7, 1e13, shape::kHalfSpaceOffsetMax}) {
    Room room;
    room.AddHalfSpace(1, {0, 0, 1}, offset);
    room.Add(2, {0, 0, 0}, {0, 0, 1});
    room.AddBox(3, {9, 0, 0}, {0, 0, 1}, 1);
    room.Run(1);
    EXPECT_FALSE(room.With(EventStatus::kPossible).empty()) << offset;
    EXPECT_TRUE(room.With(EventStatus::kDismissed).empty()) << offset;
  }
  Room room;
  room.AddHalfSpace(1, {0, 0, 1}, 0);
  room.Add(2, {0, 0, 1e8 + 1}, {0, 0, -1}, 1e8);
  room.Run(2);
  EXPECT_FALSE(room.With(EventStatus::kPossible).empty());
}

TEST(HalfSpaceAgent, EveryAgentOfACrowdMeetsTheWallsInTime) {
  Random random(4);
  Room room;
  const Vector3d tilted = Vector3d(1, 2, 2) / 3;
  room.AddHalfSpace(1, {0, 0, 1}, 0);
  room.AddHalfSpace(2, {-1, 0, 0}, -100);
  room.AddHalfSpace(3, -tilted, -200);
  struct Plane {
    Vector3d normal;
    double offset;
  };
  const Plane planes[] = {{{0, 0, 1}, 0}, {{-1, 0, 0}, -100}, {-tilted, -200}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> truth;
  for (std::uint32_t slot = 10; slot < 310; ++slot) {
    const Vector3d p(random.Uniform(10, 90), random.Uniform(-100, 20), random.Uniform(20, 90));
    const Vector3d v = 30 * random.UnitVector();
    room.Add(slot, p, v, 0.5);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double gap = planes[k].normal.dot(p) - planes[k].offset - 0.5;
      const double closing = -planes[k].normal.dot(v);
      ASSERT_GT(gap, 0);
      if (closing > 0 && gap / closing < 5) truth[{k + 1, slot}] = gap / closing;
    }
  }
  room.Run(6);
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> announced;
  std::size_t confirmed = 0;
  for (const CollisionEvent& event : room.events) {
    const std::pair pair(event.lower.slot, event.higher.slot);
    if (event.lower.slot > 3) continue;
    if (event.status == EventStatus::kPossible) announced.emplace(pair, 0);
    if (event.status != EventStatus::kConfirmed) continue;
    const auto found = truth.find(pair);
    if (found == truth.end()) continue;
    ASSERT_TRUE(announced.contains(pair)) << pair.first << " " << pair.second;
    ExpectBracket(event.begin, found->second, 0.02);
    ++confirmed;
    truth.erase(found);
  }
  EXPECT_GT(confirmed, 150U);
  EXPECT_TRUE(truth.empty()) << truth.size() << " contacts were not told";
}

TEST(HalfSpaceAgent, ClearancesEndBeforeTheContactAndNotLongBefore) {
  Room room;
  room.AddHalfSpace(1, {0, 1, 0}, -10);
  room.Add(2, {0, 990, 0}, {0, -10, 0});
  room.Run(1);
  // ½ t² + 10 t = 999 from the start, and 989 from the newest state on.
  const double first = -10 + std::sqrt(100 + 2 * 999.0);
  const double reach = -10 + std::sqrt(100 + 2 * 989.0);
  for (const std::uint32_t slot : {1U, 2U}) {
    const Instant until = room.detector.ClearanceOf(Id(slot))->clear_until;
    EXPECT_LE(until, At(1 + reach)) << slot;
    EXPECT_GE(until, At(first - 1e-3)) << slot;
  }
  const EarliestAnswer earliest = room.detector.Earliest();
  ASSERT_TRUE(earliest.found);
  EXPECT_LE(earliest.earliest, At(1 + reach));
  EXPECT_GE(earliest.earliest, At(1 + reach - 1e-6));
}

TEST(HalfSpaceAgent, ItsClearanceIsLoweredByAnAgentThatJumpsNear) {
  Room room;
  room.AddHalfSpace(1, {0, 1, 0}, 0);
  room.Add(2, {1000, 201, 0}, {0, 0, 0});
  room.Run(0.5);
  EXPECT_GE(room.detector.ClearanceOf(Id(1))->clear_until, At(19));
  motion::MotionState jump = State(0.5, {1000, 51, 0}, {0, -1, 0});
  jump.discontinuity = true;
  room.detector.Update(Id(2), jump, At(0.5));
  room.agents[0] = {2, {1000, 51, 0}, {0, -1, 0}, 0.5};
  room.Run(0.75);
  // ½ t² + t is the gap, as of the first state after the jump.
  const double first = 0.5 + 1.0 / 16, reach = -1 + std::sqrt(1 + 2 * (50 - 1.0 / 16));
  for (const std::uint32_t slot : {1U, 2U}) {
    const Instant until = room.detector.ClearanceOf(Id(slot))->clear_until;
    EXPECT_LE(until, At(first + reach)) << slot;
    EXPECT_GE(until, At(first + reach - 1e-3)) << slot;
  }
}

TEST(HalfSpaceAgent, MoreAgentsThanAPairLimitStandOnOneFloor) {
  DetectorOptions options;
  options.pairs_per_agent_max = 8;
  Room room(options);
  room.AddHalfSpace(1, {0, 0, 1}, 0);
  for (std::uint32_t k = 0; k < 50; ++k) {
    const std::uint32_t row = k / 10, column = k % 10;
    room.Add(10 + k, {5.0 * column, 5.0 * row, 0.5}, {0, 0, 0});
  }
  room.Run(0.5);
  std::set<std::uint32_t> touching;
  for (const CollisionEvent& event : room.With(EventStatus::kConfirmed)) {
    if (event.lower.slot == 1) touching.insert(event.higher.slot);
  }
  EXPECT_EQ(touching.size(), 50U);
}

TEST(HalfSpaceAgent, NeitherHalfSpacesNorAgentsAtRestMeetIt) {
  Room room;
  room.AddHalfSpace(1, {0, 0, 1}, 0);
  room.AddHalfSpace(2, {1, 0, 0}, 0);
  AgentDeclaration still;
  still.limits = {1, 0};
  room.detector.Admit(Id(3), still, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  room.Run(1);
  EXPECT_TRUE(room.events.empty());
  EXPECT_EQ(room.detector.pairs_tracked(), 0U);
}

TEST(HalfSpaceAgent, AtMost64AreHeldAndThereIsRoomWhenOneHasLeft) {
  Room room;
  for (std::uint32_t k = 0; k < 64; ++k) {
    ASSERT_TRUE(room.AddHalfSpace(1 + k, {0, 0, 1}, -1000.0 - k));
  }
  EXPECT_FALSE(room.detector.HasRoomForHalfSpace());
  EXPECT_FALSE(room.AddHalfSpace(100, {0, 0, 1}, 0));
  room.Add(200, {0, 0, 5}, {0, 0, 0});
  room.Run(0.25);
  room.detector.Remove(Id(64));
  std::erase(room.half_spaces, 64U);
  room.Run(0.5);
  EXPECT_TRUE(room.detector.HasRoomForHalfSpace());
  EXPECT_TRUE(room.AddHalfSpace(100, {0, 0, 1}, 4.5));
  room.Run(1);
  EXPECT_FALSE(room.With(EventStatus::kConfirmed).empty());
}

TEST(HalfSpaceAgent, OneThatComesLateMeetsThoseWhoseStatesLieAhead) {
  Room room;
  room.Add(2, {0, 0, 4}, {0, 0, -2});
  room.Run(0.5);
  // It turns about with 0.98 m/s² and is away again at its next state, which lies ahead.
  const double turn = 4.5, next = 0.5 + turn;
  room.detector.Update(
      Id(2), State(next, {0, 0, 3 - 2 * turn + 0.49 * turn * turn}, {0, 0, -2 + 0.98 * turn}),
      At(next));
  room.detector.SetHeardUntil(OwnerOf(Id(2)), At(next));
  room.agents.clear();
  room.Step();
  room.AddHalfSpace(1, {0, 0, 1}, 1.5);
  room.now = 0.625;
  room.Step();
  // 3 − 2 t + 0.49 t² = 2.5
  const double begin = 0.5 + (2 - std::sqrt(4 - 4 * 0.49 * 0.5)) / 0.98;
  EXPECT_LE(room.detector.ClearanceOf(Id(1))->clear_until, At(begin));
  while (room.now < next) {
    room.now += 1.0 / 16;
    room.detector.SetHeardUntil(OwnerOf(Id(1)), At(room.now));
    room.Step();
  }
  const auto confirmed = room.With(EventStatus::kConfirmed);
  ASSERT_FALSE(confirmed.empty());
  EXPECT_LE(confirmed.back().begin.earliest, At(begin));
  EXPECT_GE(confirmed.back().begin.latest, At(begin));
}

TEST(HalfSpaceAgent, TheFilterSaysWhomItMeets) {
  Room room;
  AgentDeclaration floor = HalfSpace({0, 0, 1}, 0);
  floor.filter.mask = 2;
  room.detector.Admit(Id(1), floor, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  room.half_spaces.push_back(1);
  room.Add(2, {0, 0, 0.5}, {0, 0, 0});
  room.Run(0.5);
  EXPECT_TRUE(room.events.empty());
  floor.filter.mask = 1;
  EXPECT_TRUE(room.detector.Redeclare(Id(1), floor, At(0.5)));
  room.Run(1);
  EXPECT_FALSE(room.With(EventStatus::kConfirmed).empty());
}

}  // namespace
}  // namespace collision::detection
