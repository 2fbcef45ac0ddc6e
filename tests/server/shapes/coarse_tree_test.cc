// Goal:   a large surface is of use with a coarse tree before its wanted one is built; the second
//         takes the first one's place unnoticed: no event becomes less certain, no promise is
//         withdrawn, nothing is left behind by a shape that is not needed any more; a replay gives
//         the same events, whichever trees the run used and when.
// Method: cubes of 4,332 triangles, and of 12 that are the same body; a builder that finishes when
//         told to.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <set>

#include "server/recording/recording.h"
#include "server/shapes/threaded_shape_builder.h"
#include "server/shapes/tree_cache.h"
#include "tests/server/shapes/bell.h"
#include "tests/server/shapes/two_cubes.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

constexpr std::uint32_t kLarge =
    19;  // cells along an edge: more triangles than kCoarseFirstTriangles
constexpr std::uint32_t kNotLarge = 18;
static_assert(12 * kLarge * kLarge > kCoarseFirstTriangles);
static_assert(12 * kNotLarge * kNotLarge <= kCoarseFirstTriangles);

/// As the daemon's, so that a replay, which knows the configuration only, builds the same.
const BuildOptions& Options() {
  static const BuildOptions options = BuildOptionsOf(CompleteConfig(Simulated()));
  return options;
}

const std::string& LargeBytes() {
  static const std::string bytes = EncodeShape(FineCube(kLarge));
  return bytes;
}

bool SameBits(const sphere_tree::SphereTree& a, const sphere_tree::SphereTree& b) {
  const auto same = [](const sphere_tree::SphereNode& x, const sphere_tree::SphereNode& y) {
    return x.centre == y.centre && x.radius == y.radius && x.signed_distance == y.signed_distance &&
           x.first_child == y.first_child && x.first_element == y.first_element;
  };
  return a.elements == b.elements &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same);
}

// Goal:   what follows the coarse tree is what would have been built at once, as a twin; small
//         surfaces have no coarse tree, and where it is the wanted one nothing follows.
TEST(CoarseTree, TheWantedOneFollows) {
  for (const bool with_solid : {false, true}) {
    ShapeContent content = FineCube(kLarge);
    if (with_solid) content.solids.push_back({.kind = SolidKind::kBall, .rounding = 1.5});
    const std::string bytes = EncodeShape(content);
    const BuiltShape coarse = BuildFirst("", bytes, Options());
    const BuiltShape whole = BuildShape("", bytes, Options());
    ASSERT_TRUE(coarse.shape && whole.shape);
    EXPECT_TRUE(coarse.coarse);
    EXPECT_FALSE(whole.coarse);
    EXPECT_FALSE(SameBits(coarse.shape->tree(), whole.shape->tree()));
    const BuiltShape refined = Refine("", *coarse.shape, Options());
    EXPECT_FALSE(refined.coarse);
    EXPECT_TRUE(SameBits(refined.shape->tree(), whole.shape->tree()));
    EXPECT_TRUE(refined.shape->IsSameBodyAs(*coarse.shape));
    EXPECT_FALSE(whole.shape->IsSameBodyAs(*coarse.shape));
    EXPECT_EQ(refined.shape->facts().radius, coarse.shape->facts().radius);
    EXPECT_EQ(refined.shape->solids().size(), content.solids.size());
  }
  EXPECT_FALSE(BuildFirst("", EncodeShape(FineCube(kNotLarge)), Options()).coarse);
  EXPECT_NE(BuildFirst("", "nothing", Options()).refusal, "");
  v1::Config config;
  config.set_tree_builder(v1::Config::MEDIAN_SPLIT);
  const BuildOptions quick = BuildOptionsOf(CompleteConfig(config));
  const std::string large = EncodeShape(FineCube(kLarge));
  const BuiltShape only = BuildFirst("", large, quick);
  EXPECT_FALSE(only.coarse);
  EXPECT_TRUE(SameBits(only.shape->tree(), BuildFirst("", large, Options()).shape->tree()));
}

// Goal:   the threads hand out the coarse tree and then the other; a late caller gets the better
//         one.
TEST(CoarseTree, ThreadsHandOutBoth) {
  Bell bell;
  ThreadedShapeBuilder builder(Options(), [&bell] { bell.Ring(); });
  builder.Start("a", LargeBytes(), 1);
  bell.WaitFor(1);
  const std::vector<ReadyTree> first = builder.TakeFinished();
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(first[0].hash, "a");
  if (first[0].coarse) {
    EXPECT_TRUE(builder.Await(first[0]).coarse);
    bell.WaitFor(2);
    EXPECT_EQ(builder.TakeFinished(), std::vector<ReadyTree>{{"a"}});
  }
  EXPECT_EQ(builder.counters().building, 0u);
  EXPECT_FALSE(builder.Await({"a"}).coarse);
  EXPECT_THROW(builder.Await({"a"}), std::logic_error);
  builder.Start("b", LargeBytes(), 1);
  bell.WaitFor(4);
  EXPECT_EQ(builder.TakeFinished(), std::vector<ReadyTree>{{"b"}});
  // Reported once, it is kept until it is handed out, though the other one is there by then.
  builder.Start("c", LargeBytes(), 1);
  bell.WaitFor(5);
  const std::vector<ReadyTree> reported = builder.TakeFinished();
  bell.WaitFor(6);
  ASSERT_EQ(reported.size(), 1u);
  EXPECT_EQ(builder.Await(reported[0]).coarse, reported[0].coarse);
}

// Goal:   a shape that waits to be refined holds up no first tree.
// Method: of four large ones all first trees are there when the fifth tree is.
TEST(CoarseTree, FirstTreesComeBeforeRefinements) {
  Bell bell;
  ThreadedShapeBuilder builder(Options(), [&bell] { bell.Ring(); });
  const std::string larger = EncodeShape(FineCube(60));
  const std::set<std::string> hashes = {"a", "b", "c", "d"};
  for (const std::string& hash : hashes) builder.Start(hash, larger, 1);
  bell.WaitFor(5);
  std::set<std::string> seen;
  for (const ReadyTree& tree : builder.TakeFinished()) seen.insert(tree.hash);
  EXPECT_EQ(seen, hashes);
  for (const std::string& hash : hashes) builder.Forget(hash);
  EXPECT_EQ(builder.counters().building, 0u);
}

// Goal:   forgotten at any moment, between the two trees as well, it does not appear again; the
//         builder ends at any moment.
TEST(CoarseTree, AForgottenShapeDoesNotReappear) {
  Random random(6);
  for (int round = 0; round < 12; ++round) {
    Bell bell;
    ThreadedShapeBuilder builder(Options(), [&bell] { bell.Ring(); });
    builder.Start("a", LargeBytes(), 1);
    bell.WaitFor(1);
    const std::vector<ReadyTree> first = builder.TakeFinished();
    if (random.Chance(0.5)) builder.Await(first[0]);
    if (random.Chance(0.3)) continue;
    if (first[0].coarse) {
      builder.Forget("a");
      EXPECT_TRUE(builder.TakeFinished().empty());
    }
    builder.Start("a", LargeBytes(), 1);
    EXPECT_EQ(builder.counters().building, 1u);
    EXPECT_TRUE(builder.Await({"a"}).shape);
    EXPECT_EQ(builder.counters().building, 0u);
    EXPECT_TRUE(builder.TakeFinished().empty());
  }
}

// Goal:   a tree from the cache is the wanted one at once, and a refined one is kept for the next
//         time.
TEST(CoarseTree, CachedTreesSkipIt) {
  const std::string folder = testing::TempDir() + "coarse_tree_test." + std::to_string(getpid());
  BuildOptions options = Options();
  options.cache = std::make_shared<TreeCache>(folder, 1'000'000'000, options.tree);
  const std::string hash = Sha256(LargeBytes());
  const BuiltShape coarse = BuildFirst(hash, LargeBytes(), options);
  EXPECT_TRUE(coarse.coarse);
  EXPECT_EQ(options.cache->counters().stored, 0u);
  const BuiltShape refined = Refine(hash, *coarse.shape, options);
  EXPECT_EQ(options.cache->counters().stored, 1u);
  const BuiltShape cached = BuildFirst(hash, LargeBytes(), options);
  EXPECT_TRUE(cached.from_cache);
  EXPECT_FALSE(cached.coarse);
  EXPECT_TRUE(SameBits(cached.shape->tree(), refined.shape->tree()));
  std::filesystem::remove_all(folder);
}

/// Builds on the daemon's thread; says that trees are finished when the test says so.
class StagedShapeBuilder final : public ShapeBuilder {
 public:
  explicit StagedShapeBuilder(std::vector<ReadyTree>* finished) : finished_(*finished) {}
  void Start(const std::string& hash, std::string bytes, std::uint64_t simulator) override {
    inline_.Start(hash, bytes, simulator);
  }
  bool has_finished() const override { return !finished_.empty(); }
  std::vector<ReadyTree> TakeFinished() override { return std::exchange(finished_, {}); }
  BuiltShape Await(const ReadyTree& tree) override { return inline_.Await(tree); }
  void Forget(const std::string& hash) override {
    ++forgotten;
    inline_.Forget(hash);
  }
  ShapeBuilderCounters counters() const override { return inline_.counters(); }

  int forgotten = 0;

 private:
  std::vector<ReadyTree>& finished_;
  InlineShapeBuilder inline_{Options()};
};

constexpr int kNever = -1;

/// A run of two large cubes. Each tree becomes visible at a tick, at 0 before the first states.
class StagedRun {
 public:
  StagedRun(double distance, int coarse_at, int whole_at, BatchSink* recorder = nullptr)
      : pair_(distance, LargeBytes()),
        daemon_(Simulated(), recorder, std::make_unique<StagedShapeBuilder>(&finished_)) {
    daemon_.Step(pair_.Descriptions());
    daemon_.Step(pair_.Parts());
    const std::string hash = Sha256(LargeBytes());
    for (int tick = 0; tick <= 40; ++tick) {
      if (tick == coarse_at) finished_.push_back({hash, true});
      if (tick == whole_at) finished_.push_back({hash});
      daemon_.Step(tick == 0 ? std::vector<v1::Input>() : pair_.Tick(), 1.0 / 60);
      if (LastEvent(daemon_).revision() > 0) statuses_.push_back(LastEvent(daemon_).status());
    }
  }

  ScriptedDaemon& daemon() { return daemon_; }

  /// After each tick, from the first event on.
  const std::vector<v1::EventStatus>& statuses() const { return statuses_; }

 private:
  std::vector<v1::EventStatus> statuses_;
  std::vector<ReadyTree> finished_;
  TwoCubes pair_;
  ScriptedDaemon daemon_;
};

// Goal:   with the coarse tree contacts are confirmed and freedom is certified; the other tree
//         changes neither, nor does it count as anything that happened to the agents.
TEST(CoarseTree, TheSecondTreeComesUnnoticed) {
  for (const bool touching : {true, false}) {
    SCOPED_TRACE(touching);
    StagedRun run(touching ? 1.9 : 2.3, 0, 20);
    ScriptedDaemon& daemon = run.daemon();
    EXPECT_EQ(daemon.counter("widenings") + daemon.counter("breaches"), 0u);
    EXPECT_EQ(daemon.counter("discontinuities"), 0u);
    EXPECT_EQ(daemon.counter("shapes"), 1u);
    EXPECT_EQ(daemon.counter("trees_coarse"), 0u);
    EXPECT_EQ(daemon.counter("trees_building"), 0u);
    EXPECT_TRUE(daemon.rejections().empty());
    const v1::CollisionEvent last = LastEvent(daemon);
    if (touching) {
      // Long before the second tree, and for good.
      EXPECT_EQ(run.statuses().size(), 40u);
      for (std::size_t i = 3; i < run.statuses().size(); ++i) {
        EXPECT_EQ(run.statuses()[i], v1::EVENT_CONFIRMED) << i;
      }
      EXPECT_LE(last.proximity().separation_m().upper(), 0);
    } else {
      EXPECT_TRUE(run.statuses().empty()) << last.DebugString();
    }
    const auto shape = BuildShape("", LargeBytes(), Options()).shape;
    EXPECT_EQ(daemon.counter("tree_nodes"), shape->tree().nodes.size());
  }
}

// Goal:   clearances are not lowered when the second tree comes.
TEST(CoarseTree, NoPromiseIsWithdrawn) {
  StagedRun run(2.3, 0, 20);
  std::int64_t clear_until = 0;
  for (const v1::Output& output : run.daemon().bus().outputs) {
    for (const v1::AgentClearance& agent : output.clearance().agents()) {
      EXPECT_TRUE(agent.cause() == v1::CAUSE_NONE || agent.cause() == v1::CAUSE_ADMISSION);
      if (agent.slot() != 0 || agent.clear_until_ns() == INT64_MAX) continue;
      EXPECT_GE(agent.clear_until_ns(), clear_until);
      clear_until = agent.clear_until_ns();
    }
  }
  EXPECT_GT(clear_until, kSecond);
}

// Goal:   a replay repeats the run bit for bit, whether it used the coarse tree, the other, or
//         both, and at whichever steps.
TEST(CoarseTree, AReplayUsesTheSameTrees) {
  const std::string path = testing::TempDir() + "coarse_tree_test." + std::to_string(getpid());
  const int stages[][2] = {{3, kNever}, {kNever, 3}, {0, 1}, {3, 3}, {3, 25}, {12, 25}};
  for (const auto& [coarse_at, whole_at] : stages) {
    SCOPED_TRACE(std::to_string(coarse_at) + ", " + std::to_string(whole_at));
    std::uint64_t hash = 0, count = 0;
    {
      const v1::Config config = CompleteConfig(Simulated());
      RecordingWriter writer(path, config);
      StagedRun run(1.9, coarse_at, whole_at, &writer);
      hash = run.daemon().daemon().event_log().hash();
      count = run.daemon().daemon().event_log().count();
      EXPECT_EQ(LastEvent(run.daemon()).status(), v1::EVENT_CONFIRMED);
    }
    ExpectSameReplay(path, hash, count);
    EXPECT_GT(count, 1u);
  }
  std::remove(path.c_str());
}

// Goal:   the same with threads, which finish when they like.
TEST(CoarseTree, AReplayFollowsTheThreads) {
  const std::string path = testing::TempDir() + "coarse_tree_test." + std::to_string(getpid());
  std::uint64_t hash = 0, count = 0;
  {
    const v1::Config config = CompleteConfig(Simulated());
    RecordingWriter writer(path, config);
    std::atomic<int> woken = 0;
    ScriptedDaemon daemon(config, &writer,
                          std::make_unique<ThreadedShapeBuilder>(Options(), [&] { ++woken; }));
    TwoCubes pair(1.9, LargeBytes());
    daemon.Step(pair.Descriptions());
    daemon.Step(pair.Parts());
    while (woken < 2) Fly(&daemon, &pair, 1);
    Fly(&daemon, &pair, 20);
    EXPECT_EQ(daemon.counter("trees_coarse"), 0u);
    EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
    hash = daemon.daemon().event_log().hash();
    count = daemon.daemon().event_log().count();
  }
  ExpectSameReplay(path, hash, count);
  std::remove(path.c_str());
}

// Goal:   a shape that goes while its wanted tree is being built leaves nothing behind, and may
//         come again; a tree that is ready afterwards is dropped.
TEST(CoarseTree, AShapeThatGoesBetweenItsTreesLeavesNothing) {
  std::vector<ReadyTree> finished;
  auto owned = std::make_unique<StagedShapeBuilder>(&finished);
  StagedShapeBuilder& builder = *owned;
  ScriptedDaemon daemon(Simulated(), nullptr, std::move(owned));
  const std::vector<v1::ShapePart> parts = PartsOf("alpha", LargeBytes());
  const std::string hash = Sha256(LargeBytes());
  for (int times = 1; times <= 2; ++times) {
    v1::AgentDescription agent = Shaped("alpha", 0, LargeBytes());
    agent.set_generation(times);
    daemon.Step({From(kAlpha, agent)});
    daemon.Step(From(kAlpha, parts));
    finished.push_back({hash, true});
    daemon.Step({});
    EXPECT_EQ(daemon.counter("shapes"), 1u);
    EXPECT_EQ(daemon.counter("trees_coarse"), 1u);
    EXPECT_EQ(daemon.counter("trees_building"), 1u);
    daemon.Step(RemovalsOf(kAlpha, parts));
    EXPECT_EQ(daemon.counter("shapes"), 1u);
    daemon.Step({Removal(kAlpha, "alpha", 0)});
    EXPECT_EQ(builder.forgotten, times);
    finished.push_back({hash});
    daemon.Step({});
    for (const char* counter :
         {"shapes", "trees_coarse", "trees_building", "tree_nodes", "tree_bytes", "shape_bytes"}) {
      EXPECT_EQ(daemon.counter(counter), 0u) << counter;
    }
  }
  EXPECT_TRUE(daemon.rejections().empty());
}

// Goal:   an agent whose ball is too small for the shape is reported once, not with each tree.
TEST(CoarseTree, WhatDoesNotFitIsReportedOnce) {
  std::vector<ReadyTree> finished;
  ScriptedDaemon daemon(Simulated(), nullptr, std::make_unique<StagedShapeBuilder>(&finished));
  daemon.Step({From(kAlpha, Shaped("alpha", 0, LargeBytes(), 1)),
               From(kAlpha, Shaped("alpha", 1, LargeBytes(), 2))});
  daemon.Step(From(kAlpha, PartsOf("alpha", LargeBytes())));
  for (const bool coarse : {true, false}) {
    finished.push_back({Sha256(LargeBytes()), coarse});
    daemon.Step({}, 10);
    ASSERT_EQ(daemon.rejections().size(), 1u);
    EXPECT_EQ(daemon.rejections()[0].field(), "radius_m");
  }
}

}  // namespace
}  // namespace collision::server
