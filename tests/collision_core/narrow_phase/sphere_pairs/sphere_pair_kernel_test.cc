// Goal:   the kernels' bounds hold, are nearly tight, and are the same bits on every processor.
// Method: random packs and blocks of all scales at random poses, far from the reference points as
//         well; exact rational arithmetic for the truth, each width of vectors beside the plain
//         one.
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "collision_core/narrow_phase/separation/separation_findings.h"
#include "collision_core/narrow_phase/sphere_pairs/kernel_pose.h"
#include "tests/collision_core/narrow_phase/sphere_pairs/exact_pose.h"
#include "tests/support/meshes.h"

namespace collision::narrow_phase {
namespace {

BodySegment SegmentOf(const geometry::TriangleMesh& mesh) {
  BodySegment segment;
  segment.shape = shape::Shape::Build(mesh);
  return segment;
}

struct Scales {
  double least = 1e-5, most = 1e5;
};

/// Two bodies of one scale, about as far apart as they are large, or a thousand times that.
struct Scene {
  Random random;
  double scale;
  BodySegment of_a, of_b;
  BodyTree a, b;
  PackedBody packed_a, packed_b;
  RelativePose pose;
  KernelPose scan;

  explicit Scene(std::uint64_t seed, Scales scales = {})
      : random(seed),
        scale(random.LogUniform(scales.least, scales.most)),
        of_a(SegmentOf(RandomMesh())),
        of_b(SegmentOf(RandomMesh())),
        a(of_a),
        b(of_b),
        packed_a(a),
        packed_b(b) {
    const double apart = scale * (random.Chance(0.2) ? 1000 : random.Uniform(0, 4));
    const Eigen::Matrix3d matrix = RandomMatrix(random);
    // The middles, not the reference points, are that far apart.
    pose = PoseOf(matrix, packed_a.origin - matrix * packed_b.origin + apart * random.UnitVector());
    scan = KernelPoseOf(packed_a, packed_b, pose, SlackOf({a, b, pose}));
    Eigen::Vector3f::Map(scan.direction) = random.UnitVector().cast<float>();
  }

  geometry::TriangleMesh RandomMesh() {
    const double away = random.Chance(0.3) ? random.LogUniform(1, 1e3) : 0;
    return Scaled(Moved(Star(2, random), away * random.UnitVector()), scale);
  }

  BallScanTask RandomTask() {
    BallScanTask task;
    const auto pack = [&](const PackedBody& body) {
      sphere_tree::BallRef ball = 0;
      for (int i = 0; i < 6; ++i) {
        const std::uint32_t link = body.LinkOf(ball);
        if (sphere_tree::BallLink::IsLeaf(link)) break;
        ball = sphere_tree::BallLink::Index(link) * sphere_tree::kPackBalls +
               static_cast<std::uint32_t>(random.Below(sphere_tree::BallLink::Count(link)));
      }
      return body.packs + ball / sphere_tree::kPackBalls;
    };
    task.a = pack(packed_a), task.b = pack(packed_b);
    task.opened = static_cast<Opened>(random.Below(3));
    task.lane = static_cast<std::uint32_t>(random.Below(sphere_tree::kPackBalls));
    task.rows = task.opened == Opened::kBoth ? 1 + static_cast<std::uint32_t>(random.Below(8)) : 1;
    task.parent = static_cast<float>(-4 * scale);
    task.limit = static_cast<float>(scale * random.Uniform(-1, 4));
    task.upper = static_cast<float>(scale * random.Uniform(-1, 4));
    task.only_within = random.Chance(0.5);
    if (task.only_within) task.limit = std::max(task.limit, 0.0f);
    return task;
  }
};

struct Answer {
  BallHits hits;
  float uppers[kPairsMax + kLanesOver];
  LeastBeyond beyond;

  Answer(const SpherePairKernel& scan, const KernelPose& pose, const BallScanTask& task) {
    std::fill_n(beyond, kLanesOver, sphere_tree::kFarDistance);
    std::fill_n(uppers, kPairsMax, 0.0f);
    scan.balls(pose, task, beyond, &hits, task.only_within ? nullptr : uppers);
  }
  bool IsWithin(std::uint32_t code) const { return (hits.within >> code & 1) != 0; }
  float least() const { return *std::min_element(beyond, beyond + kLanesOver); }
};

template <typename T>
bool SameBits(const T* a, const T* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof(T)) == 0;
}

std::vector<const SpherePairKernel*> WideScans() {
  std::vector<const SpherePairKernel*> wide;
  for (const SpherePairKernel* scan : {Avx2SpherePairKernel(), Avx512SpherePairKernel()}) {
    if (scan != nullptr) wide.push_back(scan);
  }
  return wide;
}

void Turn(Scene* scene) {
  scene->pose.chord_A = scene->random.Uniform(0, 2);
  scene->pose.chord_B = scene->random.Chance(0.5) ? 0 : 1e-6;
  scene->scan = KernelPoseOf(scene->packed_a, scene->packed_b, scene->pose,
                             SlackOf({scene->a, scene->b, scene->pose}));
}

TEST(SpherePairKernel, BallsAreTheSameBitsForEveryWidth) {
  int certain = 0, news = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Scene scene(seed);
    for (int i = 0; i < 40; ++i) {
      if (i == 20) Turn(&scene);
      const BallScanTask task = scene.RandomTask();
      const Answer plain(*PlainSpherePairKernel(), scene.scan, task);
      certain += __builtin_popcountll(plain.hits.within);
      news += plain.hits.upper < sphere_tree::kFarDistance;
      for (const SpherePairKernel* scan : WideScans()) {
        const Answer wide(*scan, scene.scan, task);
        ASSERT_EQ(plain.hits.within, wide.hits.within);
        ASSERT_TRUE(SameBits(&plain.hits.upper, &wide.hits.upper, 1));
        ASSERT_TRUE(
            SameBits(plain.hits.lowers, wide.hits.lowers, task.rows * sphere_tree::kPackBalls));
        ASSERT_TRUE(SameBits(plain.uppers, wide.uppers, task.rows * sphere_tree::kPackBalls));
        ASSERT_EQ(plain.least(), wide.least());
      }
    }
  }
  EXPECT_GT(certain, 1000);
  EXPECT_GT(news, 100);
}

TEST(SpherePairKernel, TrianglesAreTheSameBitsForEveryWidth) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Scene scene(seed);
    for (std::uint32_t i = 0; i < 30; ++i) {
      const sphere_tree::TriangleBlock& a = scene.packed_a.tree->blocks()[i];
      const sphere_tree::TriangleBlock& b = scene.packed_b.tree->blocks()[2 * i];
      const auto limit = static_cast<float>(scene.scale * scene.random.Uniform(-1, 4));
      const bool only_within = scene.random.Chance(0.5) && limit >= 0;
      const BlockScanTask task = {&a, &b, scene.scan.triangle_slack, -1, limit, only_within};
      float plain[16], wide[16];
      LeastBeyond beyond, beyond_wide;
      std::fill_n(beyond, kLanesOver, sphere_tree::kFarDistance);
      const unsigned within = PlainSpherePairKernel()->triangles(scene.scan, task, beyond, plain);
      for (const SpherePairKernel* scan : WideScans()) {
        std::fill_n(beyond_wide, kLanesOver, sphere_tree::kFarDistance);
        ASSERT_EQ(scan->triangles(scene.scan, task, beyond_wide, wide), within);
        ASSERT_TRUE(SameBits(plain, wide, 16));
        ASSERT_EQ(*std::min_element(beyond, beyond + kLanesOver),
                  *std::min_element(beyond_wide, beyond_wide + kLanesOver));
      }
    }
  }
}

ExactVector CentreIn(const PackedBody& body, const sphere_tree::BallPack& pack, std::uint32_t i) {
  return ExactVector(body.origin) +
         ExactVector(Exact(pack.x[i]), Exact(pack.y[i]), Exact(pack.z[i]));
}

/// lower <= √square + add <= upper, exactly, and neither is off by more than `loose`.
void ExpectBrackets(const Exact& lower, const Exact& upper, const Exact& square,
                    const Exact& add_lower, const Exact& add_upper, const Exact& loose) {
  const auto at_most_root = [&](const Exact& x) { return x <= 0 || x * x <= square; };
  EXPECT_TRUE(at_most_root(lower - add_lower));
  EXPECT_TRUE(at_most_root(lower - add_lower) && !at_most_root(lower - add_lower + loose));
  EXPECT_FALSE(upper - add_upper < 0 || (upper - add_upper) * (upper - add_upper) < square);
  EXPECT_TRUE(at_most_root(upper - add_upper - loose));
}

ExactVector ExactBetween(const Scene& scene, const BallScanTask& task, std::uint32_t i,
                         std::uint32_t j) {
  return ExactlyPosed(scene.pose, CentreIn(scene.packed_b, *task.b, j)) -
         CentreIn(scene.packed_a, *task.a, i);
}

struct BeyondCounts {
  int beyond = 0, within = 0, nowhere = 0;
};

/// Balls of two packs beside a limit that is nearly one of the distances.
void ExpectCertainlyBeyond(Scene* scene, BeyondCounts* counts) {
  BallScanTask task = scene->RandomTask();
  task.opened = Opened::kBoth, task.rows = 8, task.lane = 0, task.only_within = true;
  task.upper = -sphere_tree::kFarDistance;  // nothing is news
  const ExactVector near = ExactBetween(*scene, task, 0, 0);
  const double off = std::sqrt(Square(near).convert_to<double>());
  const double radii = double{task.a->radius[0]} + double{task.b->radius[0]};
  const double slack = scene->scan.slack;
  task.limit =
      static_cast<float>(std::max(0.0, off - radii + slack * scene->random.Uniform(-4, 4)));
  const Answer answer(*PlainSpherePairKernel(), scene->scan, task);
  EXPECT_LE(answer.least(), task.limit);
  for (std::uint32_t code = 0; code < kPairsMax; ++code) {
    const std::uint32_t i = code / 8, j = code % 8;
    if (task.a->radius[i] < 0 || task.b->radius[j] < 0) {
      EXPECT_FALSE(answer.IsWithin(code));
      ++counts->nowhere;
      continue;
    }
    const Exact sum = Exact(task.a->radius[i]) + Exact(task.b->radius[j]) + Exact(task.limit);
    const Exact loose = std::max(Exact(sum + Exact(3 * slack)), Exact(1.001f * kDistinctMin));
    const Exact square = Square(ExactBetween(*scene, task, i, j));
    if (answer.IsWithin(code)) {
      EXPECT_LE(square, loose * loose);
      ++counts->within;
    } else {
      EXPECT_GT(square, sum * sum);
      ++counts->beyond;
    }
  }
}

TEST(SpherePairKernel, BallsBeyondALimitAreCertainlyBeyond) {
  BeyondCounts counts;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(seed);
    ExpectCertainlyBeyond(&scene, &counts);
  }
  EXPECT_GT(counts.beyond, 1000);
  EXPECT_GT(counts.within, 1000);
  EXPECT_GT(counts.nowhere, 100);
}

// These balls are so small and so near each other that squares lose their digits, or are zero.
TEST(SpherePairKernel, BallsWhoseSquaresUnderflowAreCertainlyBeyond) {
  BeyondCounts counts;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(seed, {1e-24, 1e-17});
    ExpectCertainlyBeyond(&scene, &counts);
  }
  EXPECT_GT(counts.beyond, 1000);
  EXPECT_GT(counts.within, 1000);
}

TEST(SpherePairKernel, BallsThatMayBeNewsAreLookedAtClosely) {
  int news = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Scene scene(seed);
    BallScanTask task = scene.RandomTask();
    task.only_within = false;
    const Answer closely(*PlainSpherePairKernel(), scene.scan, task);
    const float least = *std::min_element(closely.uppers, closely.uppers + task.rows * 8);
    for (const float share : {0.999f, 1.001f}) {
      task.upper = least * share, task.limit = 0, task.only_within = true;
      const Answer answer(*PlainSpherePairKernel(), scene.scan, task);
      EXPECT_EQ(answer.hits.upper, least < task.upper ? least : sphere_tree::kFarDistance);
      ++(least < task.upper ? news : none);
    }
  }
  EXPECT_GT(news, 100);
  EXPECT_GT(none, 100);
}

TEST(SpherePairKernel, BallBoundsHoldExactly) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(seed);
    BallScanTask task = scene.RandomTask();
    task.opened = Opened::kBoth, task.rows = 8, task.lane = 0, task.only_within = false;
    task.parent = -sphere_tree::kFarDistance, task.limit = sphere_tree::kFarDistance;
    const Answer answer(*PlainSpherePairKernel(), scene.scan, task);
    for (std::uint32_t code = 0; code < kPairsMax; ++code) {
      const std::uint32_t i = code / 8, j = code % 8;
      if (task.a->radius[i] < 0 || task.b->radius[j] < 0) continue;
      const ExactVector d = ExactBetween(scene, task, i, j);
      const Exact radii = Exact(task.a->radius[i]) + Exact(task.b->radius[j]);
      const Exact depths = Exact(task.a->signed_distance[i]) + Exact(task.b->signed_distance[j]);
      ExpectBrackets(Exact(answer.hits.lowers[code]), Exact(answer.uppers[code]), Square(d), -radii,
                     depths, Exact(3 * scene.scan.slack));
    }
  }
}

TEST(SpherePairKernel, TriangleBoundsHoldExactly) {
  int tight = 0, pairs = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(seed);
    const auto& mesh_a = scene.a.shape()->mesh();
    const auto& mesh_b = scene.b.shape()->mesh();
    for (std::uint32_t i = 0; i < 4; ++i) {
      const sphere_tree::TriangleBlock& a = scene.packed_a.tree->blocks()[scene.random.Below(40)];
      const sphere_tree::TriangleBlock& b = scene.packed_b.tree->blocks()[scene.random.Below(40)];
      float lowers[16];
      LeastBeyond beyond;
      std::fill_n(beyond, kLanesOver, sphere_tree::kFarDistance);
      PlainSpherePairKernel()->triangles(
          scene.scan, {&a, &b, scene.scan.triangle_slack, 0, sphere_tree::kFarDistance}, beyond,
          lowers);
      for (std::uint32_t k = 0; k < 16; k += 5) {
        if (k / 4 >= a.left || k % 4 >= b.left) continue;
        ExactTriangle t, u;
        for (std::size_t corner = 0; corner < 3; ++corner) {
          t[corner] =
              ExactVector(mesh_a.vertices[mesh_a.triangles[a.element[k / 4].value()][corner]]);
          u[corner] = ExactlyPosed(
              scene.pose,
              ExactVector(mesh_b.vertices[mesh_b.triangles[b.element[k % 4].value()][corner]]));
        }
        const Exact square = SquareOfTriangles(t, u), lower = Exact(lowers[k]);
        EXPECT_TRUE(lower <= 0 || lower * lower <= square) << lowers[k];
        ++pairs;
        const Exact more = lower + Exact(0.1 * scene.scale);
        tight += more > 0 && more * more >= square;
      }
    }
  }
  EXPECT_GT(pairs, 200);
  EXPECT_GT(3 * tight, pairs) << "but between corners, gaps are nearly the distance";
}

}  // namespace
}  // namespace collision::narrow_phase
