// Goal:   the time for which two elements stay apart is never late, and that of the pair that
//         touches first is exact where nothing turns.
// Method: cubes that meet face on: 3 m apart at 2 m/s, so that the first two triangles meet at
//         1.5 s; the same with a ball in place of either cube, and with a convex solid.
#include "collision_core/narrow_phase/advancement/swept_elements.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/support/meshes.h"
#include "tests/support/truth/true_distance.h"

namespace collision::narrow_phase {
namespace {

constexpr double kTouch = 1.5, kDuration = 4;
constexpr std::uint32_t kTriangles = 12;

class SweptElementsTest : public testing::Test {
 protected:
  SweptElementsTest() {
    swept_.pose.p_AB = {5, 0.3, -0.4};
    swept_.velocity = {-2, 0, 0};
  }

  /// The least time over all elements, by one query for each.
  using Query = std::function<double(const SweptElements&, ElementIndex)>;
  double Least(const BodySegment& a, const BodySegment& b, const Query& query) {
    const BodyTree tree_a(a), tree_b(b);
    const SweptPair pair{tree_a, tree_b, swept_};
    const PointMotion motion(pair);
    const SweptElements elements(pair, motion, kDuration, &work_);
    double least = numeric::kInfinity;
    for (std::uint32_t i = 0; i < kTriangles; ++i) {
      least = std::min(least, query(elements, ElementIndex(i)));
    }
    return least;
  }

  static void ExpectTouch(double time) {
    EXPECT_LE(time, kTouch);
    EXPECT_GE(time, kTouch - 1e-9);
  }

  const BodySegment cube_ = BodyOf(shape::Shape::Build(Cube(1)));
  const BodySegment ball_ = BodyOf(nullptr, 1);
  SweptPose swept_;
  WorkBudget work_{1'000'000};
};

TEST_F(SweptElementsTest, TwoTrianglesAreExact) {
  ExpectTouch(Least(cube_, cube_, [](const SweptElements& elements, ElementIndex of_a) {
    double least = numeric::kInfinity;
    for (std::uint32_t of_b = 0; of_b < kTriangles; ++of_b) {
      least = std::min(least, elements.ApartFor(ElementPair{of_a, ElementIndex(of_b)}, 0));
    }
    return least;
  }));
}

TEST_F(SweptElementsTest, ABodyThatIsABallIsItsOwnElement) {
  swept_.pose.p_AB = {5, 0.3, -0.4};
  ExpectTouch(Least(cube_, ball_, [](const SweptElements& elements, ElementIndex triangle) {
    return elements.ApartFor(ElementPair{triangle, {}}, 0);
  }));
  ExpectTouch(Least(ball_, cube_, [](const SweptElements& elements, ElementIndex triangle) {
    return elements.ApartFor(ElementPair{{}, triangle}, 0);
  }));
}

TEST_F(SweptElementsTest, ABallBesideATriangleIsFromEitherSideTheSame) {
  const CentredBall of_a{{0, 0, 0}, 1}, of_b{swept_.pose.p_AB, 1};
  ExpectTouch(Least(cube_, cube_, [&](const SweptElements& elements, ElementIndex triangle) {
    return elements.ApartFor(of_a, triangle);
  }));
  ExpectTouch(Least(cube_, cube_, [&](const SweptElements& elements, ElementIndex triangle) {
    return elements.ApartFor(triangle, of_b);
  }));
}

TEST_F(SweptElementsTest, ConvexSolidsAreExact) {
  shape::ConvexDescription box;
  box.core = geometry::ConvexCore::kBox;
  box.half = {1, 1, 1};
  const BodySegment solid =
      BodyOf(shape::Shape::Compound(nullptr, {shape::ConvexSolid::Build(box)}));
  ExpectTouch(Least(solid, cube_, [](const SweptElements& elements, ElementIndex triangle) {
    return elements.ApartFor(ElementPair{{}, triangle}, 0);
  }));
}

TEST_F(SweptElementsTest, UncertaintyOfTheMotionEndsAGapEarlier) {
  swept_.translation = {1, 0, 0};
  const double time = Least(cube_, cube_, [](const SweptElements& elements, ElementIndex of_a) {
    double least = numeric::kInfinity;
    for (std::uint32_t of_b = 0; of_b < kTriangles; ++of_b) {
      least = std::min(least, elements.ApartFor(ElementPair{of_a, ElementIndex(of_b)}, 0));
    }
    return least;
  });
  EXPECT_LE(time, 1.0);
  EXPECT_GE(time, 1.0 - 1e-9);
}

}  // namespace
}  // namespace collision::narrow_phase
