#include "server/shapes/tree_cache.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "collision_core/shape/shape.h"
#include "idl/sha256.h"
#include "server/recording/recording.h"
#include "server/shapes/threaded_shape_builder.h"
#include "tests/server/shapes/two_cubes.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRoomy = 1'000'000'000;

/// A folder of the test's own, empty at first and gone afterwards.
class TreeCacheTest : public testing::Test {
 protected:
  TreeCacheTest()
      : folder_(testing::TempDir() + "tree_cache_test." + std::to_string(getpid()) + "." +
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
  }
  ~TreeCacheTest() override { fs::remove_all(folder_); }

  std::vector<fs::path> Files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }
  std::uint64_t BytesOfFiles() const {
    std::uint64_t bytes = 0;
    for (const fs::path& file : Files()) bytes += fs::file_size(file);
    return bytes;
  }
  /// As if it had been used so many hours ago.
  static void Age(const fs::path& file, int hours) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }

  const std::string folder_;
};

std::string Contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void SetContents(const fs::path& file, const std::string& bytes) {
  fs::remove_all(file);
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string HashOf(int number) { return Sha256("shape " + std::to_string(number)); }

bool SameBits(const sphere_tree::SphereTree& a, const sphere_tree::SphereTree& b) {
  const auto same = [](const sphere_tree::SphereNode& x, const sphere_tree::SphereNode& y) {
    return x.centre == y.centre && x.radius == y.radius && x.signed_distance == y.signed_distance &&
           x.first_child == y.first_child && x.children == y.children &&
           x.first_element == y.first_element && x.elements == y.elements && x.level == y.level;
  };
  return a.levels == b.levels && a.elements == b.elements &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same);
}

// Goal:   what was kept comes back bit for bit, in this process and the next, and nothing else
//         does.
TEST_F(TreeCacheTest, GivesBackWhatWasKept) {
  const geometry::TriangleMesh mesh = LShape(), other = Sheet(1, 20);
  const sphere_tree::SphereTree tree = shape::Shape::Build(mesh)->tree(),
                                other_tree = shape::Shape::Build(other)->tree();
  {
    TreeCache cache(folder_ + "/made/with/those/above", kRoomy, {});
    EXPECT_EQ(cache.Load(HashOf(1), mesh), std::nullopt);
    cache.Store(HashOf(1), tree);
    cache.Store(HashOf(2), other_tree);
    EXPECT_TRUE(SameBits(cache.Load(HashOf(1), mesh).value(), tree));
    EXPECT_EQ(cache.counters().misses, 1u);
    EXPECT_EQ(cache.counters().stored, 2u);
    EXPECT_EQ(cache.counters().hits, 1u);
  }
  TreeCache cache(folder_ + "/made/with/those/above", kRoomy, {});
  EXPECT_TRUE(SameBits(cache.Load(HashOf(2), other).value(), other_tree));
  EXPECT_EQ(cache.Load(HashOf(3), mesh), std::nullopt);
  EXPECT_EQ(cache.counters().discarded, 0u);
}

// Goal:   a tree that is built in another way is another tree.
TEST_F(TreeCacheTest, KnowsHowATreeWasBuilt) {
  const geometry::TriangleMesh mesh = LShape();
  TreeCache cache(folder_, kRoomy, {});
  cache.Store(HashOf(1), shape::Shape::Build(mesh)->tree());
  for (const sphere_tree::ShapeOptions& options :
       {sphere_tree::ShapeOptions{.builder = sphere_tree::TreeBuilder::kFitted},
        sphere_tree::ShapeOptions{.builder = sphere_tree::TreeBuilder::kMedianSplit},
        sphere_tree::ShapeOptions{.triangles_per_leaf = 5},
        sphere_tree::ShapeOptions{.levels_max = 11},
        sphere_tree::ShapeOptions{.nodes_max = 1000}}) {
    TreeCache another(folder_, kRoomy, options);
    EXPECT_EQ(another.Load(HashOf(1), mesh), std::nullopt);
    EXPECT_EQ(another.counters().misses, 1u);
  }
  EXPECT_NE(BuilderFingerprint({}),
            BuilderFingerprint({.builder = sphere_tree::TreeBuilder::kFitted}));
  EXPECT_NE(BuilderFingerprint({}), BuilderFingerprint({.triangles_per_leaf = 1}));
  EXPECT_EQ(BuilderFingerprint({}), BuilderFingerprint({}));
}

/// The file with another content that its own checksum agrees with.
std::string Resealed(v1::TreeFile file) {
  Sha256Hasher hasher;
  hasher.Add(file.content_hash());
  hasher.Add(file.recipe().SerializeAsString());
  hasher.Add(file.tree());
  file.set_checksum(hasher.Digest());
  return file.SerializeAsString();
}

// Goal:   a file that is not what its name says is not used, counted once, and replaced by the next
//         tree that is kept.
// Method: one file, spoilt in every way we know; those that only a new checksum can hide, with one.
TEST_F(TreeCacheTest, FilesOfAnyOtherKindAreHarmless) {
  const geometry::TriangleMesh mesh = LShape();
  const sphere_tree::SphereTree tree = shape::Shape::Build(mesh)->tree();
  TreeCache cache(folder_, kRoomy, {});
  cache.Store(HashOf(1), tree);
  const fs::path path = Files().at(0);
  v1::TreeFile good;
  ASSERT_TRUE(good.ParseFromString(Contents(path)));

  std::vector<std::string> spoilt = {"", "nothing", std::string(1000, '\0'),
                                     Contents(path) + "more"};
  const auto spoil = [&](const std::function<void(v1::TreeFile*)>& change) {
    v1::TreeFile file = good;
    change(&file);
    spoilt.push_back(Resealed(file));
  };
  const auto spoil_tree = [&](const std::function<void(v1::SphereTree*)>& change) {
    v1::SphereTree message;
    ASSERT_TRUE(message.ParseFromString(good.tree()));
    change(&message);
    spoil([&](v1::TreeFile* file) { file->set_tree(message.SerializeAsString()); });
  };
  spoil([](v1::TreeFile* file) { file->set_format(2); });
  spoil([](v1::TreeFile* file) { file->clear_format(); });
  spoil([](v1::TreeFile* file) { file->set_content_hash(HashOf(2)); });
  spoil([](v1::TreeFile* file) { file->mutable_recipe()->set_builder(v1::TreeRecipe::FITTED); });
  spoil([](v1::TreeFile* file) { file->mutable_recipe()->set_builder_fingerprint("old"); });
  spoil([](v1::TreeFile* file) { file->clear_recipe(); });
  spoil([](v1::TreeFile* file) { file->set_tree(""); });
  spoil([](v1::TreeFile* file) { file->set_tree("not a tree"); });
  spoil_tree([](v1::SphereTree* message) { message->mutable_radius_m()->RemoveLast(); });
  spoil_tree([](v1::SphereTree* message) { message->add_centre_m(1); });
  spoil_tree([](v1::SphereTree* message) { message->set_first_child(0, 0); });
  spoil_tree([](v1::SphereTree* message) { message->set_radius_m(0, std::nan("")); });
  spoil_tree([](v1::SphereTree* message) { message->set_triangle_indices(0, 1'000'000); });
  v1::TreeFile unsealed = good;
  unsealed.mutable_checksum()->back() ^= 1;
  spoilt.push_back(unsealed.SerializeAsString());

  for (std::size_t i = 0; i < spoilt.size(); ++i) {
    SetContents(path, spoilt[i]);
    const std::uint64_t before = cache.counters().discarded;
    EXPECT_EQ(cache.Load(HashOf(1), mesh), std::nullopt) << "spoilt in way " << i;
    EXPECT_EQ(cache.counters().discarded, before + 1) << "spoilt in way " << i;
    cache.Store(HashOf(1), tree);
    EXPECT_TRUE(SameBits(cache.Load(HashOf(1), mesh).value(), tree));
  }
}

// Goal:   no damage whatever gives another tree than the one that was kept.
// Method: cut off at every 7th byte; 2000 files with a few bytes changed.
TEST_F(TreeCacheTest, DamageIsNeverTakenForATree) {
  Random random(9);
  const geometry::TriangleMesh mesh = Tetrahedron(1);
  const sphere_tree::SphereTree tree = shape::Shape::Build(mesh)->tree();
  TreeCache cache(folder_, kRoomy, {});
  cache.Store(HashOf(1), tree);
  const fs::path path = Files().at(0);
  const std::string whole = Contents(path);
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    SetContents(path, whole.substr(0, length));
    EXPECT_EQ(cache.Load(HashOf(1), mesh), std::nullopt) << length;
  }
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = whole;
    for (std::uint64_t n = 1 + random.Below(4); n > 0; --n) {
      bytes[random.Below(bytes.size())] = static_cast<char>(random.Next());
    }
    SetContents(path, bytes);
    const auto loaded = cache.Load(HashOf(1), mesh);
    if (loaded) {
      EXPECT_TRUE(SameBits(*loaded, tree));
    }
  }
}

// Goal:   what stands where a file should be, and is none, is neither followed nor waited for.
TEST_F(TreeCacheTest, NeitherFollowsLinksNorWaitsAtPipes) {
  const geometry::TriangleMesh mesh = LShape();
  const sphere_tree::SphereTree tree = shape::Shape::Build(mesh)->tree();
  TreeCache cache(folder_, kRoomy, {});
  cache.Store(HashOf(1), tree);
  const fs::path path = Files().at(0), elsewhere = folder_ + "/elsewhere";
  fs::rename(path, elsewhere);
  const std::string kept = Contents(elsewhere);

  fs::create_symlink(elsewhere, path);
  EXPECT_EQ(cache.Load(HashOf(1), mesh), std::nullopt);
  cache.Store(HashOf(1), tree);
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(path)));
  EXPECT_EQ(Contents(elsewhere), kept);

  fs::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(cache.Load(HashOf(1), mesh), std::nullopt);
  cache.Store(HashOf(1), tree);
  EXPECT_TRUE(cache.Load(HashOf(1), mesh));

  fs::remove(path);
  fs::create_directories(path / "full");
  EXPECT_EQ(cache.Load(HashOf(1), mesh), std::nullopt);
  cache.Store(HashOf(1), tree);
  EXPECT_EQ(cache.counters().failed, 1u);
  EXPECT_TRUE(fs::is_directory(path / "full"));
  EXPECT_EQ(cache.counters().discarded, 3u);
}

// Goal:   the folder never exceeds its bound; what was used least lately goes first, and what is
//         not the cache's own stays.
TEST_F(TreeCacheTest, KeepsItsBoundByRemovingWhatWasUsedLeastLately) {
  const geometry::TriangleMesh mesh = LShape();
  const sphere_tree::SphereTree tree = shape::Shape::Build(mesh)->tree();
  std::uint64_t one = 0;
  {
    TreeCache cache(folder_, kRoomy, {});
    cache.Store(HashOf(0), tree);
    one = BytesOfFiles();
    EXPECT_EQ(cache.counters().bytes, one);
    fs::remove_all(folder_);
  }
  TreeCache cache(folder_, 3 * one + one / 2, {});
  SetContents(folder_ + "/notes.txt", "mine");
  std::vector<fs::path> files;
  for (int i = 0; i < 3; ++i) {
    cache.Store(HashOf(i), tree);
    for (const fs::path& file : Files()) {
      const bool known = std::find(files.begin(), files.end(), file) != files.end();
      if (!known && file.extension() == ".tree") files.push_back(file);
    }
    Age(files[i], 10 - i);
  }
  ASSERT_EQ(files.size(), 3u);
  EXPECT_TRUE(cache.Load(HashOf(0), mesh));  // The oldest, but used now.
  cache.Store(HashOf(3), tree);
  EXPECT_FALSE(fs::exists(files[1]));
  EXPECT_TRUE(fs::exists(files[0]) && fs::exists(files[2]));
  cache.Store(HashOf(4), tree);
  EXPECT_FALSE(fs::exists(files[2]));
  EXPECT_TRUE(cache.Load(HashOf(0), mesh) && cache.Load(HashOf(3), mesh) &&
              cache.Load(HashOf(4), mesh));
  EXPECT_EQ(cache.counters().removed, 2u);
  EXPECT_LE(cache.counters().bytes, 3 * one + one / 2);
  EXPECT_EQ(Contents(folder_ + "/notes.txt"), "mine");

  // A lower bound holds from the start on; a tree larger than all of it is not kept.
  TreeCache smaller(folder_, one + one / 2, {});
  EXPECT_EQ(smaller.counters().removed, 2u);
  EXPECT_EQ(smaller.counters().bytes, one);
  TreeCache tiny(folder_, one - 1, {});
  tiny.Store(HashOf(5), tree);
  EXPECT_EQ(tiny.counters().failed, 1u);
  EXPECT_EQ(Files().size(), 1u);
}

// Goal:   files that a process left unfinished go, those of one at work stay.
TEST_F(TreeCacheTest, RemovesFilesThatWereNeverFinished) {
  fs::create_directories(folder_);
  const fs::path left = folder_ + "/.a-b.1.1.tree.aside",
                 at_work = folder_ + "/.a-c.2.1.tree.aside";
  SetContents(left, "half");
  SetContents(at_work, "half");
  Age(left, 2);
  TreeCache cache(folder_, kRoomy, {});
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(at_work));
}

// Goal:   a folder that cannot be is said at the start; one that vanishes later costs nothing but
//         the trees.
TEST_F(TreeCacheTest, AnImpossibleFolderIsReportedAtTheStart) {
  fs::create_directories(folder_);
  SetContents(folder_ + "/file", "x");
  try {
    TreeCache cache(folder_ + "/file/below", kRoomy, {});
    FAIL() << "a folder below a file";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(folder_ + "/file/below: "), std::string::npos);
  }
  const geometry::TriangleMesh mesh = LShape();
  TreeCache cache(folder_, kRoomy, {});
  fs::remove_all(folder_);
  EXPECT_EQ(cache.Load(HashOf(1), mesh), std::nullopt);
  cache.Store(HashOf(1), shape::Shape::Build(mesh)->tree());
  EXPECT_EQ(cache.counters().failed, 1u);
  EXPECT_EQ(cache.counters().misses, 1u);
}

// Goal:   whether a tree is built or read makes no difference to what is built from the bytes, and
//         shapes that are refused leave nothing behind.
TEST_F(TreeCacheTest, AShapeFromTheCacheIsTheShape) {
  const auto cache = std::make_shared<TreeCache>(folder_, kRoomy, sphere_tree::ShapeOptions{});
  const BuildOptions with{.triangles_max = 100, .cache = cache};
  const std::string bytes = EncodeShape(Cube(1)), hash = Sha256(bytes);
  const BuiltShape first = BuildShape(hash, bytes, with), second = BuildShape(hash, bytes, with);
  EXPECT_FALSE(first.from_cache);
  EXPECT_TRUE(second.from_cache);
  EXPECT_TRUE(SameBits(first.shape->tree(), second.shape->tree()));
  EXPECT_EQ(first.shape->facts().radius, second.shape->facts().radius);
  EXPECT_TRUE(second.shape->closed());
  EXPECT_NE(BuildShape(Sha256("x"), "x", with).refusal, "");
  EXPECT_EQ(cache->counters().misses, 1u);
  EXPECT_EQ(Files().size(), 1u);
}

// Goal:   the event log of a run is that of its replay, which has no cache, whether its trees were
//         built or read.
TEST_F(TreeCacheTest, ReplaysDoNotDependOnIt) {
  for (const std::uint64_t hits : {0u, 1u}) {
    const std::string path = folder_ + "/recording";
    std::uint64_t hash = 0, count = 0;
    const v1::Config config = CompleteConfig(Simulated());
    {
      BuildOptions build = BuildOptionsOf(config);
      build.cache = std::make_shared<TreeCache>(folder_, kRoomy, build.tree);
      RecordingWriter writer(path, config);
      std::atomic<bool> woken = false;
      ScriptedDaemon daemon(config, &writer,
                            std::make_unique<ThreadedShapeBuilder>(build, [&] { woken = true; }));
      TwoCubes cubes(1.9);
      daemon.Step(cubes.Descriptions());
      daemon.Step(cubes.Parts());
      while (!woken) Fly(&daemon, &cubes, 1);
      Fly(&daemon, &cubes, 20);
      EXPECT_EQ(daemon.counter("tree_cache_hits"), hits);
      EXPECT_EQ(daemon.counter("tree_cache_stored"), 1 - hits);
      EXPECT_GT(daemon.counter("tree_cache_bytes"), 0u);
      EXPECT_EQ(LastEvent(daemon).status(), v1::EVENT_CONFIRMED);
      hash = daemon.daemon().event_log().hash();
      count = daemon.daemon().event_log().count();
    }
    ExpectSameReplay(path, hash, count);
  }
}

}  // namespace
}  // namespace collision::server
