// Goal:   convex solids in the whole service: alone or beside a surface they are an agent's shape;
//         what cannot be one is refused with the solid's number, field, value and allowed range,
//         reported to its owner, and costs no other agent anything; a replay gives the same events.
// Method: bytes built by hand; daemons on scripted buses. Pairs of equal bodies that reach from −1
//         m to 1 m along x, at rest 1.9 m and 2.3 m apart: their balls (radius 2) overlap at both,
//         they do at the first only.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <functional>
#include <limits>

#include "idl/limits.h"
#include "server/recording/recording.h"
#include "server/shapes/shape_decoding.h"
#include "tests/server/shapes/two_cubes.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

ShapeContent Of(std::vector<SolidContent> solids) {
  ShapeContent content;
  content.solids = std::move(solids);
  return content;
}

SolidContent Ball() { return {.kind = SolidKind::kBall, .rounding = 1}; }

/// Along x: turned by a quarter about y.
SolidContent Capsule() {
  return {.kind = SolidKind::kCapsule,
          .orientation = {3, 0, 3, 0},
          .half_extents = {0, 0, 0.75},
          .rounding = 0.25};
}

SolidContent Box() { return {.kind = SolidKind::kBox, .half_extents = {1, 0.5, 0.5}}; }

SolidContent Ellipsoid() { return {.kind = SolidKind::kEllipsoid, .half_extents = {1, 0.5, 0.25}}; }

/// An octahedron, with its middle.
SolidContent Hull() {
  return {.kind = SolidKind::kHull,
          .points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {}}};
}

/// Balls at both ends, a box between; and with a surface around the middle.
ShapeContent Dumbbell(bool with_surface) {
  ShapeContent content = with_surface ? Cube(0.25) : ShapeContent{};
  for (const double x : {-0.75, 0.75}) {
    content.solids.push_back({.kind = SolidKind::kBall, .position = {x, 0, 0}, .rounding = 0.25});
  }
  content.solids.push_back({.kind = SolidKind::kBox, .half_extents = {0.75, 0.125, 0.125}});
  return content;
}

struct Named {
  const char* name;
  ShapeContent content;
};

std::vector<Named> Bodies() {
  return {{"ball", Of({Ball()})},
          {"capsule", Of({Capsule()})},
          {"box", Of({Box()})},
          {"ellipsoid", Of({Ellipsoid()})},
          {"hull", Of({Hull()})},
          {"dumbbell", Dumbbell(false)},
          {"with a surface", Dumbbell(true)}};
}

/// What is said of it.
std::string RefusalOfContent(const ShapeContent& content) {
  const BuiltShape built = BuildShape("", EncodeShape(content), {.triangles_max = 100});
  EXPECT_EQ(built.shape == nullptr, !built.refusal.empty());
  return built.refusal;
}

// Goal:   solids arrive as they were meant: kind, place, turn, measures.
TEST(ShapeSolids, AreWhatTheBytesDescribe) {
  for (const auto& [name, content] : Bodies()) {
    SCOPED_TRACE(name);
    const BuiltShape built = BuildShape("", EncodeShape(content), {.triangles_max = 100});
    ASSERT_TRUE(built.shape) << built.refusal;
    EXPECT_EQ(built.shape->solids().size(), content.solids.size());
    EXPECT_EQ(built.shape->mesh().triangles.size(), content.triangles.size());
    const geometry::MeshFacts& facts = built.shape->facts();
    EXPECT_NEAR(facts.lower.x(), -1, 1e-9);
    EXPECT_NEAR(facts.upper.x(), 1, 1e-9);
    EXPECT_GE(facts.upper.x(), 1);
    EXPECT_LE(facts.upper.y(), 1 + 1e-9);
  }
  const BuiltShape capsule = BuildShape("", EncodeShape(Of({Capsule()})), {.triangles_max = 100});
  EXPECT_NEAR(capsule.shape->facts().upper.y(), 0.25, 1e-9);
  EXPECT_NEAR(capsule.shape->facts().upper.z(), 0.25, 1e-9);
}

// Goal:   the rotation is sent w first and takes the solid's frame to the body's, and the place is
//         where it is.
// Method: a thorn along x, turned by a quarter about z, so that it points along y; raised by 5 m.
TEST(ShapeSolids, StandWhereAndAsTheBytesSay) {
  const SolidContent thorn{.kind = SolidKind::kHull,
                           .position = {0, 0, 5},
                           .orientation = {2, 0, 0, 2},
                           .points = {{2, 0, 0}, {0, 0.25, 0}, {0, -0.25, 0}, {0, 0, 0.125}}};
  const BuiltShape built = BuildShape("", EncodeShape(Of({thorn})), {.triangles_max = 100});
  ASSERT_TRUE(built.shape) << built.refusal;
  const geometry::MeshFacts& facts = built.shape->facts();
  const Eigen::Vector3d lower(-0.25, 0, 5), upper(0.25, 2, 5.125);
  EXPECT_LT((facts.lower - lower).norm(), 1e-9) << facts.lower.transpose();
  EXPECT_LT((facts.upper - upper).norm(), 1e-9) << facts.upper.transpose();
}

struct Spoilt {
  const char* says;  ///< Of field, value and range.
  std::function<void(SolidContent*)> spoil;
  SolidContent solid = Box();
};

// Goal:   every number that cannot be is refused, by the number of its solid, field, value and
//         range.
// Method: the second of three solids is spoilt, in one number each.
TEST(ShapeSolids, EachBadNumberIsNamed) {
  const Spoilt cases[] = {
      {"kind is 0; allowed are 1 (ball)", [](auto* s) { s->kind = SolidKind{0}; }},
      {"kind is 8; allowed are 1 (ball)", [](auto* s) { s->kind = SolidKind{8}; }},
      {"half_extents.y is 0.5; allowed is the radius, as in x: 0.25",
       [](auto* s) {
         s->kind = SolidKind::kCone, s->half_extents = {0.25, 0.5, 1};
       }},
      {"kind is 4294967295; allowed", [](auto* s) { s->kind = SolidKind{0xffffffff}; }},
      {"half_extents.x is nan; allowed are 0 to", [](auto* s) { s->half_extents[0] = kNan; }},
      {"half_extents.y is -1; allowed are 0 to", [](auto* s) { s->half_extents[1] = -1; }},
      {"half_extents.z is inf; allowed are 0 to", [](auto* s) { s->half_extents[2] = kInf; }},
      {"rounding is -0.5; allowed are 0 to", [](auto* s) { s->rounding = -0.5; }},
      {"rounding is nan; allowed are 0 to", [](auto* s) { s->rounding = kNan; }},
      {"position.z is inf; allowed are finite", [](auto* s) { s->position[2] = kInf; }},
      {"position.x is -2e+07; allowed are", [](auto* s) { s->position[0] = -2e7; }},
      {"orientation has the length 0; allowed are", [](auto* s) { s->orientation = {}; }},
      {"orientation.w is nan; allowed are finite", [](auto* s) { s->orientation[0] = kNan; }},
      {"orientation.z is -inf; allowed are finite", [](auto* s) { s->orientation[3] = -kInf; }},
      {"its size is 2e-07 m; allowed are",
       [](auto* s) { s->rounding = 1e-7; },
       {.kind = SolidKind::kBall}},
      {"its size is 2e+07 m; allowed are", [](auto* s) { s->rounding = 1e7; }, Ball()},
      {"half_extents[0] is 0.5; allowed is 0: a ball has none along x",
       [](auto* s) { s->half_extents[0] = 0.5; }, Ball()},
      {"half_extents[1] is nan; allowed is 0: a capsule has none along y",
       [](auto* s) { s->half_extents[1] = kNan; }, Capsule()},
      {"half_extents[2] is 1; allowed is 0: a hull has none along z",
       [](auto* s) { s->half_extents[2] = 1; }, Hull()},
      {"there are 1 points; allowed are 0: a box has none",
       [](auto* s) { s->points.push_back({}); }},
      {"points: there are 0; allowed are 1 to", [](auto* s) { s->points.clear(); }, Hull()},
      {"points: there are 65537; allowed are 1 to 65536",
       [](auto* s) { s->points.resize(shape::kHullPointsMax + 1); }, Hull()},
      {"points[6].y is nan; allowed are finite", [](auto* s) { s->points[6][1] = kNan; }, Hull()},
  };
  for (const Spoilt& spoilt : cases) {
    ShapeContent content = Of({Ball(), spoilt.solid, Hull()});
    spoilt.spoil(&content.solids[1]);
    const std::string said = RefusalOfContent(content);
    EXPECT_TRUE(said.starts_with("solids[1] of 3")) << said;
    EXPECT_NE(said.find(spoilt.says), std::string::npos) << said << "\nnot: " << spoilt.says;
    EXPECT_LE(said.size(), 200u) << said;
  }
}

// Goal:   as many solids and points as allowed are taken, one more is refused.
TEST(ShapeSolids, LimitsOfNumberHold) {
  std::vector<SolidContent> balls(shape::kSolidsMax, {.kind = SolidKind::kBall, .rounding = 0.5});
  for (std::size_t i = 0; i < balls.size(); ++i) {
    balls[i].position = {static_cast<double>(i % 64), static_cast<double>(i / 64), 0};
  }
  EXPECT_EQ(RefusalOfContent(Of(balls)), "");
  balls.push_back(balls[0]);
  EXPECT_EQ(RefusalOfContent(Of(balls)), "65537 convex solids; allowed: 0 to 65536");
  SolidContent hull = Hull();
  hull.points.resize(wire::kShapeHullPointsMax / 16, {0, 0, 0});
  std::vector<SolidContent> hulls(16, hull);
  EXPECT_EQ(RefusalOfContent(Of(hulls)), "");
  hulls.push_back(Hull());
  EXPECT_EQ(RefusalOfContent(Of(hulls)), "its hulls have 1048583 points; allowed: 0 to 1048576");
}

// Goal:   beside solids a surface may be left out, not spoilt.
TEST(ShapeSolids, TheSurfaceBesideThemIsJudgedAsEver) {
  ShapeContent content = Dumbbell(true);
  content.triangles[3][1] = 8;
  EXPECT_NE(RefusalOfContent(content), "");
  content = Dumbbell(true);
  content.triangles.clear();
  EXPECT_NE(RefusalOfContent(content), "");
  content = Dumbbell(true);
  content.triangles = {{0, 0, 1}};
  EXPECT_NE(RefusalOfContent(content).find("degenerate"), std::string::npos);
  content.solids.clear();
  content.vertices.clear();
  content.triangles.clear();
  EXPECT_NE(RefusalOfContent(content), "");
}

// Goal:   any bytes at all give a shape or a sentence.
TEST(ShapeSolids, DamagedBytesAreNeverMoreThanRefused) {
  Random random(7);
  const std::string whole = EncodeShape(Dumbbell(true));
  int built = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = whole;
    for (std::uint64_t n = 1 + random.Below(4); n > 0; --n) {
      bytes[random.Below(bytes.size())] = static_cast<char>(random.Next());
    }
    const BuiltShape result = BuildShape("", bytes, {.triangles_max = 100});
    EXPECT_EQ(result.shape == nullptr, !result.refusal.empty());
    built += result.shape != nullptr;
  }
  EXPECT_GT(built, 100);
}

// Goal:   agents collide as their solids do: touching confirmed, apart not.
TEST(ShapeSolids, CollideInTheService) {
  for (const auto& [name, content] : Bodies()) {
    for (const bool touching : {true, false}) {
      SCOPED_TRACE(std::string(name) + (touching ? " touching" : " apart"));
      ScriptedDaemon daemon(Simulated());
      TwoCubes pair(touching ? 1.9 : 2.3, EncodeShape(content));
      daemon.Step(pair.Descriptions());
      daemon.Step(pair.Parts());
      daemon.Step({});
      Fly(&daemon, &pair, 10);
      const v1::CollisionEvent event = LastEvent(daemon);
      if (touching) {
        EXPECT_EQ(event.status(), v1::EVENT_CONFIRMED);
        EXPECT_LE(event.proximity().separation_m().upper(), 0);
      } else {
        EXPECT_EQ(event.revision(), 0u) << event.DebugString();
      }
      EXPECT_TRUE(daemon.rejections().empty());
      EXPECT_EQ(daemon.counter("shapes"), 1u);
      EXPECT_GT(daemon.counter("tree_bytes"), 0u);
      daemon.Step(RemovalsOf(kAlpha, PartsOf("alpha", EncodeShape(content))));
      daemon.Step({Removal(kAlpha, "alpha", 0), Removal(kAlpha, "alpha", 1)});
      EXPECT_EQ(daemon.counter("shapes") + daemon.counter("tree_bytes") +
                    daemon.counter("tree_nodes") + daemon.counter("shape_bytes"),
                0u);
    }
  }
}

// Goal:   a refused solid is reported to its owner; its agents stay balls, and all others are
//         judged as ever.
TEST(ShapeSolids, ABadOneIsReportedToItsOwnerAlone) {
  ScriptedDaemon daemon(Simulated());
  SolidContent bad = Box();
  bad.orientation = {};
  const std::string bad_bytes = EncodeShape(Of({Ball(), bad}));
  daemon.Step({From(kBeta, Shaped("beta", 0, bad_bytes))});
  daemon.Step(From(kBeta, PartsOf("beta", bad_bytes)));
  TwoCubes pair(1.9, EncodeShape(Of({Box()})));
  daemon.Step(pair.Descriptions());
  daemon.Step(pair.Parts());
  Fly(&daemon, &pair, 10);
  ASSERT_EQ(daemon.rejections().size(), 1u);
  const v1::Rejection rejection = daemon.rejections()[0];
  EXPECT_EQ(rejection.reason(), v1::REJECTED_BAD_SHAPE);
  EXPECT_EQ(rejection.topic(), v1::TOPIC_SHAPE);
  EXPECT_EQ(rejection.simulator_id(), SimulatorId("beta"));
  EXPECT_NE(rejection.detail().find("solids[1] of 2 (box): orientation has the length 0"),
            std::string::npos)
      << rejection.detail();
  EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
  EXPECT_EQ(daemon.counter("shapes"), 1u);
  EXPECT_EQ(daemon.counter("shapes_refused"), 1u);
}

// Goal:   the limit of bytes has room for solids where few triangles are allowed.
TEST(ShapeSolids, ManyFitBesideFewTriangles) {
  v1::Config config = Simulated();
  config.set_shape_triangles_max(1);
  ScriptedDaemon daemon(config);
  const std::string bytes = EncodeShape(Of(std::vector<SolidContent>(1000, Box())));
  daemon.Step(From(kAlpha, PartsOf("alpha", bytes)));
  daemon.Step({From(kAlpha, ClockOf("alpha", 0))});
  EXPECT_TRUE(daemon.rejections().empty());
  EXPECT_EQ(daemon.counter("shapes"), 1u);
}

// Goal:   a run with solids is replayed bit for bit.
TEST(ShapeSolids, AReplayGivesTheSameEvents) {
  const std::string path = testing::TempDir() + "shape_solids_test." + std::to_string(getpid());
  std::uint64_t hash = 0, count = 0;
  {
    const v1::Config config = CompleteConfig(Simulated());
    RecordingWriter writer(path, config);
    ScriptedDaemon daemon(config, &writer);
    TwoCubes pair(1.9, EncodeShape(Dumbbell(true)));
    daemon.Step(pair.Descriptions());
    Fly(&daemon, &pair, 5);
    daemon.Step(pair.Parts());
    Fly(&daemon, &pair, 20);
    hash = daemon.daemon().event_log().hash();
    count = daemon.daemon().event_log().count();
    EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
  }
  ExpectSameReplay(path, hash, count);
  EXPECT_GT(count, 1u);
  std::remove(path.c_str());
}

}  // namespace
}  // namespace collision::server
