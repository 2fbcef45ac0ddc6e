// Goal:   a shape's twin, the same body with another tree, takes its place unnoticed: it is no
//         widening, the past stays known, and no result becomes less certain.
// Method: two detectors with the same states of two ships; one gets the twin now and then, the
//         other the same shape again. With a twin of the same tree all their outputs are the same,
//         bit for bit; with a better tree they are as certain as with that tree from the start.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "collision_core/detection/detector.h"
#include "collision_core/shape/shape.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/true_motion.h"

namespace collision::detection {
namespace {

constexpr double kEnd = 4;
constexpr int kTicksPerSecond = 16;
constexpr int kScenes = kSanitized ? 16 : 32;
constexpr sphere_tree::ShapeOptions kCoarse{.triangles_per_leaf = 16};

using ShapePointer = std::shared_ptr<const shape::Shape>;

struct Ship {
  AgentDeclaration declaration;
  TrueMotion motion;
  int ticks_per_state = 1;
  std::set<int> jumps;  // ticks, of one state that jumps aside and stays there
  Vector3d aside = Vector3d::Zero();
};

Ship RandomShip(Random& random, const geometry::TriangleMesh& mesh) {
  Ship ship;
  ship.declaration.shape = shape::Shape::Build(mesh, kCoarse);
  ship.declaration.limits.radius = ship.declaration.shape->facts().radius;
  ship.declaration.limits.acceleration_max = random.LogUniform(0.01, 1);
  if (random.Chance(0.8)) ship.declaration.limits.angular_acceleration_max = 0.1;
  ship.ticks_per_state = 1 << random.Below(5);
  ship.motion.start.q = RandomTurn(random);
  if (random.Chance(0.7)) ship.motion.start.w = RandomUnit(random);
  if (random.Chance(0.3)) {
    ship.jumps.insert(ship.ticks_per_state * (1 + static_cast<int>(random.Below(3))));
  }
  ship.aside = 0.3 * random.UnitVector();
  return ship;
}

struct Outputs {
  std::vector<CollisionEvent> events;
  std::vector<Instant> clear_until;
  std::uint64_t widenings = 0;
};

// At each of `redeclared` the ships are declared anew, with the shapes that `next` hands out.
template <typename Next>
Outputs Fly(const std::vector<Ship>& ships, const std::set<int>& redeclared, double skew,
            const Next& next) {
  DetectorOptions options;
  options.skew = skew;
  options.work_units_per_evaluation = 60'000;
  Detector detector(options);
  Outputs outputs;
  std::vector<AgentDeclaration> declarations;
  for (const Ship& ship : ships) declarations.push_back(ship.declaration);
  for (int tick = 0; tick <= kTicksPerSecond * kEnd; ++tick) {
    const double now = static_cast<double>(tick) / kTicksPerSecond;
    for (std::uint32_t i = 0; i < ships.size(); ++i) {
      const Ship& ship = ships[i];
      AgentDeclaration& declaration = declarations[i];
      if (redeclared.contains(tick)) {
        declaration.shape = next(i, tick);
        detector.Redeclare(Id(i), declaration, At(now));
      }
      if (tick % ship.ticks_per_state == 0) {
        motion::MotionState state = BoundAt(ship.motion, now, declaration.limits).state;
        if (!ship.jumps.empty() && tick >= *ship.jumps.begin()) state.p_WA += ship.aside;
        state.discontinuity = ship.jumps.contains(tick);
        if (tick == 0) {
          detector.Admit(Id(i), declaration, state, At(0));
        } else {
          detector.Update(Id(i), state, At(now));
        }
      }
      detector.SetHeardUntil(OwnerOf(Id(i)), At(now));
    }
    detector.Advance(At(now));
    outputs.events.insert(outputs.events.end(), detector.events().begin(), detector.events().end());
    for (std::uint32_t i = 0; i < ships.size(); ++i) {
      outputs.clear_until.push_back(detector.ClearanceOf(Id(i))->clear_until);
    }
  }
  outputs.widenings = detector.counters().widenings;
  return outputs;
}

auto Values(const CollisionEvent& e) {
  return std::tuple(e.lower, e.higher, e.contact, e.revision, e.now, e.status, e.begin, e.end,
                    e.continuous, e.began_before, e.evaluated_at, e.separation_lower,
                    e.separation_upper, e.depth_lower, e.p_WC, e.point_error, e.normal,
                    e.normal_error, e.level, e.work, e.limited_by);
}

struct Scene {
  std::vector<Ship> ships;
  std::set<int> redeclared;
  double skew = 0;
};

Scene RandomScene(std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < 2; ++i) scene.ships.push_back(RandomShip(random, Star(1, random)));
  const double reach =
      scene.ships[0].declaration.limits.radius + scene.ships[1].declaration.limits.radius;
  const Vector direction = RandomUnit(random);
  TruePose& other = scene.ships[1].motion.start;
  other.p = reach * random.Uniform(0.8, 2) * direction;
  other.v = random.Uniform(0, 1) * reach * (-direction + 0.5 * RandomUnit(random));
  for (int n = 0; n < 4; ++n) {
    scene.redeclared.insert(static_cast<int>(1 + random.Below(kTicksPerSecond * 3)));
  }
  if (random.Chance(0.5)) scene.skew = 0.02;
  return scene;
}

// Goal:   with the same tree nothing at all changes.
TEST(ShapeTwin, TheSameTreeGivesTheSame) {
  std::set<EventStatus> seen;
  int events = 0;
  for (int seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = RandomScene(seed);
    const auto same = [&](std::uint32_t i, int) { return scene.ships[i].declaration.shape; };
    const auto twin = [&](std::uint32_t i, int) -> ShapePointer {
      const shape::Shape& shape = *scene.ships[i].declaration.shape;
      return shape::Shape::Build(shape.mesh(), kCoarse, &shape);
    };
    const Outputs a = Fly(scene.ships, scene.redeclared, scene.skew, same);
    const Outputs b = Fly(scene.ships, scene.redeclared, scene.skew, twin);
    EXPECT_EQ(a.widenings, b.widenings);
    EXPECT_EQ(a.clear_until, b.clear_until);
    ASSERT_EQ(a.events.size(), b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
      EXPECT_TRUE(Values(a.events[i]) == Values(b.events[i])) << i;
      seen.insert(a.events[i].status);
      ++events;
    }
  }
  EXPECT_GT(events, 5 * kScenes / 4);
  EXPECT_TRUE(seen.contains(EventStatus::kConfirmed) && seen.contains(EventStatus::kEnded));
}

// Goal:   with a better tree the results are at least as certain as with the coarse one, and no
//         clearance is lowered because of it.
TEST(ShapeTwin, ABetterTreeTakesNothingBack) {
  int confirmed = 0, switched = 0;
  for (int seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = RandomScene(seed);
    std::vector<ShapePointer> fine;
    for (const Ship& ship : scene.ships) {
      fine.push_back(
          shape::Shape::Build(ship.declaration.shape->mesh(), {}, ship.declaration.shape.get()));
      ASSERT_GT(fine.back()->tree().nodes.size(), ship.declaration.shape->tree().nodes.size());
    }
    const auto better = [&](std::uint32_t i, int) { return ++switched, fine[i]; };
    const auto same = [&](std::uint32_t i, int) { return scene.ships[i].declaration.shape; };
    const Outputs coarse = Fly(scene.ships, scene.redeclared, scene.skew, same);
    const Outputs refined = Fly(scene.ships, scene.redeclared, scene.skew, better);
    EXPECT_EQ(refined.widenings, coarse.widenings);
    std::map<std::uint32_t, EventStatus> last;
    for (const CollisionEvent& event : refined.events) {
      // Once certain, never doubted.
      const auto before = last.find(event.contact);
      if (before != last.end() && before->second == EventStatus::kConfirmed) {
        EXPECT_NE(event.status, EventStatus::kUndecided);
        EXPECT_NE(event.status, EventStatus::kPossible);
      }
      last[event.contact] = event.status;
      confirmed += event.status == EventStatus::kConfirmed;
    }
    for (const CollisionEvent& event : coarse.events) {
      if (event.status == EventStatus::kConfirmed) {
        EXPECT_TRUE(last.contains(event.contact));
      }
    }
  }
  EXPECT_GT(switched, 2 * kScenes);
  EXPECT_GT(confirmed, kScenes / 3);
}

}  // namespace
}  // namespace collision::detection
