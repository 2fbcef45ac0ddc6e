// Ellipsoids, cylinders, cones and half-spaces as the checker sees them: closed forms, and hulls of
// many sides inside and around them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "client/checker/shape/bodies.h"
#include "tests/client/checker/contact_margin.h"
#include "tests/client/checker/random_pose.h"
#include "tests/client/checker/solids.h"
#include "tests/support/random.h"

namespace collision::checker {
namespace {

using Kind = RoundCore::Kind;
using Quaternion = std::array<double, 4>;

constexpr Quaternion kUpright = {1, 0, 0, 0};
constexpr Quaternion kAlongX = {1, 0, 1, 0};  // z becomes x

Solid Round(Kind kind, const Vector& half, const Quaternion& q = kUpright, const Vector& p = {},
            double rounding = 0) {
  return {Mesh::OfSegment(p, p), rounding, RoundCore(kind, half, q, p)};
}
Solid Ellipsoid(const Vector& half, const Quaternion& q = kUpright, const Vector& p = {}) {
  return Round(Kind::kEllipsoid, half, q, p);
}
Solid Cylinder(double r, double h, const Quaternion& q = kUpright, const Vector& p = {}) {
  return Round(Kind::kCylinder, {r, r, h}, q, p);
}
Solid Cone(double r, double h, const Quaternion& q = kUpright, const Vector& p = {}) {
  return Round(Kind::kCone, {r, r, h}, q, p);
}

/// About y by `angle`: z turns towards x.
Quaternion Tilt(double angle) { return {std::cos(angle / 2), 0, std::sin(angle / 2), 0}; }

Standing Between(const Solid& a, const Solid& b, const Pose& pose) {
  const std::vector<Solid> of_a = {a}, of_b = {b};
  Hint hint;
  return StandingOf({nullptr, 0, &of_a}, {nullptr, 0, &of_b}, pose, &hint);
}

double Apart(const Solid& a, const Solid& b, const Pose& pose) {
  const Standing standing = Between(a, b, pose);
  EXPECT_FALSE(standing.contact);
  return standing.margin;
}

// Positive: apart; negative: in contact.
double Above(const HalfSpace& floor, const Solid& solid, const Pose& pose) {
  const std::vector<Solid> solids = {solid};
  const Body ground{nullptr, 0, nullptr, 0, &floor}, body{nullptr, 0, &solids};
  Hint hint;
  const Standing one = StandingOf(ground, body, pose, &hint);
  const Standing other = StandingOf(body, ground, pose.Inverse(), &hint);
  EXPECT_EQ(one.contact, other.contact);
  EXPECT_NEAR(one.margin, other.margin, 1e-14);
  EXPECT_EQ(InContact(body, ground, pose.Inverse(), &hint), one.contact);
  EXPECT_NEAR(DistanceOf(ground, body, pose), one.contact ? 0 : one.margin, 1e-14);
  if (one.contact) {
    EXPECT_NEAR(DepthAtMost(ground, body, pose, {}), one.margin, 1e-14);
  }
  return one.contact ? -one.margin : one.margin;
}

TEST(HalfSpaces, HeightsInClosedForm) {
  const HalfSpace floor{{0, 0, 1}, 2};
  const Solid ball{Mesh::OfSegment({}, {}), 0.75};
  EXPECT_NEAR(Above(floor, ball, At({7, -3, 5})), 2.25, 1e-15);
  EXPECT_NEAR(Above(floor, ball, At({7, -3, 2.5})), -0.25, 1e-15);
  for (const double angle : {0.0, 0.3, 1.2, std::numbers::pi / 2, 2.5}) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    // A cylinder's lowest point is on a rim, an ellipsoid's where its normal points down.
    EXPECT_NEAR(Above(floor, Cylinder(0.5, 1.5, Tilt(angle)), At({1, 2, 7})),
                5 - 1.5 * std::fabs(cosine) - 0.5 * std::fabs(sine), 1e-14);
    EXPECT_NEAR(Above(floor, Ellipsoid({1, 2, 3}, Tilt(angle)), At({1, 2, 7})),
                5 - std::hypot(3 * cosine, 1 * sine), 1e-14);
    // A cone's on the rim of its base, or its apex.
    EXPECT_NEAR(Above(floor, Cone(0.5, 1.5, Tilt(angle)), At({1, 2, 7})),
                5 - std::max(1.5 * cosine + 0.5 * std::fabs(sine), -1.5 * cosine), 1e-14);
    EXPECT_NEAR(Above(floor, Cylinder(0.5, 1.5, Tilt(angle)), At({1, 2, 2.25})),
                0.25 - 1.5 * std::fabs(cosine) - 0.5 * std::fabs(sine), 1e-14);
  }
  // A wall that leans: 2² + 3² + 6² = 7².
  const HalfSpace wall{1.0 / 7 * Vector{2, 3, 6}, 1};
  EXPECT_NEAR(Above(wall, ball, At({2, 3, 6})), 7 - 1 - 0.75, 1e-14);
  EXPECT_NEAR(DistanceTo({nullptr, 0, nullptr, 0.5, &wall}, {2, 3, 6}), 5.5, 1e-14);
  EXPECT_EQ(DistanceTo({nullptr, 0, nullptr, 0, &wall}, {-2, -3, 0}), 0);
  EXPECT_EQ((Body{nullptr, 0, nullptr, 0, &wall}.reach()), 0);
}

// Goal:   a mesh's lowest vertex counts, solids beside it, and by how much either is grown.
TEST(HalfSpaces, MeetWholeBodies) {
  const HalfSpace floor;
  const Mesh cube = BoxMesh(1, 2, 3);
  const std::vector<Solid> foot = {Cone(0.5, 0.5, {0, 1, 0, 0}, {0, 0, -3.25})};
  EXPECT_NEAR(DistanceOf({nullptr, 0, nullptr, 0.25, &floor}, {&cube, 0}, At({0, 0, 5})), 1.75,
              1e-15);
  EXPECT_NEAR(
      DistanceOf({nullptr, 0, nullptr, 0.25, &floor}, {&cube, 0, &foot, 0.125}, At({0, 0, 5})),
      5 - 3.75 - 0.375, 1e-15);
}

TEST(RoundSolids, DistancesInClosedForm) {
  // Coaxial, side by side, crossed, and end to side.
  const Solid slim = Cylinder(0.25, 2), wide = Cylinder(1, 0.5);
  EXPECT_NEAR(Apart(slim, wide, At({0, 0, 4})), 1.5, 1e-12);
  EXPECT_NEAR(Apart(slim, wide, At({3, 4, 1})), 5 - 1.25, 1e-12);
  EXPECT_NEAR(Apart(slim, Cylinder(1, 5, kAlongX), At({0.5, 3, 0.5})), 3 - 1.25, 1e-12);
  EXPECT_NEAR(Apart(wide, Cylinder(0.25, 2, kAlongX), At({5, 0.1, 0.1})), 2, 1e-12);
  // Rim to rim: 3² + 4² = 5².
  EXPECT_NEAR(Apart(slim, wide, At({4.25, 0, 6.5})), 5, 1e-12);
  // An apex over a lid, and over a ball; a ball beside a cone whose side is inclined as 3 to 4.
  const Solid cone = Cone(3, 2), ball{Mesh::OfSegment({}, {}), 0.5};
  EXPECT_NEAR(Apart(Cylinder(1, 1), Cone(1, 2, {0, 1, 0, 0}), At({0.2, 0.3, 5})), 2, 1e-12);
  EXPECT_NEAR(Apart(cone, ball, At({0, 0, 4})), 1.5, 1e-12);
  // The side's middle is (1.5, 0, 0), its normal (4, 0, 3) / 5.
  EXPECT_NEAR(Apart(cone, ball, At({1.5 + 4, 0, 3})), 4.5, 1e-12);
  EXPECT_NEAR(Apart(cone, ball, At({3 + 4, 0, -2 - 3})), 4.5, 1e-12);
  // An ellipsoid along its axes.
  const Solid egg = Ellipsoid({1, 2, 3});
  EXPECT_NEAR(Apart(egg, ball, At({4, 0, 0})), 2.5, 1e-12);
  EXPECT_NEAR(Apart(egg, ball, At({0, 0, -4})), 0.5, 1e-12);
  EXPECT_NEAR(Apart(egg, Ellipsoid({1, 2, 3}, kAlongX), At({0, 0, 6})), 2, 1e-12);
}

TEST(RoundSolids, BallsOfEllipsoidsAreBalls) {
  Random random(2);
  int touching = 0;
  for (int run = 0; run < 500; ++run) {
    const Pose pose = RandomPose(&random, 1.5);
    const Standing got = Between(Ellipsoid({0.7, 0.7, 0.7}), Ellipsoid({0.5, 0.5, 0.5}), pose);
    const double gap = Length(pose.p_AB) - 1.2;
    EXPECT_EQ(got.contact, gap <= 0) << run;
    EXPECT_LE(got.margin, std::fabs(gap) + 1e-12) << run;
    EXPECT_GE(got.margin, gap > 0 ? gap - 1e-12 : -gap / 4 - 1e-9) << run;
    touching += gap <= 0;
  }
  EXPECT_GE(touching, 50);
  EXPECT_LE(touching, 450);
}

constexpr int kSides = 24;

// A prism or pyramid of kSides sides; `scale` of its radius: 1 inside the round one.
Solid Sided(Kind kind, double r, double h, double scale) {
  std::vector<Vector> points;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    const Vector rim{scale * r * std::cos(angle), scale * r * std::sin(angle), -h};
    points.push_back(rim);
    if (kind == Kind::kCylinder) points.push_back({rim.x, rim.y, h});
  }
  if (kind == Kind::kCone) points.push_back({0, 0, h});
  return {HullOf(points), 0};
}

// Goal:   distance and contact of cylinders and cones with boxes, meshes, ellipsoids and each other
//         lie between those of hulls inside and around them.
TEST(RoundSolids, LieBetweenHulls) {
  const double around = 1 / std::cos(std::numbers::pi / kSides);
  const Solid box{HullOf(BoxCorners({0.4, 0.3, 0.5})), 0.05};
  const Mesh mesh = BoxMesh(0.4, 0.3, 0.5);
  const std::vector<Solid> as_box = {{HullOf(BoxCorners({0.4, 0.3, 0.5})), 0}};
  Random random(9);
  int touching = 0, apart = 0;
  for (int run = 0; run < 400; ++run) {
    const Kind kind = run % 2 == 0 ? Kind::kCylinder : Kind::kCone;
    const Solid round = Round(kind, {0.5, 0.5, 0.7});
    const Solid inner = Sided(kind, 0.5, 0.7, 1), outer = Sided(kind, 0.5, 0.7, around);
    const Solid other = run % 3 == 0 ? box : run % 3 == 1 ? Cone(0.3, 0.6) : Ellipsoid({1, .5, .3});
    const Pose pose = RandomPose(&random, 1.3);
    const auto gap = [](const Standing& s) { return s.contact ? 0 : s.margin; };
    const double distance = gap(Between(round, other, pose));
    EXPECT_LE(distance, gap(Between(inner, other, pose)) + 1e-12) << run;
    EXPECT_GE(distance, gap(Between(outer, other, pose)) - 1e-12) << run;
    EXPECT_NEAR(gap(Between(other, round, pose.Inverse())), distance, 1e-11) << run;
    (distance > 0 ? apart : touching) += 1;
    // Triangles against the same box as a hull.
    const std::vector<Solid> solids = {round};
    const Body body{nullptr, 0, &solids}, triangles{&mesh, 0}, hull{nullptr, 0, &as_box};
    Hint hint;
    EXPECT_NEAR(DistanceOf(body, triangles, pose), DistanceOf(body, hull, pose), 1e-11) << run;
    EXPECT_EQ(InContact(triangles, body, pose.Inverse(), &hint), InContact(body, hull, pose, &hint))
        << run;
  }
  EXPECT_GE(touching, 80);
  EXPECT_GE(apart, 80);
}

// Goal:   a contact lasts while one is moved by less than its margin, which is not idle.
TEST(RoundSolids, TheMarginOfAContactKeepsItsPromise) {
  Random random(8);
  int contacts = 0;
  const Mesh mesh = BoxMesh(0.4, 0.3, 0.5);
  for (int run = 0; run < 200; ++run) {
    const std::vector<Solid> solids = {Round(run % 2 == 0 ? Kind::kCone : Kind::kCylinder,
                                             {0.5, 0.5, 0.4}, kAlongX, {0.1, 0, 0},
                                             run % 3 == 0 ? 0.1 : 0)};
    const std::vector<Solid> egg = {Ellipsoid({0.2, 0.3, 0.6})};
    const Body a{nullptr, 0, &solids};
    const Body b = run % 5 == 0 ? Body{&mesh, 0} : Body{nullptr, 0, &egg};
    const Pose pose = RandomPose(&random, 0.7);
    contacts += TouchWithinTheirMargin(a, b, pose, &random);
  }
  EXPECT_GE(contacts, 50);
  EXPECT_GT(Between(Cylinder(1, 1), Cylinder(1, 1), {}).margin, 0.5);
  EXPECT_GT(Between(Cylinder(1, 1), Cylinder(1, 1), At({0, 0, 1.9})).margin, 0.1 / 4);
  EXPECT_EQ(Between(Cylinder(1, 1), Cylinder(1, 1), At({0, 0, 2})).contact, true);
}

TEST(RoundSolids, ACoreInsideAClosedMeshIsInContact) {
  const Mesh cube = BoxMesh(3, 3, 3);
  const std::vector<Solid> solids = {Cylinder(1, 1)};
  Hint hint;
  const Standing inside = StandingOf({&cube, 0}, {nullptr, 0, &solids}, At({0.5, 0, 0}), &hint);
  EXPECT_TRUE(inside.contact);
  EXPECT_NEAR(inside.margin, 1.5, 1e-12);
  EXPECT_NEAR(DistanceTo({nullptr, 0, &solids}, {3, 4, 0.5}), 4, 1e-12);
  EXPECT_EQ(DistanceTo({nullptr, 0, &solids}, {0.5, 0.5, 0.5}), 0);
}

TEST(RoundSolids, ReachesAreThoseOfTheirFurthestPoints) {
  Random random(4);
  for (int run = 0; run < 60; ++run) {
    const auto kind = static_cast<Kind>(run % 3);
    const double r = random.Uniform(0.1, 2);
    const Vector half{r, kind == Kind::kEllipsoid ? random.Uniform(0.1, 2) : r,
                      random.Uniform(0.1, 2)};
    const Quaternion q = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1), 0.1};
    const Vector p{random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
    const RoundCore core(kind, half, q, p);
    double furthest = 0;
    // From any point on: the point that is furthest along the line to the furthest so far.
    for (int start = 0; start < 40; ++start) {
      const auto u = random.UnitVector();
      Vector d{u.x(), u.y(), u.z()};
      for (int i = 0; i < 300; ++i) d = core.Support(d);
      furthest = std::max(furthest, Length(d));
    }
    EXPECT_NEAR(core.radius_m(), furthest, 1e-7) << run;
    EXPECT_GE(core.radius_m(), furthest * (1 - 1e-12)) << run;
  }
  EXPECT_NEAR(RoundCore(Kind::kEllipsoid, {1, 2, 3}, kUpright, {0, 0, 4}).radius_m(), 7, 1e-7);
  EXPECT_EQ(RoundCore(Kind::kEllipsoid, {1, 2, 3}, kUpright, {}).radius_m(), 3);
}

AgentMotion Flying(const std::string& name, const Solid& solid, const Piece& piece) {
  const std::vector<Solid> solids = {solid};
  AgentMotion motion = MovingBall(name, solid.radius_m(), {}, {}, 1);
  motion.solids = std::make_shared<std::vector<Solid>>(solids);
  motion.pieces = {piece};
  return motion;
}

AgentMotion Floor(double offset, double seconds) {
  AgentMotion floor = MovingBall("floor", 0, {}, {}, seconds);
  floor.half_space = HalfSpace{{0, 0, 1}, offset};
  return floor;
}

double Seconds(long double ns) { return static_cast<double>(ns) * 1e-9; }

// Goal:   times of contact with a floor are those of geometry.
// Method: a ball thrown down and up; a cylinder that falls; one of radius 4 m and half length 3 m
//         that turns at 1 rad/s, its middle 4.5 m up: its lowest point is 5 cos(t − φ) below that,
//         tan φ = 4 / 3, up to a quarter of a turn.
TEST(RoundContacts, KnownTimesAboveAFloor) {
  Piece thrown{0, 4'000'000'000, {}};
  thrown.p_WA[2] = {4, -4, 1, 0};  // (t − 2)²
  AgentMotion ball = MovingBall("ball", 0.25, {}, {}, 1);
  ball.pieces = {thrown};
  auto contacts = TrueContacts({Floor(0, 4), ball});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Seconds(contacts[0].begin_ns), 1.5, 1e-9);
  EXPECT_NEAR(Seconds(contacts[0].end_ns), 2.5, 1e-9);
  EXPECT_TRUE(contacts[0].certain);
  EXPECT_TRUE(TrueContacts({Floor(-0.2501, 4), ball}).empty());
  EXPECT_TRUE(TrueContacts({Floor(0, 4), Floor(1, 4)}).empty());

  Piece falling{0, 2'000'000'000, {}};
  falling.p_WA[2] = {6, 0, -5, 0};
  contacts = TrueContacts({Flying("drum", Cylinder(2, 1), falling), Floor(0, 2)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Seconds(contacts[0].begin_ns), 1, 1e-9);
  EXPECT_TRUE(contacts[0].to_end);

  Piece turning{0, 1'700'000'000, {}};
  turning.p_WA[2] = {4.5, 0, 0, 0};
  turning.turn = Turn{{1, 0, 0, 0}, {0, 1, 0}, {}};
  contacts = TrueContacts({Floor(0, 1.7), Flying("drum", Cylinder(4, 3), turning)});
  ASSERT_EQ(contacts.size(), 1u);
  const double middle = std::atan2(4, 3), half = std::acos(0.9);
  EXPECT_NEAR(Seconds(contacts[0].begin_ns), middle - half, 1e-8);
  EXPECT_NEAR(Seconds(contacts[0].end_ns), middle + half, 1e-8);
}

// Goal:   times of contact of round solids with each other.
// Method: crossed cylinders pass at 1 m/s, axes √(1 − x²) apart where they touch; a cone's apex
//         runs through a ball.
TEST(RoundContacts, KnownTimesOfEachOther) {
  Piece rest{0, 20'000'000'000, {}}, along = rest;
  along.p_WA[0] = {-10, 1, 0, 0};
  along.p_WA[2] = {0.6, 0, 0, 0};
  const Quaternion along_y = {1, 1, 0, 0};
  auto contacts = TrueContacts({Flying("post", Cylinder(0.25, 9, along_y), rest),
                                Flying("roll", Cylinder(0.75, 3, along_y), along)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Seconds(contacts[0].begin_ns), 9.2, 1e-8);
  EXPECT_NEAR(Seconds(contacts[0].end_ns), 10.8, 1e-8);
  along.p_WA[2][0] = 0;
  contacts = TrueContacts(
      {Flying("cone", Cone(1, 2, kAlongX), along), Flying("egg", Ellipsoid({0.5, 3, 1}), rest)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Seconds(contacts[0].begin_ns), 7.5, 1e-8);  // apex 2 m ahead
}

}  // namespace
}  // namespace collision::checker
