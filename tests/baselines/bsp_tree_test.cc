// Goal:   Hubbard's exact comparison is a fair baseline: it says of two solids what is certain.
// Method: solids whose answer is known, and random poses of small closed meshes, of which our
// certified decision says the same wherever it decides; both answers occur often.
#include "tests/baselines/bsp_tree.h"

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/separation/separation.h"
#include "tests/support/meshes.h"
#include "tests/support/random_rotation.h"

namespace collision::baselines {
namespace {

const Eigen::Matrix3d kUpright = Eigen::Matrix3d::Identity();

bool Meet(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b,
          const Eigen::Vector3d& offset) {
  return BspTree::Intersect(BspTree(a), BspTree(b), kUpright, offset);
}

narrow_phase::BodySegment BodyOf(const geometry::TriangleMesh& mesh) {
  narrow_phase::BodySegment body;
  body.shape = shape::Shape::Build(mesh);
  return body;
}

TEST(BspTree, CubesMeetWhereTheirSidesDo) {
  EXPECT_TRUE(Meet(Cube(0.5), Cube(0.5), {0.999, 0.1, 0.2}));
  EXPECT_FALSE(Meet(Cube(0.5), Cube(0.5), {1.001, 0.1, 0.2}));
  EXPECT_TRUE(Meet(Cube(0.5), Cube(0.5), {0.999, 0.999, 0.999}));
  EXPECT_FALSE(Meet(Cube(0.5), Cube(0.5), {0.999, 0.999, 1.001}));
}

TEST(BspTree, OneInsideTheOtherMeetsIt) {
  EXPECT_TRUE(Meet(Cube(1), Cube(0.1), {0.3, 0.2, 0.1}));
  EXPECT_TRUE(Meet(Cube(0.1), Cube(1), {0.3, 0.2, 0.1}));
}

TEST(BspTree, AHoleIsOutside) {
  EXPECT_FALSE(Meet(HollowCube(1, 0.5), Cube(0.2), {0.1, 0, 0}));
  EXPECT_TRUE(Meet(HollowCube(1, 0.5), Cube(0.2), {0.4, 0, 0}));
  EXPECT_FALSE(Meet(Frame(), Rod(3, 0.5), {0, 0, 5}));
  EXPECT_FALSE(Meet(Frame(), Box({-0.5, -0.5, -5}, {0.5, 0.5, 5}), {0.4, 0.4, 0}));
  EXPECT_TRUE(Meet(Frame(), Box({-0.5, -0.5, -5}, {0.5, 0.5, 5}), {0.6, 0.4, 0}));
}

TEST(BspTree, TheNotchOfAnLIsOutside) {
  EXPECT_FALSE(Meet(LShape(), Cube(0.2), {0.5, 0.5, 0}));
  EXPECT_TRUE(Meet(LShape(), Cube(0.2), {0.5, -0.5, 0}));
  EXPECT_TRUE(Meet(LShape(), Cube(0.2), {0.5, 0.1, 0}));
}

TEST(BspTree, SaysWhatIsCertain) {
  Random random(11);
  const geometry::TriangleMesh meshes[] = {Cube(0.7), Tetrahedron(0.8), LShape(), Frame(),
                                           Star(2, random)};
  int touching = 0, apart = 0;
  for (const geometry::TriangleMesh& mesh_a : meshes) {
    for (const geometry::TriangleMesh& mesh_b : meshes) {
      const BspTree tree_a(mesh_a), tree_b(mesh_b);
      const narrow_phase::BodySegment body_a = BodyOf(mesh_a), body_b = BodyOf(mesh_b);
      for (int i = 0; i < 40; ++i) {
        const Eigen::Matrix3d rotation = RandomRotation(random);
        const Eigen::Vector3d offset = random.Uniform(0, 4) * random.UnitVector();
        WorkBudget work(100'000'000);
        const narrow_phase::Verdict verdict =
            narrow_phase::DecideAt({narrow_phase::BodyTree(body_a), narrow_phase::BodyTree(body_b),
                                    narrow_phase::PoseOf(rotation, offset)},
                                   &work)
                .verdict;
        if (verdict == narrow_phase::Verdict::kUndecided) continue;
        const bool touches = verdict == narrow_phase::Verdict::kTouching;
        ++(touches ? touching : apart);
        EXPECT_EQ(BspTree::Intersect(tree_a, tree_b, rotation, offset), touches)
            << "offset " << offset.transpose() << ", pose " << i;
      }
    }
  }
  EXPECT_GT(touching, 200);
  EXPECT_GT(apart, 200);
}

}  // namespace
}  // namespace collision::baselines
