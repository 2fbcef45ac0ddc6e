// True contacts of bodies with triangles whose times are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "client/checker/motion/motion.h"
#include "tests/client/checker/solids.h"
#include "tests/support/random.h"

namespace collision::checker {
namespace {

double Begin(const TrueContact& contact) { return static_cast<double>(contact.begin_ns) * 1e-9; }
double End(const TrueContact& contact) { return static_cast<double>(contact.end_ns) * 1e-9; }

// The time within a contact in which a gap may have stayed unseen [s].
double BlindTime(const TrueContact& contact) {
  long double sum = 0;
  for (const Span& span : contact.blind) sum += span.end - span.begin;
  return static_cast<double>(sum) * 1e-9;
}

// Goal:   face to face, times are exact, and so are their tolerances.
// Method: cubes of half a metre, 9 m apart, 1 m/s: from 8 s to 10 s; other edges do not cross.
TEST(MeshContacts, CubesPassThroughEachOther) {
  const Mesh cube = BoxMesh(0.5, 0.5, 0.5);
  const auto contacts = TrueContacts({Moving("a", cube, {0, 0, 0}, {1, 0, 0}, 20),
                                      Moving("b", cube, {9, 0.3, 0.2}, {0, 0, 0}, 20)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Begin(contacts[0]), 8, 1e-9);
  EXPECT_NEAR(End(contacts[0]), 10, 1e-9);
  EXPECT_TRUE(contacts[0].certain);
  EXPECT_FALSE(contacts[0].from_start);
  EXPECT_FALSE(contacts[0].to_end);
  EXPECT_LE(contacts[0].begin_tolerance_ns, 100);
  EXPECT_LE(contacts[0].end_tolerance_ns, 100);
  EXPECT_LE(BlindTime(contacts[0]), 1e-5);
  // Balls of √¾ m overlap until the centres, 0.36 m aside, are 2 √¾ m apart.
  EXPECT_NEAR(static_cast<double>(contacts[0].balls_until_ns) * 1e-9, 9 + std::sqrt(3 - 0.13),
              1e-6);
}

// Goal:   nothing tunnels, however thin and fast.
// Method: a bullet of 2 mm at 800 m/s through a sheet of 2 mm: 4 mm long in contact.
TEST(MeshContacts, BulletThroughASheet) {
  const Mesh sheet = BoxMesh(0.001, 5, 5), bullet = BoxMesh(0.001, 0.001, 0.001);
  const auto contacts =
      TrueContacts({Moving("sheet", sheet, {}, {}, 1),
                    Moving("bullet", bullet, {-400.25, 0.2, 0.3}, {800, 0.1, 0}, 1)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Begin(contacts[0]), 400.248 / 800, 1e-9);
  EXPECT_NEAR(End(contacts[0]), 400.252 / 800, 1e-9);
}

// Goal:   overlapping balls are not a contact of the bodies inside.
TEST(MeshContacts, CubesPassBesideEachOther) {
  const Mesh cube = BoxMesh(0.5, 0.5, 0.5);
  const auto at = [&](double y) {
    return TrueContacts(
        {Moving("a", cube, {0, 0, 0}, {1, 0, 0}, 20), Moving("b", cube, {9, y, 0}, {0, 0, 0}, 20)});
  };
  EXPECT_TRUE(at(1 + 1e-4).empty());
  const auto deep = at(1 - 1e-4);
  ASSERT_EQ(deep.size(), 1u);
  EXPECT_TRUE(deep[0].certain);
  EXPECT_LE(deep[0].begin_tolerance_ns, 100);
  for (const double y : {1 - 1e-7, 1 + 1e-7}) {
    const auto grazes = at(y);
    EXPECT_GE(grazes.size(), 1u) << y;
    for (const TrueContact& graze : grazes) {
      EXPECT_FALSE(graze.certain) << y;
      EXPECT_GE(Begin(graze), 8 - 1e-3) << y;
      EXPECT_LE(End(graze), 10 + 1e-2) << y;
    }
  }
}

// Goal:   a turning rod hits at the angle that geometry says, and leaves likewise.
// Method: a rod from -2 to 2 m, 2 h = 0.1 m thick, turns at 1 rad/s; a thin post stands at
// (0, 1.9). Its edge comes to the rod when the long face, at a distance h from the axis, reaches
// the post's corner: corners (±e, 1.9 ± e). In the rod's axes a corner at radius R and angle φ has
// height R sin(φ - t); contact begins when that of the first corner falls to h.
TEST(MeshContacts, SweepingRodMeetsAPost) {
  const double h = 0.05, e = 0.01;
  const Mesh rod = BoxMesh(2, h, h), post = BoxMesh(e, e, 3);
  const auto contacts = TrueContacts({Turning(Moving("rod", rod, {}, {}, 3), {0, 0, 1}),
                                      Moving("post", post, {0, 1.9, 0}, {}, 3)});
  const auto time = [&](double x, double y, double height) {
    return std::atan2(y, x) - std::asin(height / std::hypot(x, y));
  };
  const double begin = std::min(time(e, 1.9 - e, h), time(e, 1.9 + e, h));
  const double end = std::max(time(-e, 1.9 - e, -h), time(-e, 1.9 + e, -h));
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Begin(contacts[0]), begin, 1e-8);
  EXPECT_NEAR(End(contacts[0]), end, 1e-8);
}

// Goal:   turning counts in the right direction, about the right axis, at a growing rate.
// Method: the same rod, from rest with 1 rad/s² about -z: it comes to the post at (0, -1.9) after
// the root of twice the angle.
TEST(MeshContacts, RodTurnsFasterAndFaster) {
  const double h = 0.05, e = 0.01;
  AgentMotion rod = Moving("rod", BoxMesh(2, h, h), {}, {}, 3);
  rod.pieces[0].turn = Turn{{1, 0, 0, 0}, {0, 0, 0}, {0, 0, -1}};
  const auto contacts = TrueContacts({rod, Moving("post", BoxMesh(e, e, 3), {0, -1.9, 0}, {}, 3)});
  const double angle = std::min(std::atan2(1.9 - e, e) - std::asin(h / std::hypot(e, 1.9 - e)),
                                std::atan2(1.9 + e, e) - std::asin(h / std::hypot(e, 1.9 + e)));
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Begin(contacts[0]), std::sqrt(2 * angle), 1e-8);
}

// Goal:   moving and turning together: edge to face.
// Method: a cube turned by 45 degrees about z comes edge first; the other way it turns on, at
// π/4 rad/s, and is flat again when its face, not its edge, would have met: it does not touch a
// wall that an edge would touch.
TEST(MeshContacts, TurnedCubeComesEdgeFirst) {
  const Mesh cube = BoxMesh(0.5, 0.5, 0.5), wall = BoxMesh(0.5, 5, 5);
  const double c = std::cos(std::numbers::pi / 8), s = std::sin(std::numbers::pi / 8);
  AgentMotion turned = Turning(Moving("a", cube, {0, 0, 0}, {1, 0, 0}, 4), {0, 0, 0});
  turned.pieces[0].turn->q = {c, 0, 0, s};
  const AgentMotion still = Moving("b", wall, {3, 0, 0}, {}, 4);
  auto contacts = TrueContacts({turned, still});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Begin(contacts[0]), 2.5 - std::sqrt(0.5), 1e-9);

  // x = 1.9 - ½ (t - 1)²: nearest at t = 1, when it has turned by 45 degrees to be flat.
  turned.pieces[0].t1_ns = 2'000'000'000;
  turned.pieces[0].p_WA[0] = {1.4, 1, -0.5, 0};
  turned.pieces[0].turn->w = {0, 0, std::numbers::pi / 4};
  EXPECT_TRUE(TrueContacts({turned, still}).empty());
  turned.pieces[0].turn->w = {0, 0, 0};
  EXPECT_EQ(TrueContacts({turned, still}).size(), 1u);
}

// Goal:   a body inside another is in contact though no triangles cross, born there or brought
// there; and the ends of it are found.
// Method: a small cube, moving at 1 m/s, in a cube of 8 m: its front face leaves through nothing;
// it is out when its back face has passed the wall.
TEST(MeshContacts, ContainedIsContact) {
  const Mesh small = BoxMesh(0.25, 0.25, 0.25), large = BoxMesh(4, 4, 4);
  auto contacts = TrueContacts(
      {Moving("a", small, {0.1, 0.2, 0.3}, {1, 0, 0}, 10), Moving("b", large, {}, {}, 10)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_TRUE(contacts[0].from_start);
  EXPECT_TRUE(contacts[0].certain);
  EXPECT_NEAR(End(contacts[0]), 4.15, 1e-8);

  AgentMotion jumping = Moving("a", small, {20, 0, 0}, {}, 2);
  Piece inside = jumping.pieces[0];
  inside.t0_ns = 2'000'000'000;
  inside.t1_ns = 3'000'000'000;
  inside.p_WA[0] = {1, 0, 0, 0};
  jumping.pieces.push_back(inside);
  contacts = TrueContacts({Moving("b", large, {}, {}, 3), jumping});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(Begin(contacts[0]), 2);
  EXPECT_TRUE(contacts[0].to_end);
}

// Goal:   an open surface has no inside.
// Method: a square falls through a cube: contact while they cross, and while the square, smaller
// than the cube, is inside it; two squares only touch while they cross.
TEST(MeshContacts, OpenSurfaces) {
  const Mesh square = SquareMesh(0.25), cube = BoxMesh(1, 1, 1);
  auto contacts =
      TrueContacts({Moving("a", square, {0, 0, 3}, {0, 0, -1}, 6), Moving("b", cube, {}, {}, 6)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Begin(contacts[0]), 2, 1e-8);
  EXPECT_NEAR(End(contacts[0]), 4, 1e-8);

  // A cube that lost a face is a surface: the square inside is not in contact.
  Faces faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4},
                 {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}};
  const Mesh open(cube.vertices(), faces);
  EXPECT_FALSE(open.closed());
  contacts = TrueContacts({Moving("a", square, {}, {}, 1), Moving("b", open, {}, {}, 1)});
  EXPECT_TRUE(contacts.empty());

  // Upright against lying, from the side: they cross from 0.5 s on, for a second.
  AgentMotion upright = Turning(Moving("a", square, {0, -0.5, 0}, {0, 1, 0}, 3), {});
  upright.pieces[0].turn->q = {std::sqrt(0.5), std::sqrt(0.5), 0, 0};
  contacts = TrueContacts({upright, Moving("b", SquareMesh(0.1), {}, {}, 3)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Begin(contacts[0]), 0.4, 1e-8);
  EXPECT_NEAR(End(contacts[0]), 0.6, 1e-8);
}

// Goal:   a ball against triangles: a face, a corner, and all the way through the inside.
TEST(MeshContacts, BallAgainstCube) {
  const Mesh cube = BoxMesh(1, 1, 1);
  const auto contacts = TrueContacts(
      {MovingBall("a", 0.25, {-3, 0.1, 0.2}, {1, 0, 0}, 6), Moving("b", cube, {}, {}, 6)});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(Begin(contacts[0]), 1.75, 1e-9);
  EXPECT_NEAR(End(contacts[0]), 4.25, 1e-9);
  EXPECT_LE(BlindTime(contacts[0]), 1e-5);

  // Along a diagonal, to the corner at √3; 1/√3 m/s on each axis.
  const double v = 1 / std::sqrt(3.0);
  const auto corner = TrueContacts(
      {Moving("a", cube, {}, {}, 6), MovingBall("b", 0.25, {3, 3, 3}, {-v, -v, -v}, 6)});
  ASSERT_EQ(corner.size(), 1u);
  EXPECT_NEAR(Begin(corner[0]), 3 * std::sqrt(3.0) - std::sqrt(3.0) - 0.25, 1e-9);
}

// Goal:   successive contacts are separate, and a lasting one is one.
// Method: a comb of two teeth passes a post: two contacts of 0.2 s, 0.4 s apart.
TEST(MeshContacts, TeethOfACombTouchOneByOne) {
  const Mesh tooth = BoxMesh(0.05, 0.5, 0.5);
  std::vector<Vector> vertices;
  Faces faces;
  const Faces box = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const double x : {-0.3, 0.3}) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    for (const Vector& v : tooth.vertices()) vertices.push_back(v + Vector{x, 0, 0});
    for (const auto& f : box) faces.push_back({f[0] + base, f[1] + base, f[2] + base});
  }
  const Mesh comb(vertices, faces);
  EXPECT_EQ(comb.part_points().size(), 2u);
  const auto contacts = TrueContacts({Moving("a", comb, {-2, 0, 0}, {1, 0, 0}, 4),
                                      Moving("b", BoxMesh(0.05, 0.05, 2), {}, {}, 4)});
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_NEAR(Begin(contacts[0]), 1.6, 1e-8);
  EXPECT_NEAR(End(contacts[0]), 1.8, 1e-8);
  EXPECT_NEAR(Begin(contacts[1]), 2.2, 1e-8);
  EXPECT_NEAR(End(contacts[1]), 2.4, 1e-8);
}

// Goal:   the same motion in other pieces gives the same contacts.
// Method: tetrahedra tumble past each other at random; cut at random instants, their orientation
// taken there from the closed form of a constant rate.
TEST(MeshContacts, CuttingMotionIntoPiecesChangesNothing) {
  Random random(23);
  std::size_t found = 0;
  for (int run = 0; run < 60; ++run) {
    AgentMotion whole[2], cut[2];
    for (int k = 0; k < 2; ++k) {
      const Vector p{random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-2, 2)};
      const Vector v{random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
      const Vector w{random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-2, 2)};
      whole[k] = Turning(Moving(std::to_string(k), TetrahedronMesh(0.6), p, v, 4), w);
      cut[k] = whole[k];
      cut[k].pieces.clear();
      for (std::int64_t t = 0; t < 4'000'000'000;) {
        Piece part{t, std::min<std::int64_t>(4'000'000'000, t + 1 + random.Below(900'000'000)), {}};
        const double s = static_cast<double>(t) * 1e-9;
        part.p_WA = {{{p.x + v.x * s, v.x}, {p.y + v.y * s, v.y}, {p.z + v.z * s, v.z}}};
        const double half = Length(w) * s / 2, n = std::sin(half) / Length(w);
        part.turn = Turn{{std::cos(half), n * w.x, n * w.y, n * w.z}, {w.x, w.y, w.z}, {}};
        cut[k].pieces.push_back(part);
        t = part.t1_ns;
      }
    }
    const auto expected = TrueContacts({whole[0], whole[1]});
    const auto actual = TrueContacts({cut[0], cut[1]});
    ASSERT_EQ(actual.size(), expected.size()) << "run " << run;
    for (std::size_t i = 0; i < actual.size(); ++i) {
      EXPECT_NEAR(Begin(actual[i]), Begin(expected[i]), 1e-8);
      EXPECT_NEAR(End(actual[i]), End(expected[i]), 1e-8);
    }
    found += expected.size();
  }
  EXPECT_GE(found, 15u);
}

// Goal:   every change is found: no contact is missed or invented, against plain sampling.
// Method: random tumbling tetrahedra; every instant of a fine grid that is in contact, by all pairs
// of triangles without boxes, lies in a contact, and no other does.
TEST(MeshContacts, AgreeWithSampling) {
  Random random(5);
  std::size_t inside = 0;
  for (int run = 0; run < 40; ++run) {
    AgentMotion m[2];
    for (int k = 0; k < 2; ++k) {
      const Vector p{random.Uniform(-1.5, 1.5), random.Uniform(-1.5, 1.5), random.Uniform(-1, 1)};
      const Vector v{random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
      const Vector w{random.Uniform(-4, 4), random.Uniform(-4, 4), random.Uniform(-4, 4)};
      m[k] = Turning(Moving(std::to_string(k), TetrahedronMesh(0.6), p, v, 2), w);
    }
    const auto contacts = TrueContacts({m[0], m[1]});
    const PairMotion motion(m[0].pieces[0], m[1].pieces[0], 0);
    for (int i = 0; i <= 500; ++i) {
      const long double t = i * 4e-3L;
      const Pose pose = motion.At(t);
      double distance = INFINITY;
      for (const Triangle& x : m[0].mesh->triangles()) {
        for (const Triangle& y : m[1].mesh->triangles())
          distance = std::min(distance, Distance(x, {pose(y[0]), pose(y[1]), pose(y[2])}));
      }
      const bool touching = distance == 0 || m[0].mesh->Contains(pose(m[1].mesh->vertices()[0])) ||
                            m[1].mesh->Contains(pose.Back(m[0].mesh->vertices()[0]));
      inside += touching;
      const bool known =
          std::any_of(contacts.begin(), contacts.end(), [&](const TrueContact& contact) {
            return contact.begin_ns - 10 <= t * 1e9L && t * 1e9L <= contact.end_ns + 10;
          });
      ASSERT_EQ(known, touching) << "run " << run << " at " << 4 * i << " ms";
    }
  }
  EXPECT_GE(inside, 250u);
}

}  // namespace
}  // namespace collision::checker
