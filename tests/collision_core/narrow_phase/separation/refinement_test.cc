// Goal:   many searches share one budget: it is kept, nothing starves, what is left coarse is
//         named, brackets only become narrower, and with all the work they ask for they are those
//         of looks alone.
// Method: random pairs of spiky surfaces, one of which can never be decided; both orders, beside
//         looks alone.
#include "collision_core/narrow_phase/separation/refinement.h"

#include <gtest/gtest.h>

#include "tests/collision_core/narrow_phase/posed_body.h"

namespace collision::narrow_phase {
namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 40;
constexpr BracketTolerance kNarrow = {0, 1e-6};

class RefinementScene {
 protected:
  RefinementScene() {
    Random random(7);
    for (int i = 0; i < 12; ++i) {
      BodySegment segment;
      segment.shape = shape::Shape::Build(Star(3, random));
      segments_.push_back(segment);
    }
    for (const BodySegment& segment : segments_) surfaces_.emplace_back(segment);
    for (std::size_t i = 0; i < 30; ++i) {
      poses_.push_back(
          PoseOf(Eigen::Matrix3d::Identity(), random.Uniform(1.5, 4) * random.UnitVector()));
    }
  }

  const BodyTree& a(std::size_t pair) const { return surfaces_[pair % surfaces_.size()]; }
  const BodyTree& b(std::size_t pair) const { return surfaces_[(pair / 2 + 3) % surfaces_.size()]; }

  void AddAll(Refinement* refinement, WorkBudget* work) const {
    for (std::size_t pair = 0; pair < poses_.size(); ++pair) {
      refinement->Add({a(pair), b(pair), poses_[pair]}, 1, Goal::kDecision, kNarrow, work);
    }
  }

  std::vector<BodySegment> segments_;
  std::vector<BodyTree> surfaces_;
  std::vector<RelativePose> poses_;
};

class RefinementTest : public RefinementScene, public testing::TestWithParam<RefinementOrder> {};
class RefinementOrders : public RefinementScene, public testing::Test {};

TEST_P(RefinementTest, KeepsTheBudgetAndOnlyNarrows) {
  std::uint64_t most = 0;
  Refinement refinement(GetParam());
  WorkBudget start(1);
  AddAll(&refinement, &start);
  EXPECT_EQ(start.spent(), poses_.size());
  double total = refinement.TotalWidth();
  std::vector<RefinedPair> last;
  for (std::size_t pair = 0; pair < poses_.size(); ++pair) last.push_back(refinement.At(pair));
  for (std::uint64_t turn = 0; !refinement.Coarse().empty(); ++turn) {
    const std::uint64_t allowed = 1 + 37 * (turn % 40);
    WorkBudget work(allowed);
    refinement.Refine(&work);
    EXPECT_LE(work.spent(), allowed + kBatchUnits - 1);
    if (work.spent() > allowed) most = std::max(most, work.spent() - allowed);
    EXPECT_LE(refinement.TotalWidth(), total);
    total = refinement.TotalWidth();
    for (std::size_t pair = 0; pair < poses_.size(); ++pair) {
      const RefinedPair now = refinement.At(pair);
      EXPECT_GE(now.lower, last[pair].lower);
      EXPECT_LE(now.upper, last[pair].upper);
      last[pair] = now;
    }
  }
  EXPECT_GT(most, 0u);
}

TEST_P(RefinementTest, WithAllTheWorkItIsTheLookAlone) {
  Refinement refinement(GetParam());
  WorkBudget work(kUnlimited);
  AddAll(&refinement, &work);
  refinement.Refine(&work);
  EXPECT_TRUE(refinement.Coarse().empty());
  std::uint64_t alone = 0;
  for (std::size_t pair = 0; pair < poses_.size(); ++pair) {
    SeparationSearch search({a(pair), b(pair), poses_[pair]}, Goal::kDecision, kNarrow,
                            SearchOrder::kNearest);
    WorkBudget own(kUnlimited);
    search.Start(&own);
    search.Refine(&own);
    alone += own.spent();
    EXPECT_EQ(refinement.At(pair).spent, own.spent());
    const SeparationBracket x = refinement.Result(pair), y = search.Result();
    EXPECT_EQ(x.lower, y.lower);
    EXPECT_EQ(x.upper, y.upper);
    EXPECT_EQ(x.point, y.point);
  }
  EXPECT_EQ(work.spent(), alone);
}

TEST_P(RefinementTest, SameBudgetSameBits) {
  const auto run = [&] {
    Refinement refinement(GetParam());
    WorkBudget work(3000);
    AddAll(&refinement, &work);
    refinement.Refine(&work);
    std::vector<double> all;
    for (std::size_t pair = 0; pair < poses_.size(); ++pair) {
      all.push_back(refinement.At(pair).lower), all.push_back(refinement.At(pair).upper);
    }
    return all;
  };
  EXPECT_EQ(run(), run());
}

// Two sheets in one plane touch everywhere and cross nowhere: that costs all there is and is never
// decided. It is the most important pair, and has the widest bracket.
TEST_P(RefinementTest, NothingStarves) {
  BodySegment sheet;
  sheet.shape = shape::Shape::Build(Sheet(50, 60));
  const BodyTree flat(sheet);
  Refinement refinement(GetParam());
  WorkBudget work(kUnlimited);
  refinement.Add({flat, flat, PoseOf(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.5, 0.25, 0))},
                 8, Goal::kDecision, kNarrow, &work);
  AddAll(&refinement, &work);
  std::uint64_t needed = 0;
  for (std::size_t pair = 0; pair < poses_.size(); ++pair) {
    SeparationSearch search({a(pair), b(pair), poses_[pair]}, Goal::kDecision, kNarrow,
                            SearchOrder::kNearest);
    WorkBudget own(kUnlimited);
    search.Start(&own);
    search.Refine(&own);
    needed += own.spent();
  }
  // In a round it has eight times what any other may have; rounds that double make that sixteen.
  WorkBudget budget(8 * needed);
  refinement.Refine(&budget);
  const std::vector<std::size_t> coarse = refinement.Coarse();
  EXPECT_EQ(coarse, std::vector<std::size_t>{0});
}

INSTANTIATE_TEST_SUITE_P(Orders, RefinementTest,
                         testing::Values(RefinementOrder::kLevelByLevel,
                                         RefinementOrder::kLargestFirst));

// Goal:   what the two orders are good for. Largest first has the least total width at every budget
//         but the smallest; level by level leaves no pair far behind.
// Method: the same pairs and budgets for both.
TEST_F(RefinementOrders, LargestFirstIsTheNarrowerInTotal) {
  int narrower = 0, budgets = 0;
  for (std::uint64_t allowed = 300; allowed <= 20000; allowed *= 2) {
    double total[2];
    for (const auto order : {RefinementOrder::kLevelByLevel, RefinementOrder::kLargestFirst}) {
      Refinement refinement(order);
      WorkBudget work(allowed);
      AddAll(&refinement, &work);
      refinement.Refine(&work);
      total[static_cast<std::size_t>(order)] = refinement.TotalWidth();
    }
    ++budgets;
    narrower += total[1] <= total[0];
    RecordProperty(("level_by_level_" + std::to_string(allowed)).c_str(), std::to_string(total[0]));
    RecordProperty(("largest_first_" + std::to_string(allowed)).c_str(), std::to_string(total[1]));
  }
  EXPECT_GE(2 * narrower, budgets);
}

}  // namespace
}  // namespace collision::narrow_phase
