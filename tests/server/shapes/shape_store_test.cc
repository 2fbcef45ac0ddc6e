// Goal:   whatever the order and the repetitions, a shape is whole when all its parts have come
//         with the right hash, and only then; it belongs to those that wrote it, lives as long as
//         it is needed, and the mistakes of one simulator cost no other one anything. Limits hold.
// Method: the store on the inline builder; parts shuffled, missing, changed, disposed of.
#include "server/shapes/shape_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "server/config/config.h"
#include "tests/server/shapes/shapes.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

const std::uint64_t kA = SimulatorId("a"), kB = SimulatorId("b");

class ShapeStoreTest : public testing::Test {
 protected:
  /// The refusal's field; "" if it was taken.
  static std::string FieldOf(const std::optional<Refusal>& refusal) {
    if (!refusal) return "";
    EXPECT_EQ(refusal->reason, v1::REJECTED_BAD_SHAPE);
    EXPECT_EQ(refusal->topic, v1::TOPIC_SHAPE);
    EXPECT_FALSE(refusal->detail.empty());
    EXPECT_LE(refusal->detail.size(), 256u);
    return refusal->field;
  }

  std::vector<std::string> TakeAll(const std::vector<v1::ShapePart>& sent) {
    std::vector<std::string> refused;
    for (const v1::ShapePart& part : sent) {
      const std::string field = FieldOf(store.Take(part));
      if (!field.empty()) refused.push_back(field);
    }
    return refused;
  }

  bool Ready(const std::string& shape) { return store.MakeVisible({shape}).has_value(); }

  v1::Config config = CompleteConfig({});
  InlineShapeBuilder builder{BuildOptions{.triangles_max = 1000}};
  SimulatorQuotas quotas{config};
  ShapeStore store{config, &builder, &quotas};
  const std::string bytes = EncodeShape(Cube(1, UnusedFor(4)));
  const std::string hash = Sha256(bytes);
  const std::vector<v1::ShapePart> parts = PartsOf("a", bytes);
};

using None = std::vector<std::string>;

TEST_F(ShapeStoreTest, AnyOrderWithRepetitionsMakesTheShape) {
  Random random(1);
  for (int round = 0; round < 30; ++round) {
    ShapeStore fresh(config, &builder, &quotas);
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.Below(i)]);
    std::vector<bool> came(parts.size());
    for (const std::size_t i : order) {
      EXPECT_FALSE(fresh.ProgressOf(kA, hash).whole);
      EXPECT_EQ(fresh.ProgressOf(kA, hash).arrived,
                static_cast<std::uint64_t>(std::count(came.begin(), came.end(), true)));
      ASSERT_FALSE(fresh.Take(parts[i]));
      came[i] = true;
      const std::size_t again = random.Below(parts.size());
      if (came[again]) {
        ASSERT_FALSE(fresh.Take(parts[again]));
      }
    }
    EXPECT_TRUE(fresh.ProgressOf(kA, hash).whole);
    EXPECT_FALSE(fresh.Find(hash));
    const auto ready = fresh.MakeVisible({hash});
    ASSERT_TRUE(ready);
    EXPECT_EQ(ready->owners, std::vector<std::uint64_t>{kA});
    EXPECT_EQ(fresh.Find(hash)->mesh().triangles.size(), 12u);
    EXPECT_EQ(fresh.counters().bytes, bytes.size());
    fresh.Release(kA);
    EXPECT_FALSE(fresh.Find(hash));
    EXPECT_EQ(fresh.counters().bytes, 0u);
  }
}

TEST_F(ShapeStoreTest, WithOnePartMissingItIsNotWhole) {
  for (std::size_t missing = 0; missing < parts.size(); ++missing) {
    ShapeStore fresh(config, &builder, &quotas);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i != missing) {
        ASSERT_FALSE(fresh.Take(parts[i]));
      }
    }
    EXPECT_FALSE(fresh.ProgressOf(kA, hash).whole);
    EXPECT_EQ(fresh.ProgressOf(kA, hash).arrived, parts.size() - 1);
    EXPECT_EQ(fresh.ProgressOf(kA, hash).parts, parts.size());
    EXPECT_EQ(fresh.ProgressOf(kB, hash).parts, 0u);
    EXPECT_TRUE(builder.TakeFinished().empty());
    EXPECT_FALSE(fresh.MakeVisible({hash}));
  }
}

// Goal:   a changed byte is noticed with the last part, reported once, and the shape may be
//         sent again.
TEST_F(ShapeStoreTest, AWrongHashIsRefusedAndMayBeSentAgain) {
  for (std::size_t spoilt = 0; spoilt < parts.size(); ++spoilt) {
    ShapeStore fresh(config, &builder, &quotas);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      v1::ShapePart part = parts[i];
      if (i == spoilt) part.mutable_bytes()->front() ^= 1;
      const auto refusal = fresh.Take(part);
      EXPECT_EQ(FieldOf(refusal), i + 1 == parts.size() ? "content_hash" : "");
    }
    EXPECT_EQ(fresh.counters().refused, 1u);
    EXPECT_EQ(fresh.counters().bytes, 0u);
    for (const v1::ShapePart& part : parts) EXPECT_FALSE(fresh.Take(part));
    EXPECT_TRUE(fresh.MakeVisible({hash}));
  }
}

TEST_F(ShapeStoreTest, PartsThatContradictAreRefused) {
  // Another total.
  EXPECT_EQ(TakeAll({parts[0], parts[1]}), None());
  v1::ShapePart other = PartsOf("a", bytes + std::string(8, 'x'))[2];
  other.set_content_hash(hash);
  EXPECT_EQ(FieldOf(store.Take(other)), "total_bytes");
  EXPECT_EQ(store.counters().bytes, 0u);
  // Parts that are still on their way are not refused one by one.
  EXPECT_EQ(TakeAll({parts[2], parts[3]}), None());
  // Sent again, from its first part on.
  EXPECT_EQ(TakeAll(parts), None());
  EXPECT_TRUE(Ready(hash));
}

TEST_F(ShapeStoreTest, APartThatComesAgainWithOtherBytesIsRefused) {
  for (const std::vector<std::size_t>& before : {std::vector<std::size_t>{0, 1}, {3, 1}}) {
    ShapeStore fresh(config, &builder, &quotas);
    for (const std::size_t i : before) ASSERT_FALSE(fresh.Take(parts[i]));
    v1::ShapePart changed = parts[1];
    changed.mutable_bytes()->back() ^= 1;
    EXPECT_EQ(FieldOf(fresh.Take(changed)), "bytes");
    EXPECT_EQ(fresh.counters().bytes, 0u);
    for (const v1::ShapePart& part : parts) EXPECT_FALSE(fresh.Take(part));
    for (const v1::ShapePart& part : parts) EXPECT_FALSE(fresh.Take(part));
    EXPECT_TRUE(fresh.MakeVisible({hash}));
  }
}

// Goal:   a simulator that writes a wrong hash is refused, and spoils nothing for one that does
//         not, whichever is first and however their parts mix.
TEST_F(ShapeStoreTest, ALiarSpoilsNothing) {
  Random random(2);
  std::vector<v1::ShapePart> lies = PartsOf("b", bytes);
  lies[1].mutable_bytes()->front() ^= 1;
  int refusals = 0;
  for (int round = 0; round < 100; ++round) {
    ShapeStore fresh(config, &builder, &quotas);
    std::size_t true_parts = 0, false_parts = 0;
    while (true_parts < parts.size() || false_parts < lies.size()) {
      const bool lie =
          true_parts == parts.size() || (false_parts < lies.size() && random.Chance(0.5));
      const auto refusal = fresh.Take(lie ? lies[false_parts++] : parts[true_parts++]);
      if (!refusal) continue;
      ++refusals;
      EXPECT_TRUE(lie);
      EXPECT_EQ(refusal->simulator_id, kB);
    }
    const auto ready = fresh.MakeVisible({hash});
    ASSERT_TRUE(ready);
    EXPECT_TRUE(ready->built.shape);
    EXPECT_EQ(fresh.counters().gathering, 0u);
    EXPECT_EQ(fresh.counters().bytes, bytes.size());
  }
  EXPECT_GT(refusals, 20);
  EXPECT_LT(refusals, 80);
}

// Goal:   equal shapes are one, and stay until the last simulator that wrote it, or agent that
//         refers to it, has gone.
TEST_F(ShapeStoreTest, EqualShapesAreOneUntilNoneIsNeeded) {
  const std::vector<v1::ShapePart> of_b = PartsOf("b", bytes);
  // B's first part comes before the shape is whole, the others after.
  EXPECT_EQ(TakeAll({of_b[0]}), None());
  EXPECT_EQ(TakeAll(parts), None());
  EXPECT_EQ(store.counters().bytes, bytes.size());
  EXPECT_EQ(TakeAll({of_b[1]}), None());
  ASSERT_TRUE(Ready(hash));
  const auto shape = store.Find(hash);
  EXPECT_EQ(TakeAll({of_b[2]}), None());
  EXPECT_EQ(store.Find(hash), shape);
  EXPECT_EQ(store.counters().visible, 1u);
  EXPECT_EQ(store.counters().tree_nodes, shape->tree().nodes.size());

  store.AddUser(hash, {SimulatorId("c"), 7});
  store.Release(kA);
  EXPECT_TRUE(store.Find(hash));
  for (const std::uint32_t part : {0, 1}) store.Dispose(kB, hash, part);
  EXPECT_TRUE(store.Find(hash));
  store.RemoveUser(hash, {SimulatorId("c"), 7});
  EXPECT_TRUE(store.Find(hash));  // B's third part
  store.Dispose(kB, hash, 2);
  EXPECT_FALSE(store.Find(hash));
  const ShapeCounters counters = store.counters();
  EXPECT_EQ(counters.bytes + counters.visible + counters.tree_nodes + counters.tree_bytes, 0u);
  EXPECT_EQ(shape.use_count(), 1);
}

// Goal:   a shape disposed of while its tree is built is forgotten, and may come again.
TEST_F(ShapeStoreTest, AShapeDisposedOfWhileBuiltIsForgotten) {
  for (int times = 0; times < 2; ++times) {
    EXPECT_EQ(TakeAll(parts), None());
    EXPECT_EQ(store.counters().builder.building, 1u);
    for (const v1::ShapePart& part : parts) store.Dispose(kA, hash, part.part());
    EXPECT_EQ(store.counters().builder.building, 0u);
    EXPECT_EQ(store.counters().bytes, 0u);
    EXPECT_FALSE(Ready(hash));
  }
  EXPECT_EQ(TakeAll(parts), None());
  EXPECT_TRUE(Ready(hash));
  EXPECT_FALSE(Ready(hash)) << "it is visible already";
}

// Goal:   parts disposed of and written again one by one, in any mixture, leave the shape as it is.
TEST_F(ShapeStoreTest, PartsWrittenAnewKeepTheShape) {
  EXPECT_EQ(TakeAll(parts), None());
  ASSERT_TRUE(Ready(hash));
  const auto shape = store.Find(hash);
  for (std::uint32_t part = 0; part + 1 < parts.size(); ++part) store.Dispose(kA, hash, part);
  EXPECT_EQ(TakeAll({parts[0]}), None());
  store.Dispose(kA, hash, static_cast<std::uint32_t>(parts.size() - 1));
  EXPECT_EQ(store.Find(hash), shape);
  EXPECT_EQ(TakeAll(parts), None());
  EXPECT_EQ(store.Find(hash), shape);
}

TEST_F(ShapeStoreTest, AnUnfinishedShapeGoesWithItsParts) {
  EXPECT_EQ(TakeAll({parts[0], parts[2]}), None());
  EXPECT_EQ(store.counters().bytes, 2 * wire::kShapePartBytes);
  store.Dispose(kA, hash, 0);
  EXPECT_EQ(store.counters().gathering, 1u);
  store.Dispose(kA, hash, 2);
  store.Dispose(kA, hash, 4'000'000'000u);
  EXPECT_EQ(store.counters().gathering, 0u);
  EXPECT_EQ(store.counters().bytes, 0u);
}

// Goal:   content that is no mesh is refused by the build, reported to all that wrote it, and
//         freed.
TEST_F(ShapeStoreTest, BadContentIsRefusedForAllItsOwners) {
  ShapeContent content = Cube(1);
  content.vertices[3][1] = std::numeric_limits<double>::quiet_NaN();
  const std::string bad = EncodeShape(content);
  EXPECT_EQ(TakeAll(PartsOf("a", bad)), None());
  EXPECT_EQ(TakeAll(PartsOf("b", bad)), None());
  store.AddUser(Sha256(bad), {kB, 1});
  const auto ready = store.MakeVisible({Sha256(bad)});
  ASSERT_TRUE(ready);
  EXPECT_FALSE(ready->built.shape);
  EXPECT_FALSE(ready->built.refusal.empty());
  EXPECT_EQ(ready->owners.size(), 2u);
  EXPECT_EQ(store.counters().bytes, 0u);
  EXPECT_EQ(store.counters().refused, 1u);
}

TEST_F(ShapeStoreTest, BadPartsAreRefusedByField) {
  const auto spoilt = [this](auto spoil) {
    v1::ShapePart part = parts[1];
    spoil(&part);
    return FieldOf(store.Take(part));
  };
  using P = v1::ShapePart;
  EXPECT_EQ(spoilt([](P* p) { p->set_content_hash("short"); }), "content_hash");
  EXPECT_EQ(spoilt([](P* p) { p->clear_content_hash(); }), "content_hash");
  EXPECT_EQ(spoilt([](P* p) { p->set_total_bytes(15); }), "total_bytes");
  EXPECT_EQ(spoilt([](P* p) { p->set_parts(p->parts() + 1); }), "parts");
  EXPECT_EQ(spoilt([](P* p) { p->set_parts(0); }), "parts");
  EXPECT_EQ(spoilt([](P* p) { p->set_part(p->parts()); }), "part");
  EXPECT_EQ(spoilt([](P* p) { p->set_part(~0u); }), "part");
  EXPECT_EQ(spoilt([](P* p) { p->clear_bytes(); }), "bytes");
  EXPECT_EQ(spoilt([](P* p) { p->mutable_bytes()->pop_back(); }), "bytes");
  EXPECT_EQ(spoilt([](P* p) { *p->mutable_bytes() += 'x'; }), "bytes");
  EXPECT_EQ(spoilt([](P* p) { p->set_total_bytes(~std::uint64_t{0}); }), "parts");
  EXPECT_EQ(spoilt([](P*) {}), "");
  v1::ShapePart last = parts.back();
  *last.mutable_bytes() += 'x';
  EXPECT_EQ(FieldOf(store.Take(last)), "bytes");
  EXPECT_EQ(store.counters().bytes, wire::kShapePartBytes);
}

// Goal:   limits hold, are reported once for a shape, and free what they refuse.
TEST(ShapeStoreLimits, AreKept) {
  v1::Config config;
  config.set_shapes_max(2);
  config.set_shape_bytes_max(3 * wire::kShapePartBytes);
  config.set_shape_triangles_max(10'000);
  config = CompleteConfig(config);
  InlineShapeBuilder builder({.triangles_max = 10'000});
  SimulatorQuotas quotas(config);
  ShapeStore store(config, &builder, &quotas);
  const auto take = [&store](const std::vector<v1::ShapePart>& parts) {
    std::vector<std::string> refused;
    for (const v1::ShapePart& part : parts) {
      if (const auto refusal = store.Take(part)) refused.push_back(refusal->field);
    }
    return refused;
  };
  using Refused = std::vector<std::string>;
  const std::string large = EncodeShape(Cube(1, UnusedFor(3)));
  EXPECT_EQ(take(PartsOf("a", large)), Refused{"total_bytes"});
  EXPECT_EQ(take(PartsOf("a", large)), Refused{"total_bytes"}) << "sent again, refused again";
  store.Release(kA);

  const std::string two = EncodeShape(Cube(1, UnusedFor(1)));
  const std::string other = EncodeShape(Cube(2, UnusedFor(1)));
  EXPECT_EQ(take(PartsOf("a", two)), Refused());
  EXPECT_EQ(take(PartsOf("a", other)), Refused());

  const std::string third = EncodeShape(Cube(3));
  EXPECT_EQ(take(PartsOf("a", third)), Refused{"content_hash"});
  for (const v1::ShapePart& part : PartsOf("a", two)) {
    store.Dispose(kA, part.content_hash(), part.part());
  }
  EXPECT_EQ(take(PartsOf("a", third)), Refused());
}

TEST(ShapeStoreLimits, APartForWhichThereIsNoRoomIsRefused) {
  v1::Config config;
  config.set_shape_bytes_max(2 * wire::kShapePartBytes);
  config = CompleteConfig(config);
  InlineShapeBuilder builder({.triangles_max = 10'000});
  SimulatorQuotas quotas(config);
  ShapeStore store(config, &builder, &quotas);
  const std::string two = EncodeShape(Cube(1, UnusedFor(1)));
  const std::string other = EncodeShape(Cube(2, UnusedFor(1)));
  for (const v1::ShapePart& part : PartsOf("a", two)) EXPECT_FALSE(store.Take(part));
  const auto refusal = store.Take(PartsOf("b", other)[0]);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->field, "bytes");
  EXPECT_EQ(store.counters().bytes, two.size());
}

// Goal:   a number names one shape while its simulator holds anything of it; the number that a
//         shape has come under last is the one that removes it.
TEST_F(ShapeStoreTest, ANumberNamesOneShape) {
  EXPECT_EQ(TakeAll(parts), None());
  v1::ShapePart other = PartsOf("a", EncodeShape(Cube(7)))[0];
  other.set_shape(parts[0].shape());
  EXPECT_EQ(FieldOf(store.Take(other)), "shape");
  const std::uint32_t former = parts[0].shape(), latter = former + 1;
  std::vector<v1::ShapePart> renumbered = parts;
  for (v1::ShapePart& part : renumbered) part.set_shape(latter);
  EXPECT_EQ(TakeAll(renumbered), None());
  EXPECT_FALSE(store.Knows(kA, former));
  for (const v1::ShapePart& part : parts) store.Dispose(kA, former, part.part());
  EXPECT_TRUE(store.Knows(kA, latter));
  for (const v1::ShapePart& part : parts) store.Dispose(kA, latter, part.part());
  EXPECT_FALSE(store.Knows(kA, latter));
  EXPECT_FALSE(store.Take(other)) << "the number is free again";
}

// Goal:   numbers are forgotten with what they name, also if it is refused later than it came.
TEST_F(ShapeStoreTest, NumbersAreForgottenWithTheirShapes) {
  const v1::ShapePart bad =
      PartsOf("a", EncodeShape({.vertices = {{0, 0, 0}}, .triangles = {}}))[0];
  store.Take(bad);
  store.MakeVisible({bad.content_hash()});
  EXPECT_FALSE(store.Knows(kA, bad.shape()));
  EXPECT_EQ(TakeAll(parts), None());
  store.Release(kA);
  EXPECT_FALSE(store.Knows(kA, parts[0].shape()));
}

// Goal:   after any sequence of everything, what is counted is what is there.
// Method: two simulators, three shapes of which one is bad, 20,000 random operations; in the end
//         all simulators go, and nothing is left.
TEST(ShapeStoreAtRandom, CountsWhatIsThere) {
  v1::Config config;
  config.set_shapes_max(3);
  config.set_shape_bytes_max(5 * wire::kShapePartBytes);
  config = CompleteConfig(config);
  InlineShapeBuilder builder({.triangles_max = 1000});
  SimulatorQuotas quotas(config);
  ShapeStore store(config, &builder, &quotas);
  Random random(3);
  std::vector<std::vector<v1::ShapePart>> shapes;
  for (const std::size_t parts : {0, 1, 2}) {
    std::string bytes = EncodeShape(Cube(1, UnusedFor(parts)));
    if (parts == 2) bytes[20] ^= 0x7f;
    for (const char* simulator : {"a", "b"}) shapes.push_back(PartsOf(simulator, bytes));
  }
  std::map<std::string, std::set<ShapeUser>> users;
  for (int i = 0; i < 20'000; ++i) {
    const std::vector<v1::ShapePart>& parts = shapes[random.Below(shapes.size())];
    v1::ShapePart part = parts[random.Below(parts.size())];
    const ShapeUser user(part.simulator_id(), static_cast<std::uint32_t>(random.Below(2)));
    switch (random.Below(9)) {
      case 0:
        store.Dispose(part.simulator_id(), part.content_hash(), part.part());
        break;
      case 1:
        if (random.Chance(0.1)) store.Release(part.simulator_id());
        break;
      case 2:
        store.AddUser(part.content_hash(), user);
        users[part.content_hash()].insert(user);
        break;
      case 3:
        store.RemoveUser(part.content_hash(), user);
        users[part.content_hash()].erase(user);
        break;
      case 4:
        for (const ReadyTree& tree : builder.TakeFinished()) store.MakeVisible(tree);
        break;
      case 5:
        part.mutable_bytes()->back() ^= 1;
        [[fallthrough]];
      default:
        store.Take(part);
    }
    ASSERT_LE(store.counters().bytes, config.shape_bytes_max());
    ASSERT_LE(store.counters().visible + store.counters().gathering, config.shapes_max());
  }
  for (const char* simulator : {"a", "b"}) store.Release(SimulatorId(simulator));
  for (const auto& [hash, all] : users) {
    for (const ShapeUser& user : all) store.RemoveUser(hash, user);
  }
  const ShapeCounters left = store.counters();
  EXPECT_EQ(left.bytes + left.visible + left.gathering + left.tree_nodes + left.tree_bytes, 0u);
  EXPECT_EQ(left.builder.building, 0u);
}

}  // namespace
}  // namespace collision::server
