#include "client/checker/motion/motion_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "client/checker/motion/motion.h"
#include "tests/support/random.h"

namespace collision::checker {
namespace {

std::vector<AgentMotion> Read(const std::string& text) {
  std::istringstream stream(text);
  return ReadMotionLog(stream, "sim");
}

std::string Error(const std::string& text) {
  try {
    Read(text);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no error";
}

constexpr const char* kZeros = " 0 0 0 0 0 0 0 0 0 0 0 0\n";
constexpr const char* kTetrahedron =
    "mesh m 4 4 1 1 1 1 -1 -1 -1 1 -1 -1 -1 1 0 1 2 0 3 1 0 2 3 1 3 2\n";

TEST(MotionLogReading, MalformedLogsAreReportedWithTheirLine) {
  EXPECT_EQ(Error("hello\n"),
            "sim:1: the first line is none of \"motion-log 1\" to \"motion-log 5\"");
  EXPECT_EQ(Error("motion-log 1\npiece a 0 1\n"), "sim:2: agent \"a\" has no agent line before");
  EXPECT_EQ(Error("motion-log 1\nagent a 1\npiece a 0 1 0\n"),
            "sim:3: a piece needs twelve finite coefficients");
  EXPECT_EQ(Error("motion-log 1\nagent a 1\npiece a 5 1 0 0 0 0 0 0 0 0 0 0 0 0\n"),
            "sim:3: the piece goes back in time");
  EXPECT_EQ(Error("motion-log 1\nagent a 1\nhop a 5\n"), "sim:3: unknown record \"hop\"");
  EXPECT_EQ(Error("motion-log 1\nagent a 1\njump a 5 6\n"),
            "sim:3: the jump has more fields than it should");
}

TEST(MotionLogReading, MalformedMeshesAreReportedWithTheirLine) {
  const std::string start = "motion-log 2\n";
  EXPECT_EQ(Error(start + "mesh m 0 1\n"), "sim:2: a mesh needs 1 to 20000000 vertices");
  EXPECT_EQ(Error(start + "mesh m 1 99999999\n"), "sim:2: a mesh needs 1 to 20000000 triangles");
  EXPECT_EQ(Error(start + "mesh m 1 1 0 0 nan 0 0 0\n"),
            "sim:2: a vertex needs three finite coordinates");
  EXPECT_EQ(Error(start + "mesh m 1 1 0 0 0 0 0\n"), "sim:2: a triangle needs three indices");
  EXPECT_EQ(Error(start + "mesh m 3 1 0 0 0 1 0 0 0 1 0 0 1 3\n"),
            "sim:2: index 3 is not one of the mesh's 3 vertices");
  EXPECT_EQ(Error(start + "mesh m 3 1 0 0 0 1 0 0 0 1 0 0 1 -1\n"),
            "sim:2: index -1 is not one of the mesh's 3 vertices");
  EXPECT_EQ(Error(start + "mesh m 3 1 0 0 0 1 0 0 2 0 0 0 1 2\n"),
            "sim:2: no triangle has an area");
  EXPECT_EQ(Error(start + "mesh m 3 1 0 0 0 1 0 0 0 1 0 0 1 2 1\n"),
            "sim:2: the mesh has more fields than it should");
  EXPECT_EQ(Error(start + kTetrahedron + kTetrahedron), "sim:3: mesh \"m\" is there twice");
  EXPECT_EQ(Error(start + "agent a 2 m\n"), "sim:2: shape \"m\" has no mesh or solid line before");
  EXPECT_EQ(Error(start + kTetrahedron + "agent a 1.7 m\n"),
            "sim:3: shape \"m\" reaches 1.732051 m, beyond the agent's radius of 1.700000 m");
}

TEST(MotionLogReading, MalformedSolidsAreReportedWithTheirLine) {
  const std::string start = "motion-log 3\n", place = " 0 0 0 1 0 0 0";
  const std::string ball = "solid s ball 1" + place + "\n";
  EXPECT_EQ(Error(start + "solid s ball -1" + place + "\n"),
            "sim:2: a solid needs a rounding, a position and an orientation");
  EXPECT_EQ(Error(start + "solid s ball 1 0 0 0 1 0 0\n"),
            "sim:2: a solid needs a rounding, a position and an orientation");
  EXPECT_EQ(Error(start + "solid s ball 1 0 0 0 0 0 0 0\n"),
            "sim:2: shape \"s\": an orientation has no length");
  EXPECT_EQ(Error(start + "solid s torus 1" + place + " 1 2 3\n"),
            "sim:2: shape \"s\": unknown kind of solid \"torus\"");
  EXPECT_EQ(Error(start + "solid s ellipsoid 1" + place + " 1 2\n"),
            "sim:2: shape \"s\": an ellipsoid needs its half axes");
  EXPECT_EQ(Error(start + "solid s cone 1" + place + " 1\n"),
            "sim:2: shape \"s\": a cone needs its radius and half length");
  EXPECT_EQ(Error(start + "solid s cylinder 1" + place + " 1 -1\n"),
            "sim:2: shape \"s\": a negative length");
  EXPECT_EQ(Error(start + "solid s capsule 1" + place + "\n"),
            "sim:2: shape \"s\": a capsule needs its half length");
  EXPECT_EQ(Error(start + "solid s box 1" + place + " 1 2\n"),
            "sim:2: shape \"s\": a box needs its half extents");
  EXPECT_EQ(Error(start + "solid s hull 1" + place + " 65\n"),
            "sim:2: shape \"s\": a hull needs 1 to 64 points");
  EXPECT_EQ(Error(start + "solid s hull 1" + place + " 1 0 0\n"),
            "sim:2: shape \"s\": a point needs three finite coordinates");
  EXPECT_EQ(Error(start + "solid s ball 1" + place + " 1\n"),
            "sim:2: the solid has more fields than it should");
  EXPECT_EQ(Error(start + ball + "agent a 1 s\n" + ball),
            "sim:4: shape \"s\" has an agent already");
  EXPECT_EQ(Error(start + ball + "agent a 0.9 s\n"),
            "sim:3: shape \"s\" reaches 1.000000 m, beyond the agent's radius of 0.900000 m");
}

// Goal:   solids are what their line says, where it says, beside the triangles of the same name.
TEST(MotionLogReading, ReadsSolids) {
  const auto motions = Read("motion-log 3\n" + std::string(kTetrahedron) +
                            "solid m capsule 0.5 1 0 0 2 2 0 0 3\n"
                            "solid m box 0.25 0 0 4 1 0 0 0 1 1 1\n"
                            "agent a 9 m\npiece a 0 10" +
                            kZeros);
  ASSERT_EQ(motions.size(), 1u);
  ASSERT_EQ(motions[0].solids->size(), 2u);
  ASSERT_NE(motions[0].mesh, nullptr);
  // A quarter about x: the capsule's axis, z, becomes −y.
  const Solid& capsule = motions[0].solids->front();
  EXPECT_EQ(capsule.rounding_m, 0.5);
  EXPECT_NEAR(Length(capsule.core.vertices()[0] - Vector{1, 3, 0}) *
                  Length(capsule.core.vertices()[0] - Vector{1, -3, 0}),
              0, 1e-14);
  EXPECT_TRUE(motions[0].solids->back().core.closed());
  EXPECT_NEAR(motions[0].body().reach(), std::sqrt(27) + 0.25, 1e-12);
}

TEST(MotionLogReading, MalformedTurnsAreReportedWithTheirLine) {
  const std::string start = "motion-log 2\nagent a 1\n";
  const std::string piece = "piece a 0 10" + std::string(kZeros);
  const std::string next = "piece a 10 20" + std::string(kZeros);
  const std::string turn = "turn a 0 10 1 0 0 0 0 0 1 0 0 0\n";
  EXPECT_EQ(Error(start + piece + turn), "no error");
  EXPECT_EQ(Error(start + turn), "sim:3: a turn follows the piece that it belongs to");
  EXPECT_EQ(Error(start + piece + turn + turn),
            "sim:5: a turn follows the piece that it belongs to");
  EXPECT_EQ(Error(start + piece + "turn a 0 9 1 0 0 0 0 0 1 0 0 0\n"),
            "sim:4: the turn's instants are not those of the piece before it");
  EXPECT_EQ(Error(start + piece + "turn a 0 10 1 0 0 0.01 0 0 1 0 0 0\n"),
            "sim:4: the turn's quaternion is not of unit length");
  EXPECT_EQ(Error(start + piece + "turn a 0 10 1 0 0 0 0 0 1\n"),
            "sim:4: a turn needs ten finite numbers");
  EXPECT_EQ(Error(start + piece + "turn a 0 10 1 0 0 0 0 0 1e12 0 0 0\n"),
            "sim:4: the turn is 10000.000000 rad, more than 1000.000000");
  EXPECT_EQ(Error(start + piece + turn + next + "piece a 20 30" + kZeros),
            "sim:6: agent \"a\" turned before, but its last piece has no turn");
  EXPECT_EQ(Error(start + piece + turn + next),
            "sim:6: agent \"a\" turned before, but its last piece has no turn");
  EXPECT_EQ(Error(start + piece + next + "turn a 10 20 1 0 0 0 0 0 1 0 0 0\n"),
            "sim:5: earlier pieces of agent \"a\" have no turn");
}

// Goal:   both formats are read, to the last bit; agents share their mesh.
TEST(MotionLogReading, ReadsTheOlderFormats) {
  const auto old =
      Read("motion-log 1\nagent a 0.5\npiece a 0 10 0.1 0 0 0 0 0 0 0 0 0 0 0\njump a 3\n");
  ASSERT_EQ(old.size(), 1u);
  EXPECT_EQ(old[0].pieces[0].p_WA[0][0], 0.1);
  EXPECT_EQ(old[0].mesh, nullptr);
  EXPECT_FALSE(old[0].pieces[0].turn);
  EXPECT_EQ(old[0].jumps_ns, std::vector<std::int64_t>{3});

  const auto now = Read("motion-log 2\n" + std::string(kTetrahedron) +
                        "agent a 2 m\nagent b 2 m\nagent c 1\npiece a 0 10" + kZeros +
                        "turn a 0 10 0.6 0 0.8 0 1 2 3 4 5 6\npiece b 0 10" + kZeros);
  ASSERT_EQ(now.size(), 2u);  // c never moved
  EXPECT_EQ(now[0].mesh, now[1].mesh);
  EXPECT_EQ(now[0].mesh->triangles().size(), 4u);
  EXPECT_TRUE(now[0].mesh->closed());
  EXPECT_EQ(now[0].pieces[0].turn->q[2], 0.8);
  EXPECT_EQ(now[0].pieces[0].turn->w[2], 3);
  EXPECT_EQ(now[0].pieces[0].turn->b[0], 4);
}

TEST(MotionLogReading, ReadsClassesAndMargins) {
  const std::string start = "motion-log 5\nagent a 0.5\n",
                    piece = "piece a 0 10" + std::string(kZeros);
  const auto motions = Read(start + "class a cart\nmargin a 0.25\n" + piece);
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_EQ(motions[0].class_name, "cart");
  EXPECT_EQ(motions[0].body().reach(), 0.75);
  EXPECT_EQ(Error(start + "class a\n"), "sim:3: a class needs a name");
  EXPECT_EQ(Error(start + "margin a -1\n"), "sim:3: a margin needs a length, at least 0");
  EXPECT_EQ(Error(start + "margin a\n"), "sim:3: a margin needs a length, at least 0");
}

TEST(MotionLogReading, ReadsRoundSolidsAndHalfSpaces) {
  const std::string start = "motion-log 5\n", place = " 1 2 2 1 0 0 0";
  const auto motions =
      Read(start + "solid s ellipsoid 0.5" + place + " 1 1 3\nsolid s cone 0 0 0 0 0 1 0 0 1 2\n" +
           "half-space floor 0 0 2 3\nagent a 10 s\npiece floor 0 10" + kZeros + "piece a 0 10" +
           kZeros);
  ASSERT_EQ(motions.size(), 2u);
  ASSERT_TRUE(motions[0].half_space);
  EXPECT_EQ(motions[0].half_space->normal, (Vector{0, 0, 1}));
  EXPECT_EQ(motions[0].half_space->offset_m, 1.5);
  const auto& solids = *motions[1].solids;
  ASSERT_EQ(solids.size(), 2u);
  EXPECT_EQ(solids[0].rounding_m, 0.5);
  EXPECT_EQ(solids[0].round->Support({0, 0, 9}), (Vector{1, 2, 5}));
  // Turned by half about x: the apex is below.
  EXPECT_EQ(solids[1].round->Support({0, 0, -1}), (Vector{0, 0, -2}));
  EXPECT_EQ(Error(start + "half-space floor 0 0 0 1\n"),
            "sim:2: a half-space needs a normal and an offset");
  const std::string floor = start + "half-space floor 0 0 1 1\n";
  EXPECT_EQ(Error(floor + "piece floor 0 10 1 0 0 0 0 0 0 0 0 0 0 0\n"),
            "sim:3: a half-space never moves");
  EXPECT_EQ(Error(floor + "piece floor 0 10" + kZeros + "turn floor 0 10 1 0 0 0 0 0 1 0 0 0\n"),
            "sim:4: a half-space never turns");
}

// Goal:   the power series solves q' = ½ ω q.
// Method: against the classic Runge-Kutta method with steps of 0.1 ms, and for a constant rate
// against the closed form.
TEST(Orientation, SolvesItsDifferentialEquation) {
  Random random(7);
  for (int run = 0; run < 20; ++run) {
    Turn turn;
    for (auto& x : turn.w) x = random.Uniform(-5, 5);
    for (auto& x : turn.b) x = random.Uniform(-9, 9);
    turn.q = {0.5, 0.5, -0.5, 0.5};
    const auto slope = [&](const Quaternion& q, long double t) {
      const long double x = turn.w[0] + turn.b[0] * t, y = turn.w[1] + turn.b[1] * t,
                        z = turn.w[2] + turn.b[2] * t;
      return Quaternion{(-x * q[1] - y * q[2] - z * q[3]) / 2, (x * q[0] + y * q[3] - z * q[2]) / 2,
                        (y * q[0] + z * q[1] - x * q[3]) / 2, (z * q[0] + x * q[2] - y * q[1]) / 2};
    };
    const auto plus = [](const Quaternion& q, long double h, const Quaternion& s) {
      return Quaternion{q[0] + h * s[0], q[1] + h * s[1], q[2] + h * s[2], q[3] + h * s[3]};
    };
    Quaternion q = {0.5L, 0.5L, -0.5L, 0.5L};
    const long double h = 1e-4L;
    for (int i = 0; i < 10000; ++i) {
      const long double t = i * h;
      const Quaternion s1 = slope(q, t), s2 = slope(plus(q, h / 2, s1), t + h / 2);
      const Quaternion s3 = slope(plus(q, h / 2, s2), t + h / 2), s4 = slope(plus(q, h, s3), t + h);
      q = plus(plus(plus(plus(q, h / 6, s1), h / 3, s2), h / 3, s3), h / 6, s4);
    }
    const Quaternion series = OrientationAt(turn, 1);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(static_cast<double>(series[k] - q[k]), 0, 1e-12);
  }
  const Quaternion quarter = OrientationAt({{1, 0, 0, 0}, {0, 3, 4}, {}}, M_PI_2 / 5);
  EXPECT_NEAR(static_cast<double>(quarter[0]), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(static_cast<double>(quarter[2]), 0.6 * std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(static_cast<double>(quarter[3]), 0.8 * std::sqrt(0.5), 1e-15);
}

std::array<double, 3> Rotated(const Quaternion& q, const Vector& v) {
  const auto w = static_cast<double>(q[0]), x = static_cast<double>(q[1]),
             y = static_cast<double>(q[2]), z = static_cast<double>(q[3]);
  // v + 2 w (u × v) + 2 u × (u × v), u = (x, y, z)
  const Vector u{x, y, z};
  const Vector uv = Cross(u, v);
  const Vector r = v + 2 * w * uv + 2 * Cross(u, uv);
  return {r.x, r.y, r.z};
}

Piece RandomPiece(Random* random) {
  Piece piece{0, 1'000'000'000, {}};
  for (auto& axis : piece.p_WA) {
    for (double& c : axis) c = random->Uniform(-2, 2);
  }
  Turn turn;
  for (auto& x : turn.w) x = random->Uniform(-2, 2);
  for (auto& x : turn.b) x = random->Uniform(-2, 2);
  const auto u = random->UnitVector();
  turn.q = {0.6, 0.8 * u.x(), 0.8 * u.y(), 0.8 * u.z()};
  piece.turn = turn;
  return piece;
}

Vector InWorld(const Piece& piece, const Vector& point, long double t) {
  const auto turned = Rotated(OrientationAt(*piece.turn, t), point);
  double p[3];
  for (int k = 0; k < 3; ++k) {
    const auto& c = piece.p_WA[k];
    p[k] = static_cast<double>(c[0] + t * (c[1] + t * (c[2] + t * c[3]))) + turned[k];
  }
  return {p[0], p[1], p[2]};
}

Vector RandomPoint(Random* random, double size) {
  const auto u = random->UnitVector();
  return {size * u.x(), size * u.y(), size * u.z()};
}

// Goal:   the pose of one body seen from the other is that of both in the world.
TEST(PairMotion, PoseIsThatOfTheWorld) {
  Random random(9);
  for (int run = 0; run < 100; ++run) {
    const Piece a = RandomPiece(&random), b = RandomPiece(&random);
    const long double t = random.Uniform(0, 0.5);
    const Pose pose = PairMotion(a, b, 500'000'000).At(t);
    const Vector point = RandomPoint(&random, 2);
    const Vector there = InWorld(b, point, t + 0.5L);
    EXPECT_NEAR(Length(InWorld(a, pose(point), t + 0.5L) - there), 0, 1e-14);
    EXPECT_NEAR(Length(pose.Back(pose(point)) - point), 0, 1e-14);
  }
}

// Goal:   no two points of the bodies move against each other faster than the bound, and it is not
// idle.
// Method: points of random bodies at random times, by differences.
TEST(PairMotion, SpeedIsBounded) {
  Random random(3);
  long double tightest = 0;
  for (int run = 0; run < 300; ++run) {
    const Piece a = RandomPiece(&random), b = RandomPiece(&random);
    const PairMotion motion(a, b, 0);
    const long double s0 = random.Uniform(0, 0.9), s1 = s0 + 0.1;
    const long double bound = motion.SpeedMax(s0, s1, 0.2, 0.5);
    for (int i = 0; i < 100; ++i) {
      const long double t = s0 + (s1 - s0) * random.Uniform(0, 1), h = 1e-6L;
      const Vector of_a = RandomPoint(&random, 0.2), of_b = RandomPoint(&random, 0.5);
      const Vector before = InWorld(b, of_b, t) - InWorld(a, of_a, t);
      const Vector after = InWorld(b, of_b, t + h) - InWorld(a, of_a, t + h);
      const long double speed = Length(after - before) / h;
      EXPECT_LE(speed, bound * (1 + 1e-5L) + 1e-5L);
      tightest = std::max(tightest, speed / bound);
    }
  }
  EXPECT_GE(tightest, 0.95L);
}

}  // namespace
}  // namespace collision::checker
