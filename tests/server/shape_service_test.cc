// Goal:   shapes in the whole service: agents are their balls until the shape is there, then their
//         shapes; every order of arrival, restarts of either side and disposal lead to the same;
//         what is refused is told to its sender; a replay gives the same events, bit for bit.
// Method: daemons on scripted buses. Two unit cubes at rest 2.3 m apart: their balls (radius 2)
//         overlap, they do not; at 1.9 m they do too.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <map>
#include <set>

#include "server/recording.h"
#include "server/replay.h"
#include "server/threaded_shape_builder.h"
#include "tests/server/scripted_bus.h"
#include "tests/server/shapes.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint64_t kAlpha = 10, kBeta = 20;  // senders

v1::Config Simulated() {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::SIMULATED);
  return config;
}

const std::string& CubeBytes() {
  static const std::string bytes = EncodeShape(Cube(1, UnusedFor(2)));
  return bytes;
}

/// Two agents at rest with no acceleration, `gap` m apart, both with the cube; told anew at each
/// clock.
class TwoCubes {
 public:
  explicit TwoCubes(double distance, std::string bytes = CubeBytes())
      : distance_(distance), bytes_(std::move(bytes)) {}

  std::vector<v1::Input> Descriptions() const {
    std::vector<v1::Input> inputs;
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      v1::AgentDescription wire = Shaped("alpha", slot, bytes_);
      wire.set_acceleration_max_m_s2(0);
      wire.set_angular_acceleration_max_rad_s2(0);
      inputs.push_back(From(kAlpha, wire));
    }
    return inputs;
  }

  std::vector<v1::Input> Parts() const { return From(kAlpha, PartsOf("alpha", bytes_)); }

  /// States and clock of now, then a tenth of a second later.
  std::vector<v1::Input> Tick() {
    v1::AgentStates chunk = Chunk("alpha");
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      v1::AgentState state = State(slot, clock_ns_, ++sequence_);
      state.mutable_position_m()->set_x(distance_ * slot);
      *chunk.add_states() = state;
    }
    std::vector<v1::Input> inputs = {From(kAlpha, chunk),
                                     From(kAlpha, ClockAfter("alpha", clock_ns_, sequence_, 2))};
    clock_ns_ += kSecond / 60;
    return inputs;
  }

 private:
  const double distance_;
  const std::string bytes_;
  std::int64_t clock_ns_ = 0;
  std::uint64_t sequence_ = 0;
};

/// The newest revision of the only event; POSSIBLE with revision 0 if there is none.
v1::CollisionEvent LastEvent(ScriptedDaemon& daemon) {
  v1::CollisionEvent last;
  for (const v1::Output& output : daemon.bus().outputs) {
    if (output.has_collision_event()) last = output.collision_event();
  }
  return last;
}

void Fly(ScriptedDaemon* daemon, TwoCubes* cubes, int ticks) {
  for (int i = 0; i < ticks; ++i) daemon->Step(cubes->Tick(), 1.0 / 60);
}

// Goal:   while its shape has not arrived an agent is its ball: possible, never confirmed; as soon
//         as it has, contacts are judged by the shapes.
TEST(ShapeService, AShapeCountsFromWhenItIsThere) {
  for (const bool touching : {true, false}) {
    ScriptedDaemon daemon(Simulated());
    TwoCubes cubes(touching ? 1.9 : 2.3);
    daemon.Step(cubes.Descriptions());
    Fly(&daemon, &cubes, 10);
    EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_POSSIBLE);
    EXPECT_EQ(LastEvent(daemon).revision(), 1u);
    const std::vector<v1::Input> parts = cubes.Parts();
    daemon.Step({parts.begin(), parts.end() - 1});
    Fly(&daemon, &cubes, 10);
    EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_POSSIBLE);
    daemon.Step({parts.back()});
    EXPECT_EQ(daemon.bus().timeout_ns >= 0, true);
    Fly(&daemon, &cubes, 10);
    EXPECT_EQ(daemon.counter("shapes"), 1u);
    if (touching) {
      EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
      EXPECT_LE(LastEvent(daemon).separation_m().upper(), 0);
    } else {
      // What was settled before stays open: nobody knows whether they touched then.
      EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_UNDECIDED) << LastEvent(daemon).DebugString();
    }
    EXPECT_TRUE(daemon.rejections().empty());
    EXPECT_EQ(daemon.counter("breaches") + daemon.counter("widenings"), 0u);
  }
}

// Goal:   the step that makes the shape visible follows at once, without any input.
TEST(ShapeService, AFinishedTreeIsNotWaitedFor) {
  ScriptedDaemon daemon(Simulated());
  TwoCubes cubes(1.9);
  daemon.Step(cubes.Descriptions());
  daemon.Step(cubes.Parts());
  EXPECT_GT(daemon.bus().timeout_ns, 0);
  daemon.Step({});
  EXPECT_EQ(daemon.bus().timeout_ns, 0);
  EXPECT_EQ(daemon.counter("shapes"), 1u);
  daemon.Step({});
  EXPECT_GT(daemon.bus().timeout_ns, 0);
}

// Goal:   descriptions, parts, states and clocks in any order, in any batches, parts twice: the
//         cubes that touch are confirmed, those that do not are not.
TEST(ShapeService, AnyOrderOfArrivalLeadsToTheSame) {
  Random random(1);
  for (int round = 0; round < 40; ++round) {
    const bool touching = round % 2 == 0;
    ScriptedDaemon daemon(Simulated());
    TwoCubes cubes(touching ? 1.9 : 2.3);
    std::vector<v1::Input> all = cubes.Descriptions();
    for (const std::vector<v1::Input>& more : {cubes.Parts(), cubes.Parts(), cubes.Tick()}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random.Below(i)]);
    while (!all.empty()) {
      const std::size_t count = 1 + random.Below(all.size());
      daemon.Step({all.end() - static_cast<std::ptrdiff_t>(count), all.end()});
      all.resize(all.size() - count);
    }
    Fly(&daemon, &cubes, 15);
    const v1::EventStatus status = LastEvent(daemon).status();
    EXPECT_EQ(status == v1::EVENT_CONFIRMED, touching) << round << " " << status;
    EXPECT_TRUE(daemon.rejections().empty());
  }
}

/// Fills a recording in memory.
class MemorySink final : public BatchSink {
 public:
  bool Record(const v1::RecordedBatch& batch) override {
    batches.push_back(batch);
    return true;
  }
  std::vector<v1::RecordedBatch> batches;
};

/// Finishes only when told to.
class LateShapeBuilder final : public ShapeBuilder {
 public:
  explicit LateShapeBuilder(const bool* late) : late_(*late) {}
  void Start(const std::string& hash, std::string bytes) override { inline_.Start(hash, bytes); }
  bool has_finished() const override { return !late_ && inline_.has_finished(); }
  std::vector<std::string> TakeFinished() override {
    return late_ ? std::vector<std::string>() : inline_.TakeFinished();
  }
  BuiltShape Await(const std::string& hash) override { return inline_.Await(hash); }
  void Forget(const std::string& hash) override { inline_.Forget(hash); }
  ShapeBuilderCounters counters() const override { return inline_.counters(); }

 private:
  const bool& late_;
  InlineShapeBuilder inline_{1000};
};

// Goal:   when a tree is finished depends on the machine, and events depend on it; a replay uses it
//         from the recorded step on and gives the same event log.
// Method: two cubes that come to rest in each other, with the tree after 3, 40 or 90 steps; replayed
//         from a file.
TEST(ShapeService, AReplayUsesAShapeFromTheRecordedStepOn) {
  const std::string path = testing::TempDir() + "shape_service_test." + std::to_string(getpid());
  std::set<std::uint64_t> hashes;
  for (const int delay : {3, 40, 90}) {
    std::uint64_t hash = 0, count = 0;
    {
      const v1::Config config = CompleteConfig(Simulated());
      RecordingWriter writer(path, config);
      bool late = true;
      ScriptedDaemon daemon(config, &writer, std::make_unique<LateShapeBuilder>(&late));
      TwoCubes cubes(1.9);
      daemon.Step(cubes.Descriptions());
      daemon.Step(cubes.Parts());
      for (int i = 0; i < 100; ++i) {
        late = i < delay;
        daemon.Step(cubes.Tick(), 1.0 / 60);
      }
      hash = daemon.daemon().event_log().hash();
      count = daemon.daemon().event_log().count();
      EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
    }
    hashes.insert(hash);
    RecordingReader reader(path);
    ReplaySource source(reader);
    Daemon replayed(reader.config(), source, source, nullptr);
    while (replayed.Step()) {
    }
    EXPECT_EQ(reader.error(), "");
    EXPECT_EQ(replayed.event_log().hash(), hash);
    EXPECT_EQ(replayed.event_log().count(), count);
    EXPECT_GT(count, 1u);
  }
  EXPECT_EQ(hashes.size(), 3u) << "the step must matter, or the test shows nothing";
  std::remove(path.c_str());
}

// Goal:   with the tree built on a thread of its own the run is recorded so that its replay is the
//         same, whenever the thread was done; the bus is woken for it.
TEST(ShapeService, AReplayFollowsTheThread) {
  for (int round = 0; round < 5; ++round) {
    const std::string path = testing::TempDir() + "shape_service_test." + std::to_string(getpid());
    std::uint64_t hash = 0;
    {
      const v1::Config config = CompleteConfig(Simulated());
      RecordingWriter writer(path, config);
      std::atomic<bool> woken = false;
      ScriptedDaemon daemon(config, &writer,
                            std::make_unique<ThreadedShapeBuilder>(1000, [&] { woken = true; }));
      TwoCubes cubes(1.9);
      daemon.Step(cubes.Descriptions());
      daemon.Step(cubes.Parts());
      while (!woken) Fly(&daemon, &cubes, 1);
      Fly(&daemon, &cubes, 20);
      EXPECT_EQ(daemon.counter("shapes"), 1u);
      EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
      hash = daemon.daemon().event_log().hash();
    }
    RecordingReader reader(path);
    ReplaySource source(reader);
    Daemon replayed(reader.config(), source, source, nullptr);
    while (replayed.Step()) {
    }
    EXPECT_EQ(replayed.event_log().hash(), hash);
    std::remove(path.c_str());
  }
}

// Goal:   what is recorded says when a shape became visible: first in its batch, once.
TEST(ShapeService, RecordsThatAShapeIsReady) {
  MemorySink sink;
  ScriptedDaemon daemon(Simulated(), &sink);
  TwoCubes cubes(1.9);
  daemon.Step(cubes.Parts());
  daemon.Step(cubes.Tick());
  Fly(&daemon, &cubes, 3);
  int ready = 0;
  for (const v1::RecordedBatch& batch : sink.batches) {
    for (const v1::Input& input : batch.inputs()) ready += input.has_shape_ready();
  }
  EXPECT_EQ(ready, 1);
  ASSERT_GE(sink.batches[1].inputs_size(), 1);
  EXPECT_EQ(sink.batches[1].inputs(0).shape_ready().content_hash(), Sha256(CubeBytes()));
}

// Goal:   a service that starts anew has everything from what the writers still hold, whatever
//         comes first.
TEST(ShapeService, ARestartedServiceRecovers) {
  TwoCubes cubes(1.9);
  {
    ScriptedDaemon daemon(Simulated());
    daemon.Step(cubes.Parts());
    daemon.Step(cubes.Descriptions());
    Fly(&daemon, &cubes, 10);
    EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
  }
  ScriptedDaemon daemon(Simulated());
  daemon.Step(cubes.Descriptions());
  Fly(&daemon, &cubes, 5);
  EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_POSSIBLE);
  daemon.Step(cubes.Parts());
  Fly(&daemon, &cubes, 5);
  EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
  EXPECT_TRUE(daemon.rejections().empty());
}

// Goal:   a higher run of a simulator gives up what the one before wrote, and what it writes itself
//         stays, also if that comes before its description.
TEST(ShapeService, ANewRunOwnsWhatItWrites) {
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

// Goal:   the parts of a successor that comes before its predecessor's death is noticed are kept for
//         it, within the same limit as all others, and freed if it dies waiting.
TEST(ShapeService, ASuccessorsPartsWaitWithIt) {
  for (const bool dies : {false, true}) {
    v1::Config config = Simulated();
    config.set_shape_bytes_max(4 * kShapePartBytes);
    ScriptedDaemon daemon(config);
    daemon.Step(AlphaJoins(kAlpha));
    daemon.Step(From(kBeta, PartsOf("alpha", CubeBytes(), 2)));
    EXPECT_EQ(daemon.counter("shape_bytes"), CubeBytes().size());
    daemon.Step(From(kBeta, PartsOf("alpha", CubeBytes(), 2)));
    EXPECT_LE(daemon.counter("shape_bytes"), config.shape_bytes_max());
    daemon.Step({Liveliness(dies ? kBeta : kAlpha, "alpha", false)});
    EXPECT_EQ(daemon.counter("shapes"), dies ? 0u : 1u);
    EXPECT_EQ(daemon.counter("shape_bytes"), dies ? 0u : CubeBytes().size());
  }
}

// Goal:   a shape lives while an agent refers to it, also after its disposal and after those who
//         wrote it have left; it may be written again.
TEST(ShapeService, LivesAsLongAsItIsNeeded) {
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

// Goal:   nobody but their owner disposes of parts.
TEST(ShapeService, AStrangersDisposalIsRefused) {
  ScriptedDaemon daemon(Simulated());
  const std::vector<v1::ShapePart> parts = PartsOf("alpha", CubeBytes());
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
//         told, and both fly the true shape.
TEST(ShapeService, OneOfTwoLies) {
  ScriptedDaemon daemon(Simulated());
  std::vector<v1::ShapePart> lies = PartsOf("beta", CubeBytes());
  lies[0].mutable_bytes()->back() ^= 1;
  daemon.Step(From(kBeta, lies));
  ASSERT_EQ(daemon.rejections().size(), 1u);
  const v1::Rejection told = daemon.rejections()[0];
  EXPECT_EQ(told.reason(), v1::REJECTED_BAD_SHAPE);
  EXPECT_EQ(told.topic(), v1::TOPIC_SHAPE);
  EXPECT_EQ(told.simulator_id(), SimulatorId("beta"));
  EXPECT_EQ(told.field(), "content_hash");
  TwoCubes cubes(1.9);
  daemon.Step(cubes.Descriptions());
  daemon.Step(cubes.Parts());
  Fly(&daemon, &cubes, 10);
  EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
  EXPECT_EQ(daemon.counter("shapes"), 1u);
  EXPECT_EQ(daemon.counter("shapes_refused"), 1u);
  EXPECT_EQ(daemon.rejections().size(), 1u);
}

// Goal:   content that is no mesh is told to its sender by name, and its agents stay balls.
TEST(ShapeService, BadContentIsToldToItsSender) {
  ShapeContent content = Cube(1);
  content.triangles[4][0] = 99;
  const std::string bad = EncodeShape(content);
  ScriptedDaemon daemon(Simulated());
  TwoCubes cubes(1.9, bad);
  daemon.Step(cubes.Descriptions());
  daemon.Step(cubes.Parts());
  Fly(&daemon, &cubes, 10);
  ASSERT_EQ(daemon.rejections().size(), 1u);
  const v1::Rejection told = daemon.rejections()[0];
  EXPECT_EQ(told.reason(), v1::REJECTED_BAD_SHAPE);
  EXPECT_EQ(told.simulator_id(), SimulatorId("alpha"));
  EXPECT_EQ(told.run(), 1u);
  EXPECT_NE(told.detail().find("99"), std::string::npos) << told.detail();
  EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_POSSIBLE);
  EXPECT_EQ(daemon.counter("shapes"), 0u);
}

// Goal:   a shape that reaches out of its agent's ball is told once for each description, and never
//         confirmed; a description with room for it mends it. At the radius itself it fits.
TEST(ShapeService, AShapeMustFitIntoItsBall) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(From(kAlpha, PartsOf("alpha", CubeBytes())));
  daemon.Step({From(kAlpha, Shaped("alpha", 0, CubeBytes(), kCubeRadius))});
  daemon.Step({From(kAlpha, Shaped("alpha", 2, CubeBytes(), kCubeRadius * (1 - 0.9e-9)))});
  EXPECT_TRUE(daemon.rejections().empty());
  v1::AgentDescription small = Shaped("alpha", 1, CubeBytes(), kCubeRadius * (1 - 1.1e-9));
  daemon.Step({From(kAlpha, small)});
  daemon.Step({From(kAlpha, small)}, 10);
  ASSERT_EQ(daemon.rejections().size(), 1u);
  const v1::Rejection told = daemon.rejections()[0];
  EXPECT_EQ(told.reason(), v1::REJECTED_BAD_SHAPE);
  EXPECT_EQ(told.topic(), v1::TOPIC_AGENT_DESCRIPTION);
  EXPECT_EQ(told.field(), "radius_m");
  EXPECT_EQ(told.slot(), 1u);
  small.set_revision(2);
  small.set_radius_m(2);
  daemon.Step({From(kAlpha, small)});
  EXPECT_EQ(daemon.rejections().size(), 1u);
}

// Goal:   parts that do not come are told once, after undescribed_after_s, with how many are there.
TEST(ShapeService, TellsThatPartsAreMissing) {
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
    const v1::Rejection told = daemon.rejections()[0];
    EXPECT_EQ(told.reason(), v1::REJECTED_BAD_SHAPE);
    EXPECT_EQ(told.slot(), 4u);
    EXPECT_NE(told.detail().find(arrived == 0 ? "no part" : "2 of 3 parts have arrived"),
              std::string::npos)
        << told.detail();
    daemon.Step(From(kAlpha, parts));
    EXPECT_EQ(daemon.counter("shapes"), 1u);
  }
}

}  // namespace
}  // namespace collision::server
