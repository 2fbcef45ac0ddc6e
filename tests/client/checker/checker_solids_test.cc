// Convex solids as the checker sees them, by closed forms and other means than its own.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "client/checker/shape/bodies.h"
#include "client/checker/shape/placement.h"
#include "tests/client/checker/contact_margin.h"
#include "tests/client/checker/random_pose.h"
#include "tests/client/checker/solids.h"
#include "tests/support/random.h"

namespace collision::checker {
namespace {

Solid Ball(double radius, const Vector& p = {}) { return {Mesh::OfSegment(p, p), radius}; }
Solid Capsule(double radius, const Vector& from, const Vector& to) {
  return {Mesh::OfSegment(from, to), radius};
}
Solid Box(const Vector& half, double rounding = 0) { return {HullOf(BoxCorners(half)), rounding}; }

Body Of(const std::vector<Solid>& solids) { return {nullptr, 0, &solids}; }

// Goal:   the faces close, contain every point, and have the right number.
TEST(Hull, ClosesAroundItsPoints) {
  EXPECT_EQ(HullOf(BoxCorners({1, 2, 3})).triangles().size(), 12u);
  Random random(3);
  for (int run = 0; run < 40; ++run) {
    std::vector<Vector> points;
    const int count = 4 + static_cast<int>(random.Below(kHullPointsMax - 3));
    for (int i = 0; i < count; ++i) {
      // On a lattice many lie in one plane or on one line, and some are there twice.
      Vector p = RandomVector(&random, 2.4);
      if (run % 2 == 0) p = {std::round(p.x), std::round(p.y), std::round(p.z)};
      points.push_back(p);
    }
    const Mesh hull = HullOf(points);
    if (!hull.closed()) {
      EXPECT_LT(count, 8) << "the points fill space";
      continue;
    }
    for (const Vector& p : points) {
      for (const Triangle& t : hull.triangles()) {
        const Vector n = Cross(t[1] - t[0], t[2] - t[0]);
        EXPECT_LE(Dot(n, p - t[0]), 1e-11 * Length(n)) << run;
      }
    }
    Vector middle{};
    for (const Vector& p : points) middle = middle + (1.0 / count) * p;
    EXPECT_EQ(hull.WindingNumber(middle), 1) << run;
  }
}

// Goal:   where it is uncertain which points lie in one plane, the faces close or the hull fails.
// Method: a lattice's points, each moved by far less than what counts as on a plane, or by about
// it.
TEST(Hull, FailsWhereItsFacesDoNotJoin) {
  Random random(4);
  int said = 0, closed = 0;
  for (int run = 0; run < 60; ++run) {
    std::vector<Vector> points;
    for (const Vector& corner : BoxCorners({2, 1, 1})) {
      for (const double s : {0.0, 1.0}) {
        const Vector p = corner + s * Vector{corner.x > 0 ? -2.0 : 0, corner.y > 0 ? -1.0 : 0, 0};
        points.push_back(p + RandomVector(&random, run % 2 == 0 ? 1e-14 : 3e-12));
      }
    }
    try {
      EXPECT_TRUE(HullOf(points).closed()) << run;
      ++closed;
    } catch (const std::runtime_error&) {
      EXPECT_EQ(run % 2, 1) << run;
      ++said;
    }
  }
  EXPECT_GE(said, 1);
  EXPECT_GE(closed, 30);
}

TEST(Hull, OfFlatStraightAndSinglePoints) {
  const Mesh square = HullOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 0}});
  EXPECT_EQ(square.triangles().size(), 2u);
  EXPECT_FALSE(square.closed());
  EXPECT_EQ(SurfaceDistance(square, {0.25, 0.75, 3}), 3);
  const Mesh segment = HullOf({{2, 3, 6}, {0, 0, 0}, {1, 1.5, 3}});
  EXPECT_EQ(segment.radius_m(), 7);
  EXPECT_EQ(SurfaceDistance(segment, {4, 6, 12}), 7);
  const Mesh point = HullOf({{1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(SurfaceDistance(point, {3, 5, 9}), 7);
  EXPECT_FALSE(point.Contains({1, 2, 3}));
  EXPECT_THROW(HullOf({}), std::runtime_error);
  EXPECT_THROW(HullOf(std::vector<Vector>(kHullPointsMax + 1)), std::runtime_error);
}

TEST(Placing, TurnsAndMoves) {
  // A third of a turn about (1, 1, 1): x to y to z. Any length will do.
  const auto points = Placed({{1, 2, 3}}, {-3, -3, -3, -3}, {10, 20, 30});
  EXPECT_NEAR(Length(points[0] - Vector{13, 21, 32}), 0, 1e-14);
  EXPECT_THROW(Placed({}, {0, 0, 0, 0}, {}), std::runtime_error);
}

// Goal:   distance and margin of solids in closed form: 2² + 3² + 6² = 7².
TEST(Solids, ClosedCases) {
  Hint hint;
  const std::vector<Solid> ball = {Ball(1)}, far_ball = {Ball(2, {2, 3, 6})};
  Standing standing = StandingOf(Of(ball), Of(far_ball), {}, &hint);
  EXPECT_FALSE(standing.contact);
  EXPECT_EQ(standing.margin, 4);
  // Capsules across each other, 3 m apart.
  const std::vector<Solid> along_x = {Capsule(1, {-5, 0, 0}, {5, 0, 0})};
  const std::vector<Solid> along_y = {Capsule(0.5, {0, -5, 0}, {0, 5, 0})};
  EXPECT_NEAR(DistanceOf(Of(along_x), Of(along_y), At({1, 2, 3})), 1.5, 1e-15);
  standing = StandingOf(Of(along_x), Of(along_y), At({1, 2, 1}), &hint);
  EXPECT_TRUE(standing.contact);
  EXPECT_NEAR(standing.margin, 0.5, 1e-15);
  // A rounded box: flat over its face, round over its corner.
  const std::vector<Solid> box = {Box({1, 1, 1}, 0.25)};
  EXPECT_NEAR(DistanceOf(Of(box), Of(ball), At({0.5, 0.5, 4})), 1.75, 1e-15);
  EXPECT_NEAR(DistanceOf(Of(box), Of(ball), At({3, 4, 7})), 5.75, 1e-15);
  EXPECT_NEAR(DistanceTo(Of(box), {3, 4, 7}), 6.75, 1e-15);
  EXPECT_EQ(DistanceTo(Of(box), {0.9, 0, 1.2}), 0);
  // Inside: until the ball has left.
  standing = StandingOf(Of(box), Of(ball), At({0.5, 0, 0}), &hint);
  EXPECT_TRUE(standing.contact);
  EXPECT_NEAR(standing.margin, 0.5 + 0.25 + 1, 1e-15);
  EXPECT_NEAR(DepthAtMost(Of(box), Of(ball), At({1.5, 0, 0}), {}), 0.75, 1e-15);
  EXPECT_EQ(Of(box).reach(), std::sqrt(3) + 0.25);
}

// Goal:   a ball, a body of one ball and one at its reference point are alike; so are a box of
//         solids and a box of triangles.
TEST(Solids, AgreeWithBallsAndMeshes) {
  Random random(5);
  const std::vector<Solid> ball = {Ball(0.7)}, box = {Box({1, 0.5, 0.25})};
  // The margin of a deep crossing depends on where the faces are cut in two: the same here.
  const Mesh mesh = HullOf(BoxCorners({1, 0.5, 0.25}));
  int touching = 0;
  for (int run = 0; run < 300; ++run) {
    const Pose pose = RandomPose(&random, 1.5);
    const Body as_ball{nullptr, 0.7}, as_mesh{&mesh, 0};
    Hint first, second;
    Standing expected = StandingOf(as_mesh, as_ball, pose, &first);
    Standing got = StandingOf(Of(box), Of(ball), pose, &second);
    EXPECT_EQ(got.contact, expected.contact) << run;
    EXPECT_NEAR(got.margin, expected.margin, 1e-14) << run;
    EXPECT_EQ(InContact(Of(box), Of(ball), pose, &second), expected.contact);
    expected = StandingOf(as_mesh, as_mesh, pose, &first);
    got = StandingOf(Of(box), as_mesh, pose, &second);
    EXPECT_EQ(got.contact, expected.contact) << run;
    EXPECT_NEAR(got.margin, expected.margin, 1e-14) << run;
    EXPECT_NEAR(DepthAtMost(Of(box), Of(ball), pose, {1, 2, 3}),
                DepthAtMost(as_mesh, as_ball, pose, {1, 2, 3}), 1e-14);
    touching += expected.contact;
  }
  EXPECT_GE(touching, 30);
  EXPECT_LE(touching, 270);
}

// Goal:   a body of many parts is as near as its nearest, as firmly in contact as its firmest.
// Method: against all pairs of bodies of one part; triangles among them.
TEST(Solids, ABodyIsTheUnionOfItsParts) {
  Random random(6);
  const Mesh mesh = TetrahedronMesh(0.4);
  const auto several = [&] {
    return std::vector<Solid>{Box({0.5, 0.3, 0.1}, 0.05),
                              Capsule(0.1, RandomVector(&random, 1), RandomVector(&random, 1)),
                              Ball(0.3, RandomVector(&random, 1)),
                              Capsule(0.2, {1, 0, 0}, RandomVector(&random, 1))};
  };
  int touching = 0, apart = 0;
  for (int run = 0; run < 300; ++run) {
    const std::vector<Solid> a = several(), b = several();
    const Pose pose = RandomPose(&random, 1.8);
    Standing expected{false, INFINITY};
    double outside_a = INFINITY;
    const Vector point = RandomVector(&random, 2);
    std::vector<Body> parts_a = {{&mesh, 0}}, parts_b;
    std::vector<std::vector<Solid>> single;
    single.reserve(8);
    for (const Solid& solid : a) parts_a.push_back(Of(single.emplace_back(1, solid)));
    for (const Solid& solid : b) parts_b.push_back(Of(single.emplace_back(1, solid)));
    for (const Body& part_a : parts_a) {
      outside_a = std::min(outside_a, DistanceTo(part_a, point));
      for (const Body& part_b : parts_b) {
        Hint hint;
        const Standing one = StandingOf(part_a, part_b, pose, &hint);
        if (one.contact && !expected.contact) expected = {true, 0};
        if (one.contact == expected.contact)
          expected.margin = one.contact ? std::max(one.margin, expected.margin)
                                        : std::min(one.margin, expected.margin);
      }
    }
    const Body whole_a{&mesh, 0, &a};
    Hint hint;
    const Standing got = StandingOf(whole_a, Of(b), pose, &hint);
    EXPECT_EQ(got.contact, expected.contact) << run;
    EXPECT_LE(got.margin, expected.margin + 1e-14) << run;
    // The margin of parts inside each other is known only as far as the search went.
    EXPECT_GE(got.margin, got.contact ? 0 : expected.margin - 1e-14) << run;
    EXPECT_EQ(InContact(whole_a, Of(b), pose, &hint), expected.contact) << run;
    EXPECT_NEAR(DistanceTo(whole_a, point), outside_a, 1e-14) << run;
    (expected.contact ? touching : apart) += 1;
  }
  EXPECT_GE(touching, 50);
  EXPECT_GE(apart, 50);
}

// Goal:   a contact lasts while one is moved by less than its margin.
TEST(Solids, TheMarginOfAContactKeepsItsPromise) {
  Random random(8);
  int contacts = 0;
  for (int run = 0; run < 200; ++run) {
    const std::vector<Solid> a = {Box({0.5, 0.3, 0.2}, 0.1)};
    const std::vector<Solid> b = {Capsule(0.2, {-0.5, 0, 0}, {0.5, 0, 0}), Ball(0.3, {0, 0, 0.4})};
    const Pose pose = RandomPose(&random, 0.9);
    contacts += TouchWithinTheirMargin(Of(a), Of(b), pose, &random);
  }
  EXPECT_GE(contacts, 50);
}

AgentMotion MovingSolids(const std::string& name, const std::vector<Solid>& solids, const Vector& p,
                         const Vector& v, double seconds) {
  AgentMotion motion = MovingBall(name, Of(solids).reach(), p, v, seconds);
  motion.solids = std::make_shared<std::vector<Solid>>(solids);
  return motion;
}

double Seconds(long double ns) { return static_cast<double>(ns) * 1e-9; }

// Goal:   times of contact of solids are those of geometry.
// Method: a capsule across the way of a ball; a turning bar as a capsule: a segment of
//         radius ρ turns at 1 rad/s from +x about z against a ball of radius r at (0, 1, 0). They
//         touch where the ball's centre is r + ρ from the axis: the angle's cosine is r + ρ.
TEST(SolidContacts, KnownTimes) {
  const std::vector<Solid> post = {Capsule(0.25, {0, 0, -9}, {0, 0, 9})}, ball = {Ball(0.75)};
  auto contacts = TrueContacts({MovingSolids("post", post, {10, 0, 0}, {}, 20),
                                MovingSolids("ball", ball, {0, 0.6, 1}, {1, 0, 0}, 20)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Seconds(contacts[0].begin_ns), 9.2, 1e-9);
  EXPECT_NEAR(Seconds(contacts[0].end_ns), 10.8, 1e-9);
  EXPECT_TRUE(contacts[0].certain);
  EXPECT_TRUE(TrueContacts({MovingSolids("post", post, {10, 0, 0}, {}, 20),
                            MovingSolids("ball", ball, {0, 1.0001, 1}, {1, 0, 0}, 20)})
                  .empty());

  const std::vector<Solid> bar = {Capsule(0.1, {-2, 0, 0}, {2, 0, 0})};
  contacts = TrueContacts({Turning(MovingSolids("bar", bar, {}, {}, 3), {0, 0, 1}),
                           MovingBall("ball", 0.2, {0, 1, 0}, {}, 3)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Seconds(contacts[0].begin_ns), std::acos(0.3), 1e-8);
  EXPECT_NEAR(Seconds(contacts[0].end_ns), std::numbers::pi - std::acos(0.3), 1e-8);
}

}  // namespace
}  // namespace collision::checker
