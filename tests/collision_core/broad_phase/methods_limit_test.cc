// Goal:   a pair whose canonical time is the query's last instant is found, and reported as near,
//         though that time is early and the exact one lies beyond: filters know how early an answer
//         may be, and what the faces of hypertrapezoids lose by rounding.
// Method: two that graze each other after minutes, or fly side by side a hair apart, among sixty
//         that are far away, so that the grid is taken; each method beside the canonical routine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision_core/numeric/seconds.h"
#include "tests/collision_core/broad_phase/method_scenes.h"

namespace collision::broad_phase {
namespace {

class MethodsAtTheLimit : public testing::TestWithParam<NamedMethod> {
 protected:
  /// Agents 0 and 1, and others that meet no agent.
  void ExpectFound(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b,
                   const intersection::BroadQuery& query) {
    const auto method = GetParam().make();
    method->Set(0, a);
    method->Set(1, b);
    for (std::uint32_t i = 0; i < 60; ++i) {
      motion::SpaceTimeBound far = a;
      far.state.v_WA.setZero();
      far.state.p_WA =
          Eigen::Vector3d(-3000 + 50.0 * (i % 4), 600 + 300.0 * (i / 4 % 4), 300.0 * (i / 16));
      method->Set(2 + i, far);
    }
    const auto found = method->Earliest(query);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->lower, 0u);
    EXPECT_EQ(found->higher, 1u);
    std::vector<NearPair> pairs;
    method->FindNearPairs(query, &pairs);
    EXPECT_EQ(std::count(pairs.begin(), pairs.end(), NearPair{0, 1}), 1);
  }
};

TEST_P(MethodsAtTheLimit, GrazingHorns) {
  Random random(5);
  constexpr double kMinutes = 200;
  const auto on_grid = [](double x) { return std::round(x * 0x1p20) / 0x1p20; };
  int asked = 0;
  for (int trial = 0; trial < 600 && !HasFatalFailure(); ++trial) {
    motion::SpaceTimeBound a;
    a.state.stamp = kMethodStart;
    a.limits.radius = 0.5;
    a.limits.acceleration_max = 0x1p-40;
    motion::SpaceTimeBound b = a;
    for (int axis = 0; axis < 3; ++axis) {
      a.state.p_WA[axis] = on_grid(random.Uniform(-200, -100));
      b.state.p_WA[axis] = on_grid(random.Uniform(100, 200));
      const double meet = (b.state.p_WA[axis] - a.state.p_WA[axis]) / kMinutes;
      a.state.v_WA[axis] = on_grid(meet + random.Uniform(-0.002, 0.002));
    }
    const intersection::BroadQuery ever{intersection::BoundKind::kHorn, kMethodStart,
                                        Instant::Never()};
    const intersection::IntersectionTime time = EarliestIntersectionOf(ever, a, b);
    if (!(time.seconds < 2 * kMinutes)) continue;
    ++asked;
    ExpectFound(a, b, {intersection::BoundKind::kHorn, kMethodStart, time.instant()});
  }
  EXPECT_GT(asked, 100);
}

TEST_P(MethodsAtTheLimit, HypertrapezoidsAHairApart) {
  Random random(6);
  int asked = 0;
  for (int trial = 0; trial < 300 && !HasFatalFailure(); ++trial) {
    const double speed = random.LogUniform(10, 1e4), radius = random.LogUniform(1e-6, 1);
    motion::SpaceTimeBound a;
    a.state.stamp = kMethodStart;
    a.state.v_WA = speed * Eigen::Vector3d(0.3, 0.5, 0.7);
    a.limits.radius = radius;
    motion::SpaceTimeBound b = a;
    b.state.p_WA.setConstant(2 * radius + speed * random.LogUniform(1e-17, 1e-9));
    const intersection::BroadQuery query{intersection::BoundKind::kHypertrapezoid, kMethodStart,
                                         numeric::AddRoundedUp(kMethodStart, 100)};
    if (!(EarliestIntersectionOf(query, a, b).seconds < numeric::kInfinity)) continue;
    ++asked;
    ExpectFound(a, b, query);
  }
  EXPECT_GT(asked, 30);
}

INSTANTIATE_TEST_SUITE_P(All, MethodsAtTheLimit, testing::ValuesIn(kMethods),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace collision::broad_phase
