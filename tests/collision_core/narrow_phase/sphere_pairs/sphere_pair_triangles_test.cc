// Goal:   the kernels claim of no two triangles that they are beyond a limit that are not, whatever
//         their size; of nearly all that are well beyond it they claim it.
// Method: triangles that lie in each other like straws: many are apart across two edges only. Exact
//         rational arithmetic for the truth.
#include <gtest/gtest.h>

#include <algorithm>

#include "collision_core/narrow_phase/separation/separation_findings.h"
#include "collision_core/narrow_phase/sphere_pairs/kernel_pose.h"
#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"
#include "tests/collision_core/narrow_phase/sphere_pairs/exact_pose.h"

namespace collision::narrow_phase {
namespace {

/// Four triangles in a cube of side 2, some of them needles or flat.
geometry::TriangleMesh Soup(Random& random, double scale) {
  geometry::TriangleMesh mesh;
  const auto in_cube = [&] {
    return Eigen::Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
  };
  for (std::uint32_t t = 0; t < sphere_tree::kBlockTriangles; ++t) {
    const Eigen::Vector3d p = in_cube(), q = in_cube();
    const double across = random.Chance(0.4) ? random.LogUniform(1e-8, 1e-2) : 1;
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    for (const Eigen::Vector3d& x : {p, q, Eigen::Vector3d(p + across * (in_cube() - p))}) {
      mesh.vertices.push_back(scale * x);
    }
  }
  return mesh;
}

struct StrawCounts {
  int apart = 0, certain = 0, touching = 0;
};

/// Every triangle of a soup of size `scale_a` beside every one of a soup of size `scale`.
void ExpectStrawsCertainlyBeyond(double scale_a, double scale, Random* random,
                                 StrawCounts* counts) {
  BodySegment of_a, of_b;
  of_a.shape = shape::Shape::Build(Soup(*random, scale_a));
  of_b.shape = shape::Shape::Build(Soup(*random, scale));
  const BodyTree a(of_a), b(of_b);
  const PackedBody packed_a(a), packed_b(b);
  const RelativePose pose =
      PoseOf(RandomMatrix(*random), random->Uniform(0, 1) * scale * random->UnitVector());
  KernelPose scan = KernelPoseOf(packed_a, packed_b, pose, SlackOf({a, b, pose}));
  const auto limit =
      static_cast<float>(random->Chance(0.5) ? 0 : scale * random->LogUniform(1e-6, 1));
  const BlockScanTask task = {packed_a.tree->blocks(),
                              packed_b.tree->blocks(),
                              scan.triangle_slack,
                              -sphere_tree::kFarDistance,
                              limit,
                              true};
  float lowers[16];
  LeastBeyond beyond;
  std::fill_n(beyond, kLanesOver, sphere_tree::kFarDistance);
  const unsigned within = PlainSpherePairKernel()->triangles(scan, task, beyond, lowers);
  EXPECT_LE(*std::min_element(beyond, beyond + kLanesOver), limit);
  BlockScanTask bounds = task;
  bounds.only_within = false, bounds.limit = sphere_tree::kFarDistance;
  PlainSpherePairKernel()->triangles(scan, bounds, beyond, lowers);
  for (std::uint32_t k = 0; k < 16; ++k) {
    if (k / 4 >= task.a->left || k % 4 >= task.b->left) continue;
    ExactTriangle t, u;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto& mesh_a = a.shape()->mesh();
      const auto& mesh_b = b.shape()->mesh();
      t[corner] =
          ExactVector(mesh_a.vertices[mesh_a.triangles[task.a->element[k / 4].value()][corner]]);
      u[corner] = ExactlyPosed(
          pose,
          ExactVector(mesh_b.vertices[mesh_b.triangles[task.b->element[k % 4].value()][corner]]));
    }
    const Exact square = SquareOfTriangles(t, u);
    ASSERT_LT(lowers[k], sphere_tree::kFarDistance);
    const Exact lower = Exact(lowers[k]);
    EXPECT_TRUE(lower <= 0 || lower * lower <= square) << lowers[k];
    const bool is_beyond = (within >> k & 1) == 0;
    if (is_beyond) {
      EXPECT_GT(square, Exact(limit) * Exact(limit));
    }
    const Exact clear = Exact(4 * double{limit} + 1e-2 * scale);
    counts->touching += square == 0;
    counts->apart += square > clear * clear;
    counts->certain += square > clear * clear && is_beyond;
  }
}

TEST(SpherePairKernel, TrianglesBeyondALimitAreCertainlyBeyond) {
  StrawCounts counts;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double scale = random.Chance(0.3) ? 1e-8 : random.LogUniform(1e-5, 1e5);
    ExpectStrawsCertainlyBeyond(scale, scale, &random, &counts);
  }
  EXPECT_GT(counts.touching, 300);
  EXPECT_GT(counts.apart, 1000);
  EXPECT_GT(counts.certain, 0.99 * counts.apart);
}

// These triangles are so small that products of three lengths lose their digits. The kernel claims
// less about them than about larger ones.
TEST(SpherePairKernel, TrianglesWhoseProductsUnderflowAreCertainlyBeyond) {
  StrawCounts counts;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double scale = random.LogUniform(1e-18, 1e-13);
    ExpectStrawsCertainlyBeyond(scale, scale, &random, &counts);
  }
  EXPECT_GT(counts.touching, 100);
  EXPECT_GT(counts.certain, 0.1 * counts.apart);
}

// The squares of the edges of one of the two triangles underflow, their lengths do not.
TEST(SpherePairKernel, TrianglesBesideSpecksAreCertainlyBeyond) {
  StrawCounts counts;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double scale = random.LogUniform(1e-2, 1e5), speck = random.LogUniform(1e-25, 1e-20);
    ExpectStrawsCertainlyBeyond(speck, scale, &random, &counts);
  }
  EXPECT_GT(counts.apart, 500);
  EXPECT_GT(counts.certain, 0.1 * counts.apart);
}

}  // namespace
}  // namespace collision::narrow_phase
