// Goal:   the detector's promises about two shapes hold for every motion within their bounds,
//         however far ahead they reach; contact normals are those of the true approach, or not
//         given.
// Method: two bodies that move and turn as hard as they may, towards each other and away; the true
//         first contact in long double, by steps that no motion can outrun. Every clearance and
//         every event is checked against it.
#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "collision_core/detection/detector.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/solids.h"
#include "tests/support/truth/true_distance.h"

namespace collision::detection {
namespace {

constexpr double kEnd = 4;

struct Ship {
  AgentDeclaration declaration;
  std::shared_ptr<const shape::Shape>
      triangles;  // What it is in truth, whatever it is declared to be.
  TrueMotion motion;
  int states_per_second = 64;
};

// The same body of triangles, and of convex solids where that can be.
struct Made {
  std::shared_ptr<const shape::Shape> triangles, solids;
};

const Made& LShaped() {
  static const Made made = {
      shape::Shape::Build(LShape()),
      shape::Shape::Compound(
          nullptr, {SolidBox({-1, -1, -0.5}, {1, 0, 0.5}), SolidBox({-1, 0, -0.5}, {0, 1, 0.5})})};
  return made;
}

Made RandomShape(Random& random) {
  static const auto rod = shape::Shape::Build(Rod(2, 0.1)), cube = shape::Shape::Build(Cube(0.7)),
                    sheet = shape::Shape::Build(Sheet(1, 2));
  static const auto of_box = [](const shape::Shape& box) {
    return shape::Shape::Compound(nullptr, {SolidBox(box.facts().lower, box.facts().upper)});
  };
  static const Made made[] = {
      LShaped(), {rod, of_box(*rod)}, {cube, of_box(*cube)}, {sheet, sheet}, {}};
  return made[random.Below(5)];
}

Ship RandomShip(Random& random, bool of_solids) {
  Ship ship;
  AgentDeclaration& declared = ship.declaration;
  const Made made = RandomShape(random);
  ship.triangles = made.triangles;
  declared.shape = of_solids ? made.solids : made.triangles;
  declared.limits.radius = declared.shape ? declared.shape->facts().radius : 0.8;
  declared.limits.acceleration_max = random.Chance(0.3) ? 0 : random.LogUniform(0.05, 4);
  declared.limits.angular_acceleration_max = random.Chance(0.2) ? 0 : random.LogUniform(0.05, 2);
  ship.states_per_second = 1 << random.Below(7);
  ship.motion.start.q = RandomTurn(random);
  if (random.Chance(0.8)) ship.motion.start.w = random.LogUniform(0.05, 2) * RandomUnit(random);
  return ship;
}

// As hard as allowed, most often towards where the other one is.
std::vector<TrueMotion::Piece> Pieces(Random& random, const AgentDeclaration& declared,
                                      const Vector& towards) {
  std::vector<TrueMotion::Piece> pieces;
  for (double at = 0; at < kEnd;) {
    at = std::min(kEnd, at + random.LogUniform(0.25, 2));
    const double M = (1 - 1e-9) * declared.limits.acceleration_max;
    const double alpha = (1 - 1e-9) * declared.limits.angular_acceleration_max;
    const Vector a = random.Chance(0.6) ? towards : RandomUnit(random);
    pieces.push_back({at, M * a, alpha * RandomUnit(random)});
  }
  return pieces;
}

struct Encounter {
  Ship ships[2];

  TrueBody Body(int i, Real t) const {
    const AgentDeclaration& declared = ships[i].declaration;
    return {ships[i].triangles.get(), declared.limits.radius, ships[i].motion.At(t)};
  }
  Real Distance(Real t) const { return SolidDistance(Body(0, t), Body(1, t)); }

  // No two points move faster relative to each other.
  Real SpeedMax() const {
    Real speed = 0;
    for (const Ship& ship : ships) {
      const AgentDeclaration& declared = ship.declaration;
      const TruePose& start = ship.motion.start;
      speed += start.v.norm() + kEnd * declared.limits.acceleration_max +
               (start.w.norm() + kEnd * declared.limits.angular_acceleration_max) *
                   declared.limits.radius;
    }
    return speed;
  }

  // The first contact: apart up to `free`, together at `touching`; infinity: there is none.
  struct First {
    double free = numeric::kInfinity, touching = numeric::kInfinity;
  };
  First FirstContact() const {
    const Real speed = SpeedMax();
    Real t = 0;
    while (t <= kEnd) {
      const Real distance = Distance(t);
      if (distance == 0) return {static_cast<double>(t - 1e-4L), static_cast<double>(t)};
      t += std::max<Real>(distance / speed, 1e-5L);
    }
    return {};
  }
};

Encounter RandomEncounter(Random& random, bool of_solids) {
  Encounter met;
  // One of them may be of triangles all the same.
  met.ships[0] = RandomShip(random, of_solids);
  met.ships[1] = RandomShip(random, of_solids && random.Chance(0.6));
  if (!met.ships[0].declaration.shape && !met.ships[1].declaration.shape) {
    met.ships[0].triangles = LShaped().triangles;
    met.ships[0].declaration.shape = of_solids ? LShaped().solids : LShaped().triangles;
    met.ships[0].declaration.limits.radius = 1.6;
  }
  const double reach =
      met.ships[0].declaration.limits.radius + met.ships[1].declaration.limits.radius;
  const Vector direction = RandomUnit(random);
  // Within the balls, or outside of them.
  met.ships[1].motion.start.p = reach * random.Uniform(0.4, 2.5) * direction;
  const Vector aim = -direction + 0.5 * RandomUnit(random);
  met.ships[1].motion.start.v = random.Uniform(0, 1.5) * reach * aim / 2;
  met.ships[0].motion.pieces = Pieces(random, met.ships[0].declaration, direction);
  met.ships[1].motion.pieces = Pieces(random, met.ships[1].declaration, -direction);
  return met;
}

struct Outcome {
  int contacts = 0, promised = 0, far_ahead = 0, confirmed = 0, directions = 0;
};

void CheckEvents(const std::vector<CollisionEvent>& events, const Encounter& met,
                 const Encounter::First& first, Outcome* outcome) {
  for (const CollisionEvent& event : events) {
    const bool reported =
        event.status == EventStatus::kConfirmed || event.status == EventStatus::kEnded;
    if (!reported || event.contact != 1 || event.began_before) continue;
    ++outcome->confirmed;
    EXPECT_GE(event.begin.latest, At(first.free));
    // The separating direction of a contact that was just approached: along it the two are apart,
    // about.
    if (event.normal_error > 0.3 || event.begin.earliest < At(first.free - 0.02)) continue;
    ++outcome->directions;
    const Real t = first.free - 1e-3;
    const TrueBody a = met.Body(0, t), b = met.Body(1, t);
    const Real near = SolidDistance(a, b);
    if (near == 0) continue;
    const Vector n = event.normal.cast<Real>();
    // To move apart along the published normal never brings them together.
    EXPECT_GT(SolidDistance(a, b.Moved(0.02L * n)), near - 1e-3L);
  }
}

void CheckEncounter(std::uint64_t seed, bool of_solids, Outcome* outcome) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  const Encounter met = RandomEncounter(random, of_solids);
  if (met.Distance(0) == 0) return;
  const Encounter::First first = met.FirstContact();
  outcome->contacts += first.touching < numeric::kInfinity;
  DetectorOptions options;
  if (random.Chance(0.4)) options.work_units_per_evaluation = random.Below(4000);
  Detector detector(options);
  std::vector<CollisionEvent> events;
  for (int tick = 0; tick <= 64 * kEnd; ++tick) {
    const double now = tick / 64.0;
    for (int i = 0; i < 2; ++i) {
      const Ship& ship = met.ships[i];
      const AgentId id = Id(static_cast<std::uint32_t>(i));
      if (tick % (64 / ship.states_per_second) == 0) {
        const motion::MotionState state = BoundAt(ship.motion, now, ship.declaration.limits).state;
        if (tick == 0) {
          detector.Admit(id, ship.declaration, state, At(0));
        } else {
          EXPECT_EQ(detector.Update(id, state, At(now)), UpdateOutcome::kKept);
        }
      }
      detector.SetHeardUntil(OwnerOf(id), At(now));
    }
    detector.Advance(At(now));
    events.insert(events.end(), detector.events().begin(), detector.events().end());
    if (now >= first.free) continue;
    for (std::uint32_t i = 0; i < 2; ++i) {
      const AgentClearance clearance = *detector.ClearanceOf(Id(i));
      EXPECT_FALSE(clearance.in_contact) << now;
      ++outcome->promised;
      outcome->far_ahead +=
          !clearance.clear_until.is_never() && clearance.clear_until > At(now + 0.2);
      if (first.touching == numeric::kInfinity) continue;
      EXPECT_LE(clearance.clear_until, At(first.touching)) << now;
    }
  }
  if (first.touching < kEnd - 0.1) {
    const bool covered =
        std::any_of(events.begin(), events.end(), [&](const CollisionEvent& event) {
          return event.status != EventStatus::kDismissed &&
                 event.begin.earliest <= At(first.touching);
        });
    EXPECT_TRUE(covered);
  }
  CheckEvents(events, met, first, outcome);
}

constexpr int kEncounters = kSanitized ? 20 : 80;

void CheckEncounters(bool of_solids) {
  Outcome outcome;
  for (int seed = 1; seed <= kEncounters && !testing::Test::HasFailure(); ++seed) {
    CheckEncounter(seed, of_solids, &outcome);
  }
  EXPECT_GT(outcome.contacts, 5 * kEncounters / 16);
  EXPECT_GT(outcome.confirmed, kEncounters / 4);
  EXPECT_GT(outcome.promised, 25 * kEncounters);
  // Looking ahead is of use.
  EXPECT_GT(outcome.far_ahead, outcome.promised / 4);
  EXPECT_GT(outcome.directions, kEncounters / 16);
}

TEST(DetectorShapePromise, NeverLaterThanTheTrueFirstContact) { CheckEncounters(false); }

TEST(DetectorShapePromise, ConvexSolidsAreNeverLate) { CheckEncounters(true); }

// One state a second of a cube that comes along x and does not turn, but does not declare that.
struct Coming {
  explicit Coming(const AgentDeclaration& still) {
    detector.Admit(Id(1), still, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
    detector.Admit(Id(2), declared, State(0, At0(0), {-1, 0, 0}), At(0));
  }

  static Vector3d At0(double t) { return {5 - t, 0.3, 0}; }

  void Tell(double t) {
    motion::MotionState state = State(t, At0(t), {-1, 0, 0});
    if (jumped_to) state = State(t, *jumped_to, {0, 0, 0});
    state.discontinuity = jumped_to && !std::exchange(has_jumped, true);
    detector.Update(Id(1), State(t, {0, 0, 0}, {0, 0, 0}), At(t));
    detector.Update(Id(2), state, At(t));
    detector.SetHeardUntil(OwnerOf(Id(1)), At(t));
    detector.SetHeardUntil(OwnerOf(Id(2)), At(t));
  }

  void Redeclare(std::shared_ptr<const shape::Shape> shape) {
    declared.shape = std::move(shape);
    detector.Redeclare(Id(2), declared, At(0));
  }

  void Advance(double t) {
    detector.Advance(At(t));
    events.insert(events.end(), detector.events().begin(), detector.events().end());
  }

  // Contact cannot be approached by a direction: none is known of how the cube turns, or of its
  // shape.
  void ExpectNoDirection() const {
    int reported = 0;
    for (const CollisionEvent& event : events) {
      if (event.evaluated_at.is_never()) continue;
      ++reported;
      EXPECT_EQ(event.normal_error, std::numbers::pi) << "at " << event.now.nanoseconds();
    }
    EXPECT_GT(reported, 0);
  }

  Detector detector{{}};
  AgentDeclaration declared{.limits = {.radius = 1, .acceleration_max = 0.2}};
  std::optional<Vector3d> jumped_to;
  bool has_jumped = false;
  std::vector<CollisionEvent> events;
};

// Into the other one, from where it was in sight: the way there was none through space.
TEST(DetectorShapePromise, NoDirectionThroughAJump) {
  const auto cube = shape::Shape::Build(Cube(0.5));
  Coming coming({.limits = {.radius = 1, .acceleration_max = 0, .angular_acceleration_max = 0},
                 .shape = cube});
  coming.declared.limits.angular_acceleration_max = 0;
  coming.Redeclare(cube);
  for (const double t : {1, 2}) coming.Tell(t), coming.Advance(t);
  coming.jumped_to = Vector3d(0, 0, 0.75);
  for (const double t : {3, 4, 5, 6, 7, 8}) coming.Tell(t), coming.Advance(t);
  coming.ExpectNoDirection();
}

// The cube counts as a ball until its shape is declared at 2.5 s: its shape during [2, 3] is not
// known, and at 3 s the balls are still just apart. So that segment gives no direction of approach.
TEST(DetectorShapePromise, NoDirectionFromBeforeAShapeWasKnown) {
  const auto cube = shape::Shape::Build(Cube(0.5));
  for (const bool other_is_ball : {true, false}) {
    AgentDeclaration still{.limits = {.radius = 1, .acceleration_max = 0}};
    if (!other_is_ball) still.shape = cube;
    Coming coming(still);
    for (const double t : {1, 2}) coming.Tell(t), coming.Advance(t);
    coming.Redeclare(cube);
    // The states of 3 s and 4 s come together, so that [3, 4] is judged as one.
    coming.Tell(3);
    for (const double t : {4, 5, 6, 7, 8, 9, 10, 11}) coming.Tell(t), coming.Advance(t);
    coming.ExpectNoDirection();
  }
}

}  // namespace
}  // namespace collision::detection
