#include "server/shapes/shape_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "server/shapes/threaded_shape_builder.h"
#include "tests/server/shapes/bell.h"
#include "tests/server/shapes/failing_tree_store.h"
#include "tests/server/shapes/shapes.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

/// A closed surface of some size, so that building it takes its time: a sphere of 2 n² rectangles.
ShapeContent Sphere(std::uint32_t n) {
  ShapeContent content;
  for (std::uint32_t i = 0; i <= n; ++i) {
    const double polar = 3.14159265358979 * i / n;
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const double angle = 3.14159265358979 * j / n;
      content.vertices.push_back(
          {std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const std::uint32_t a = i * 2 * n + j, b = i * 2 * n + (j + 1) % (2 * n);
      content.triangles.push_back({a, a + 2 * n, b});
      content.triangles.push_back({b, a + 2 * n, b + 2 * n});
    }
  }
  return content;
}

// Goal:   bytes become the mesh that they describe, degenerate triangles aside, and its tree.
TEST(BuildShape, BuildsWhatTheBytesDescribe) {
  ShapeContent content = Cube(1);
  content.triangles.push_back({0, 0, 1});
  content.triangles.push_back({0, 1, 1});
  const BuiltShape built = BuildShape("", EncodeShape(content), {.triangles_max = 14});
  ASSERT_TRUE(built.shape) << built.refusal;
  EXPECT_EQ(built.dropped, 2u);
  EXPECT_EQ(built.shape->mesh().triangles.size(), 12u);
  EXPECT_EQ(built.shape->mesh().vertices[1], Eigen::Vector3d(1, -1, -1));
  EXPECT_TRUE(built.shape->closed());
  EXPECT_GE(built.shape->facts().radius, kCubeRadius);
  EXPECT_LE(built.shape->facts().radius, kCubeRadius * (1 + 1e-12));
  EXPECT_GE(built.shape->tree().nodes.size(), 1u);
}

// Goal:   each content that cannot be a shape is refused with a sentence.
TEST(BuildShape, RefusesWhatIsNoShape) {
  const auto refusal = [](const ShapeContent& content, std::size_t triangles_max = 100) {
    const BuiltShape built = BuildShape("", EncodeShape(content), {.triangles_max = triangles_max});
    EXPECT_FALSE(built.shape);
    return built.refusal;
  };
  EXPECT_NE(refusal({}), "");
  EXPECT_NE(refusal(Cube(1), 11), "");
  EXPECT_NE(refusal(Cube(1e-7)), "");
  EXPECT_NE(refusal(Cube(1e8)), "");
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ShapeContent content = Cube(1);
    content.vertices[5][2] = bad;
    EXPECT_NE(refusal(content), "");
  }
  ShapeContent out_of_range = Cube(1);
  out_of_range.triangles[3][1] = 8;
  EXPECT_NE(refusal(out_of_range), "");
  ShapeContent flat = Cube(1);
  flat.triangles = {{0, 0, 1}, {2, 3, 3}};
  EXPECT_NE(refusal(flat).find("degenerate"), std::string::npos);
  const std::string whole = EncodeShape(Cube(1));
  for (const std::size_t length : {std::size_t{0}, std::size_t{15}, whole.size() - 1}) {
    EXPECT_NE(BuildShape("", whole.substr(0, length), {.triangles_max = 100}).refusal, "");
  }
  EXPECT_TRUE(BuildShape("", whole, {.triangles_max = 12}).shape);
}

// Goal:   any bytes at all give a shape or a sentence.
TEST(BuildShape, DamagedBytesAreNeverMoreThanRefused) {
  Random random(4);
  const std::string whole = EncodeShape(Cube(1));
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

TEST(InlineShapeBuilder, ReportsAtOnceAndBuildsWhenAwaited) {
  InlineShapeBuilder builder({.triangles_max = 100});
  EXPECT_FALSE(builder.has_finished());
  builder.Start("1", EncodeShape(Cube(1)), 1);
  builder.Start("2", EncodeShape(Cube(2)), 1);
  builder.Start("3", "nothing", 1);
  builder.Forget("1");
  EXPECT_TRUE(builder.has_finished());
  EXPECT_EQ(builder.TakeFinished(), (std::vector<ReadyTree>{{"2"}, {"3"}}));
  EXPECT_FALSE(builder.has_finished());
  EXPECT_EQ(builder.counters().building, 2u);
  EXPECT_TRUE(builder.Await({"2"}).shape);
  EXPECT_FALSE(builder.Await({"3"}).shape);
  EXPECT_EQ(builder.counters().building, 0u);
  EXPECT_THROW(builder.Await({"1"}), std::logic_error);
}

TEST(ThreadedShapeBuilder, RingsWhenSomethingIsFinished) {
  Bell bell;
  ThreadedShapeBuilder builder({.triangles_max = 10'000}, [&bell] { bell.Ring(); });
  for (int i = 1; i <= 3; ++i) {
    builder.Start(std::to_string(i), EncodeShape(Cube(i)), 1);
    bell.WaitFor(i);
    EXPECT_TRUE(builder.has_finished());
    EXPECT_EQ(builder.TakeFinished(), std::vector<ReadyTree>{{std::to_string(i)}});
    EXPECT_EQ(builder.counters().building, 0u);
    EXPECT_EQ(builder.Await({std::to_string(i)}).shape->mesh().vertices[7],
              Eigen::Vector3d(i, i, i));
  }
  builder.Start("bad", "nothing", 1);
  bell.WaitFor(4);
  EXPECT_FALSE(builder.Await({"bad"}).shape);
  EXPECT_FALSE(builder.has_finished());
  EXPECT_THROW(builder.Await({"bad"}), std::logic_error);
}

// Goal:   awaited before it is finished, it is waited for.
TEST(ThreadedShapeBuilder, AwaitWaits) {
  ThreadedShapeBuilder builder({.triangles_max = 10'000}, [] {});
  for (int i = 0; i < 3; ++i) {
    builder.Start(std::to_string(i), EncodeShape(Sphere(8 + i)), 1);
  }
  for (int i = 2; i >= 0; --i) EXPECT_TRUE(builder.Await({std::to_string(i)}).shape) << i;
  EXPECT_TRUE(builder.TakeFinished().empty());
}

// Goal:   what is forgotten is not reported, whether it waits, is being built or is finished; the
//         same hash may be started again at once, and is then reported once.
// Method: 300 shapes started and forgotten in a random order.
TEST(ThreadedShapeBuilder, ForgetsAtAnyMoment) {
  Random random(5);
  ThreadedShapeBuilder builder({.triangles_max = 10'000}, [] {});
  const std::string cube = EncodeShape(Cube(1)), sphere = EncodeShape(Sphere(6));
  std::vector<bool> started(5);
  for (int i = 0; i < 300; ++i) {
    const std::size_t which = random.Below(started.size());
    const std::string hash = std::to_string(which);
    if (started[which]) {
      if (random.Chance(0.3)) {
        EXPECT_TRUE(builder.Await({hash}).shape);
      } else {
        builder.Forget(hash);
      }
    } else {
      builder.Start(hash, random.Chance(0.5) ? cube : sphere, 1);
    }
    started[which] = !started[which];
    for (const ReadyTree& finished : builder.TakeFinished()) {
      EXPECT_TRUE(started[std::stoul(finished.hash)]) << finished.hash;
    }
  }
  for (std::size_t which = 0; which < started.size(); ++which) {
    if (started[which]) {
      EXPECT_TRUE(builder.Await({std::to_string(which)}).shape);
    }
  }
  EXPECT_EQ(builder.counters().building, 0u);
}

// Goal:   it ends at any moment, with work waiting, in hand or done, and rings no more afterwards.
TEST(ThreadedShapeBuilder, StartsAndStopsRepeatedly) {
  const std::string sphere = EncodeShape(Sphere(6));
  for (int i = 0; i < 50; ++i) {
    auto rings = std::make_unique<std::atomic<int>>(0);
    {
      ThreadedShapeBuilder builder({.triangles_max = 10'000}, [&rings] { ++*rings; });
      for (int n = 0; n < i % 5; ++n) builder.Start(std::to_string(n), sphere, 1);
      if (i % 5 > 0 && i % 3 == 1) builder.Await({"0"});
    }
    const int rung = *rings;
    EXPECT_LE(rung, i % 5);
    rings.reset();
  }
}

// Goal:   a small shape does not wait behind large ones, however many came before it.
// Method: the small one is finished first or second: only the one large shape that is being built
//         when it comes may be before it.
TEST(ThreadedShapeBuilder, SmallShapesDoNotWaitForLargeOnes) {
  Bell bell;
  ThreadedShapeBuilder builder({.triangles_max = 100'000}, [&bell] { bell.Ring(); });
  const std::string large = EncodeShape(Sphere(90));
  ASSERT_GT(large.size(), 500'000u);
  for (const char* hash : {"a", "b", "c", "d"}) builder.Start(hash, large, 1);
  builder.Start("small", EncodeShape(Cube(1)), 1);
  bell.WaitFor(2);
  const std::vector<ReadyTree> finished = builder.TakeFinished();
  EXPECT_NE(std::find(finished.begin(), finished.end(), ReadyTree{"small"}), finished.end());
  for (const char* hash : {"a", "b", "c", "d"}) builder.Forget(hash);
}

// Goal:   a check that fails on a worker reaches the daemon's thread, whichever function that calls
//         next, and wakes it.
TEST(ThreadedShapeBuilder, CarriesAFailedCheckToItsCaller) {
  const BuildOptions options{.triangles_max = 100, .cache = std::make_shared<FailingTreeStore>()};
  Bell bell;
  ThreadedShapeBuilder builder(options, [&bell] { bell.Ring(); });
  builder.Start("1", EncodeShape(Cube(1)), 1);
  bell.WaitFor(1);
  EXPECT_TRUE(builder.has_finished());
  EXPECT_THROW(builder.TakeFinished(), CheckFailure);
  EXPECT_THROW(builder.Await({"1"}), CheckFailure);

  ThreadedShapeBuilder awaited(options, [] {});
  awaited.Start("1", EncodeShape(Cube(1)), 1);
  EXPECT_THROW(awaited.Await({"1"}), CheckFailure);
}

// Goal:   both builders make the same of the same bytes, bit for bit.
TEST(ThreadedShapeBuilder, BuildsWhatTheInlineOneBuilds) {
  const std::string bytes = EncodeShape(Sphere(12));
  InlineShapeBuilder inline_builder({.triangles_max = 10'000});
  ThreadedShapeBuilder threaded({.triangles_max = 10'000}, [] {});
  inline_builder.Start("1", bytes, 1);
  threaded.Start("1", bytes, 1);
  const auto a = inline_builder.Await({"1"}).shape, b = threaded.Await({"1"}).shape;
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->tree().nodes.size(), b->tree().nodes.size());
  for (std::size_t i = 0; i < a->tree().nodes.size(); ++i) {
    const sphere_tree::SphereNode &x = a->tree().nodes[i], &y = b->tree().nodes[i];
    EXPECT_EQ(x.centre, y.centre);
    EXPECT_EQ(x.radius, y.radius);
    EXPECT_EQ(x.signed_distance, y.signed_distance);
  }
}

}  // namespace
}  // namespace collision::server
