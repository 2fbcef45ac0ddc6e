// Goal:   a shape lives as long as it is needed, whatever restarts or is disposed of; what is
//         refused is reported to its sender and costs no other simulator anything.
// Method: daemons on scripted buses; unit cubes, whole and spoilt.
#include <gtest/gtest.h>

#include "tests/server/shapes/two_cubes.h"

namespace collision::server {
namespace {

// Goal:   a higher run of a simulator gives up what the one before wrote, and what it writes itself
//         stays, also if that comes before its description.
TEST(ShapeLifetime, ANewRunOwnsWhatItWrites) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(From(kAlpha, PartsOf("alpha", CubeBytes())));
  daemon.Step({From(kAlpha, Shaped("alpha", 0, CubeBytes()))});
  EXPECT_EQ(daemon.counter("shapes"), 1u);
  const std::string other = EncodeShape(Cube(0.5));
  daemon.Step(From(kAlpha, PartsOf("alpha", other, 2)));
  EXPECT_EQ(daemon.counter("shapes"), 1u);
  EXPECT_EQ(daemon.counter("shape_bytes"), other.size());
  v1::AgentDescription next = Shaped("alpha", 0, other);
  next.set_run(2);
  daemon.Step({From(kAlpha, next)});
  EXPECT_EQ(daemon.counter("shapes"), 1u);
  EXPECT_TRUE(daemon.rejections().empty());
  daemon.Step({From(kAlpha, PartsOf("alpha", CubeBytes())[0])});
  ASSERT_EQ(daemon.rejections().size(), 1u);
  EXPECT_EQ(daemon.rejections()[0].reason(), v1::REJECTED_OLD_RUN);
}

// Goal:   the parts of a successor that comes before its predecessor's death is noticed take no
//         room; written again after it, they count.
TEST(ShapeLifetime, ASuccessorWritesItsPartsAgain) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  daemon.Step(From(kBeta, PartsOf("alpha", CubeBytes(), 2)));
  EXPECT_EQ(daemon.counter("shape_bytes"), 0u);
  daemon.Step({Liveliness(kAlpha, "alpha", false)});
  daemon.Step(From(kBeta, PartsOf("alpha", CubeBytes(), 2)));
  daemon.Step({From(kBeta, ClockOf("alpha", 0, 2))});
  EXPECT_EQ(daemon.counter("shapes"), 1u);
}

// Goal:   a shape lives while an agent refers to it, also after its disposal and after those that
//         wrote it have left; it may be written again.
TEST(ShapeLifetime, LivesAsLongAsItIsNeeded) {
  ScriptedDaemon daemon(Simulated());
  const std::vector<v1::ShapePart> parts = PartsOf("alpha", CubeBytes());
  const auto shapes = [&daemon] { return daemon.counter("shapes"); };
  for (int times = 1; times <= 2; ++times) {
    daemon.Step(From(kAlpha, parts));
    v1::AgentDescription agent = Shaped("alpha", 0, CubeBytes());
    agent.set_generation(times);
    daemon.Step({From(kAlpha, agent)});
    EXPECT_EQ(shapes(), 1u);
    daemon.Step(RemovalsOf(kAlpha, parts));
    EXPECT_EQ(shapes(), 1u);
    daemon.Step({Removal(kAlpha, "alpha", 0)});
    EXPECT_EQ(shapes(), 0u);
    EXPECT_EQ(daemon.counter("shape_bytes") + daemon.counter("tree_bytes"), 0u);
  }
  // Disposed of and written again in one batch: it stays.
  daemon.Step(From(kAlpha, parts));
  std::vector<v1::Input> both = RemovalsOf(kAlpha, parts);
  for (const v1::Input& input : From(kAlpha, parts)) both.push_back(input);
  daemon.Step(both);
  EXPECT_EQ(shapes(), 1u);
  // Another simulator's agent refers to it; then its owner leaves.
  daemon.Step({From(kBeta, Shaped("beta", 0, CubeBytes())), From(kAlpha, ClockOf("alpha", 0))});
  daemon.Step({Liveliness(kAlpha, "alpha", false)});
  EXPECT_EQ(shapes(), 1u);
  v1::AgentDescription ball = Description("beta", 0);
  ball.set_revision(2);
  daemon.Step({From(kBeta, ball)});
  EXPECT_EQ(shapes(), 0u);
  EXPECT_TRUE(daemon.rejections().empty());
}

// Goal:   only their owner disposes of parts.
TEST(ShapeLifetime, AStrangersDisposalIsRefused) {
  ScriptedDaemon daemon(Simulated());
  const std::vector<v1::ShapePart> parts = PartsOf("alpha", CubeBytes());
  daemon.Step({From(kAlpha, ClockOf("alpha", 0))});
  daemon.Step(From(kAlpha, parts));
  daemon.Step({RemovalsOf(kBeta, parts)[0]});
  ASSERT_EQ(daemon.rejections().size(), 1u);
  EXPECT_EQ(daemon.rejections()[0].reason(), v1::REJECTED_ID_OWNED);
  EXPECT_EQ(daemon.rejections()[0].topic(), v1::TOPIC_SHAPE);
  EXPECT_EQ(daemon.counter("shapes"), 1u);
  daemon.Step(RemovalsOf(0, parts));  // the parts themselves say it
  EXPECT_EQ(daemon.counter("shapes"), 0u);
}

// Goal:   two simulators with one shape, one of them with other bytes under its hash: that one is
//         rejected, and both fly the true shape.
TEST(ShapeLifetime, AFalseCopySpoilsNoTrueShape) {
  ScriptedDaemon daemon(Simulated());
  std::vector<v1::ShapePart> lies = PartsOf("beta", CubeBytes());
  lies[0].mutable_bytes()->back() ^= 1;
  daemon.Step({From(kBeta, Description("beta", 0))});
  daemon.Step(From(kBeta, lies));
  ASSERT_EQ(daemon.rejections().size(), 1u);
  const v1::Rejection rejection = daemon.rejections()[0];
  EXPECT_EQ(rejection.reason(), v1::REJECTED_BAD_SHAPE);
  EXPECT_EQ(rejection.topic(), v1::TOPIC_SHAPE);
  EXPECT_EQ(rejection.simulator_id(), SimulatorId("beta"));
  EXPECT_EQ(rejection.field(), "content_hash");
  TwoCubes cubes(1.9);
  daemon.Step(cubes.Descriptions());
  daemon.Step(cubes.Parts());
  Fly(&daemon, &cubes, 10);
  EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
  EXPECT_EQ(daemon.counter("shapes"), 1u);
  EXPECT_EQ(daemon.counter("shapes_refused"), 1u);
  EXPECT_EQ(daemon.rejections().size(), 1u);
}

// Goal:   content that is no mesh is reported to its sender by name, and its agents stay balls.
TEST(ShapeLifetime, BadContentIsReportedToItsSender) {
  ShapeContent content = Cube(1);
  content.triangles[4][0] = 99;
  const std::string bad = EncodeShape(content);
  ScriptedDaemon daemon(Simulated());
  TwoCubes cubes(1.9, bad);
  daemon.Step(cubes.Descriptions());
  daemon.Step(cubes.Parts());
  Fly(&daemon, &cubes, 10);
  ASSERT_EQ(daemon.rejections().size(), 1u);
  const v1::Rejection rejection = daemon.rejections()[0];
  EXPECT_EQ(rejection.reason(), v1::REJECTED_BAD_SHAPE);
  EXPECT_EQ(rejection.simulator_id(), SimulatorId("alpha"));
  EXPECT_EQ(rejection.run(), 1u);
  EXPECT_NE(rejection.detail().find("99"), std::string::npos) << rejection.detail();
  EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_POSSIBLE);
  EXPECT_EQ(daemon.counter("shapes"), 0u);
}

// Goal:   a shape that reaches out of its agent's ball is reported once per description, and never
//         confirmed; a description with room for it mends it. At the radius itself it fits.
TEST(ShapeLifetime, AShapeMustFitIntoItsBall) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(From(kAlpha, PartsOf("alpha", CubeBytes())));
  daemon.Step({From(kAlpha, Shaped("alpha", 0, CubeBytes(), kCubeRadius))});
  daemon.Step({From(kAlpha, Shaped("alpha", 2, CubeBytes(), kCubeRadius * (1 - 0.9e-9)))});
  EXPECT_TRUE(daemon.rejections().empty());
  v1::AgentDescription small = Shaped("alpha", 1, CubeBytes(), kCubeRadius * (1 - 1.1e-9));
  daemon.Step({From(kAlpha, small)});
  daemon.Step({From(kAlpha, small)}, 10);
  ASSERT_EQ(daemon.rejections().size(), 1u);
  const v1::Rejection rejection = daemon.rejections()[0];
  EXPECT_EQ(rejection.reason(), v1::REJECTED_BAD_SHAPE);
  EXPECT_EQ(rejection.topic(), v1::TOPIC_AGENT_DESCRIPTION);
  EXPECT_EQ(rejection.field(), "radius_m");
  EXPECT_EQ(rejection.slot(), 1u);
  small.set_revision(2);
  small.set_radius_m(2);
  daemon.Step({From(kAlpha, small)});
  EXPECT_EQ(daemon.rejections().size(), 1u);
}

// Goal:   missing parts are reported once, after undescribed_after_s, with how many are there.
TEST(ShapeLifetime, ReportsThatPartsAreMissing) {
  const std::vector<v1::ShapePart> parts = PartsOf("alpha", CubeBytes());
  for (const std::size_t arrived : {0, 2, 3}) {
    ScriptedDaemon daemon(Simulated());
    daemon.Step({From(kAlpha, Shaped("alpha", 4, CubeBytes()))});
    daemon.Step(
        From(kAlpha, {parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(arrived)}));
    daemon.Step({}, 4.9);
    EXPECT_TRUE(daemon.rejections().empty());
    EXPECT_LE(daemon.bus().timeout_ns, kSecond / 2);
    daemon.Step({}, 0.2);
    daemon.Step({}, 10);
    if (arrived == parts.size()) {
      EXPECT_TRUE(daemon.rejections().empty());
      continue;
    }
    ASSERT_EQ(daemon.rejections().size(), 1u);
    const v1::Rejection rejection = daemon.rejections()[0];
    EXPECT_EQ(rejection.reason(), v1::REJECTED_BAD_SHAPE);
    EXPECT_EQ(rejection.slot(), 4u);
    EXPECT_NE(rejection.detail().find(arrived == 0 ? "no part" : "2 of 3 parts have arrived"),
              std::string::npos)
        << rejection.detail();
    daemon.Step(From(kAlpha, parts));
    EXPECT_EQ(daemon.counter("shapes"), 1u);
  }
}

}  // namespace
}  // namespace collision::server
