// Goal:   no simulator alone takes the memory, the places or the threads of shapes that others
//         need.
// Method: a store with small limits; builders whose workers all stand still at a gate.
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <set>

#include "server/config/config.h"
#include "server/shapes/shape_store.h"
#include "server/shapes/threaded_shape_builder.h"
#include "tests/server/shapes/shapes.h"

namespace collision::server {
namespace {

const std::uint64_t kGreedy = SimulatorId("greedy"), kModest = SimulatorId("modest");

/// A store in a world of two simulators at most, each with a third of everything guaranteed.
struct TwoSimulators {
  explicit TwoSimulators(v1::Config limits) : config(CompleteConfig(ForTwo(std::move(limits)))) {
    quotas.Enter(kGreedy, "greedy");
    quotas.Enter(kModest, "modest");
  }

  static v1::Config ForTwo(v1::Config limits) {
    limits.set_simulators_max(2);
    return limits;
  }

  /// Writes a cube of this size; returns the field of the last refusal, or of what came of it.
  std::string Write(const std::string& simulator, double half, std::size_t parts = 0) {
    const std::string bytes = EncodeShape(Cube(half, UnusedFor(parts)));
    std::string field;
    for (const v1::ShapePart& part : PartsOf(simulator, bytes)) {
      if (const auto refusal = store.Take(part)) field = refusal->field;
    }
    if (!field.empty()) return field;
    const auto ready = store.MakeVisible({Sha256(bytes)});
    return ready ? ready->built.refusal.substr(0, 11) : "";
  }

  v1::Config config;
  SimulatorQuotas quotas{config};
  InlineShapeBuilder builder{BuildOptions{.triangles_max = 1000}};
  ShapeStore store{config, &builder, &quotas};
};

TEST(ShapeQuotas, PlacesAreKeptForOthers) {
  v1::Config limits;
  limits.set_shapes_max(3);
  TwoSimulators world(limits);
  EXPECT_EQ(world.Write("greedy", 1), "");
  EXPECT_EQ(world.Write("greedy", 2), "");
  EXPECT_EQ(world.Write("greedy", 3), "content_hash");
  EXPECT_EQ(world.Write("modest", 4), "");
  EXPECT_EQ(world.Write("modest", 5), "content_hash") << "all are taken";
  world.store.Release(kModest);
  world.quotas.Keep([](std::uint64_t id) { return id == kGreedy; });
  EXPECT_EQ(world.Write("greedy", 3), "") << "it is alone";
}

TEST(ShapeQuotas, BytesAreKeptForOthers) {
  v1::Config limits;
  limits.set_shape_bytes_max(10 * wire::kShapePartBytes + 2000);
  limits.set_shape_triangles_max(100'000);
  TwoSimulators world(limits);
  EXPECT_EQ(world.Write("greedy", 1, 4), "");
  EXPECT_EQ(world.Write("greedy", 2, 4), "bytes");
  EXPECT_EQ(world.Write("modest", 3, 4), "");
  EXPECT_EQ(world.Write("modest", 3, 4), "") << "it is there already";
}

// Goal:   trees count: one that does not fit is refused, and its memory is free again.
TEST(ShapeQuotas, TreesAreKeptForOthers) {
  TwoSimulators world(v1::Config{});
  ASSERT_EQ(world.Write("greedy", 1), "");
  const std::uint64_t one = world.store.counters().tree_bytes;
  ASSERT_GT(one, 0u);
  ASSERT_EQ(world.quotas.Used(kGreedy, Resource::kTreeBytes), one);

  v1::Config limits;
  limits.set_tree_bytes_max(2 * one);
  TwoSimulators small(limits);
  EXPECT_EQ(small.Write("greedy", 1), "");
  EXPECT_EQ(small.Write("greedy", 2), "no room for");
  EXPECT_EQ(small.store.counters().tree_bytes, one);
  EXPECT_EQ(small.quotas.Used(kGreedy, Resource::kShapes), 1u);
  EXPECT_EQ(small.Write("modest", 3), "");
  EXPECT_EQ(small.Write("modest", 1), "") << "the greedy one has built it";
  small.store.Release(kGreedy);
  EXPECT_EQ(small.quotas.Used(kGreedy, Resource::kTreeBytes), 0u);
  EXPECT_EQ(small.quotas.Used(kModest, Resource::kTreeBytes), 2 * one);
  small.store.Release(kModest);
  EXPECT_EQ(small.quotas.Used(kModest, Resource::kTreeBytes), 0u);
  EXPECT_EQ(small.store.counters().bytes, 0u);
}

/// Holds each worker that asks for a tree until it is opened.
class Gate final : public TreeStore {
 public:
  std::optional<sphere_tree::SphereTree> Load(const std::string& hash,
                                              const geometry::TriangleMesh&) override {
    std::unique_lock lock(mutex_);
    asked_.push_back(hash);
    const std::size_t turn = asked_.size();
    changed_.notify_all();
    changed_.wait(lock, [&] { return turn <= opened_; });
    return std::nullopt;
  }
  void Store(const std::string&, const sphere_tree::SphereTree&) override {}
  TreeCacheCounters counters() const override { return {}; }

  /// Lets so many workers in all go on; returns what the next three ask for.
  std::set<std::string> Open(std::size_t opened) {
    std::unique_lock lock(mutex_);
    opened_ = opened;
    changed_.notify_all();
    changed_.wait(lock, [&] { return asked_.size() == opened + 3; });
    return {asked_.end() - 3, asked_.end()};
  }
  void OpenForAll() {
    const std::lock_guard lock(mutex_);
    opened_ = 1000;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> asked_;  // each time
  std::size_t opened_ = 0;
};

// Goal:   however many shapes one simulator has written before, the next worker that is free builds
//         one of another simulator.
TEST(ShapeQuotas, SimulatorsTakeTurnsAtTheThreads) {
  const auto gate = std::make_shared<Gate>();
  ThreadedShapeBuilder builder({.triangles_max = 1000, .cache = gate}, [] {});
  const std::string bytes = EncodeShape(Cube(1));
  for (const char* hash : {"1", "2", "3"}) builder.Start(hash, bytes, kGreedy);
  EXPECT_EQ(gate->Open(0), (std::set<std::string>{"1", "2", "3"})) << "all workers are busy";
  for (const char* hash : {"4", "5", "6", "7"}) builder.Start(hash, bytes, kGreedy);
  builder.Start("modest", bytes, kModest);
  EXPECT_EQ(gate->Open(3).count("modest"), 1u);
  gate->OpenForAll();
  for (const char* hash : {"4", "7", "modest"}) EXPECT_TRUE(builder.Await({hash}).shape);
}

}  // namespace
}  // namespace collision::server
