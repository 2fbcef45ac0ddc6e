// Goal:   shapes in the whole service: agents are their balls until the shape is there, then their
//         shapes; every order of arrival and a restart of the service lead to the same; a replay
//         gives the same events, bit for bit.
// Method: daemons on scripted buses. Two unit cubes at rest 2.3 m apart: their balls (radius 2)
//         overlap, they do not; at 1.9 m they do too.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <set>

#include "server/recording/recording.h"
#include "server/shapes/threaded_shape_builder.h"
#include "tests/server/shapes/two_cubes.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

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
      EXPECT_LE(LastEvent(daemon).proximity().separation_m().upper(), 0);
    } else {
      // What was settled before stays open: whether they touched then is unknown.
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
  std::string error() const override { return {}; }
  std::vector<v1::RecordedBatch> batches;
};

/// Finishes only on request.
class LateShapeBuilder final : public ShapeBuilder {
 public:
  explicit LateShapeBuilder(const bool* late) : late_(*late) {}
  void Start(const std::string& hash, std::string bytes, std::uint64_t simulator) override {
    inline_.Start(hash, bytes, simulator);
  }
  bool has_finished() const override { return !late_ && inline_.has_finished(); }
  std::vector<ReadyTree> TakeFinished() override {
    return late_ ? std::vector<ReadyTree>() : inline_.TakeFinished();
  }
  BuiltShape Await(const ReadyTree& tree) override { return inline_.Await(tree); }
  void Forget(const std::string& hash) override { inline_.Forget(hash); }
  ShapeBuilderCounters counters() const override { return inline_.counters(); }

 private:
  const bool& late_;
  InlineShapeBuilder inline_{BuildOptionsOf(CompleteConfig(Simulated()))};
};

// Goal:   when a tree is finished depends on the machine, and events depend on it; a replay uses it
//         from the recorded step on and gives the same event log.
// Method: two cubes that come to rest in each other, with the tree after 3, 40 or 90 steps;
//         replayed from a file.
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
    ExpectSameReplay(path, hash, count);
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
    std::uint64_t hash = 0, count = 0;
    {
      const v1::Config config = CompleteConfig(Simulated());
      RecordingWriter writer(path, config);
      std::atomic<bool> woken = false;
      ScriptedDaemon daemon(
          config, &writer,
          std::make_unique<ThreadedShapeBuilder>(BuildOptionsOf(config), [&] { woken = true; }));
      TwoCubes cubes(1.9);
      daemon.Step(cubes.Descriptions());
      daemon.Step(cubes.Parts());
      while (!woken) Fly(&daemon, &cubes, 1);
      Fly(&daemon, &cubes, 20);
      EXPECT_EQ(daemon.counter("shapes"), 1u);
      EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
      hash = daemon.daemon().event_log().hash();
      count = daemon.daemon().event_log().count();
    }
    ExpectSameReplay(path, hash, count);
    std::remove(path.c_str());
  }
}

// Goal:   what is recorded says when a shape became visible: first in its batch, once.
TEST(ShapeService, RecordsThatAShapeIsReady) {
  MemorySink sink;
  ScriptedDaemon daemon(Simulated(), &sink);
  TwoCubes cubes(1.9);
  std::vector<v1::Input> first = cubes.Descriptions();
  for (const v1::Input& part : cubes.Parts()) first.push_back(part);
  daemon.Step(first);
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

}  // namespace
}  // namespace collision::server
