// Goal:   the grid finds every two points within reach of each other, each once, and few others; it
//         says so where points do not suit it. Every width of vectors gives the same.
// Method: points of all scales and shapes, many pairs placed to just touch; the truth in exact
//         rational arithmetic for those that are near the edge.
#include "collision_core/broad_phase/filter/point_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "collision_core/broad_phase/filter/sphere_filter.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact.h"

namespace collision::broad_phase {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

bool Touch(const ReachPoint& a, const ReachPoint& b) {
  Exact square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Exact d = Exact(b.c[axis]) - Exact(a.c[axis]);
    square += d * d;
  }
  const Exact reach = Exact(static_cast<double>(a.reach)) + Exact(static_cast<double>(b.reach));
  return square <= reach * reach;
}

double Gap(const ReachPoint& a, const ReachPoint& b) {
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) square += (b.c[axis] - a.c[axis]) * (b.c[axis] - a.c[axis]);
  return std::sqrt(square) - static_cast<double>(a.reach) - static_cast<double>(b.reach);
}

/// Evenly in a box with the sides given in units of `size`, around `middle`; half of them just
/// touching the one before.
std::vector<ReachPoint> Draw(Random* random, std::uint32_t count, const double* sides, double size,
                             double middle) {
  std::vector<ReachPoint> points(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    ReachPoint& point = points[k];
    point.reach = static_cast<float>(size * random->Uniform(0.3, 1));
    for (int axis = 0; axis < 3; ++axis) {
      point.c[axis] = middle + size * sides[axis] * random->Uniform(-0.5, 0.5);
    }
    if (k == 0 || random->Chance(0.5)) continue;
    const Eigen::Vector3d away = random->UnitVector();
    const double apart =
        (static_cast<double>(point.reach) + static_cast<double>(points[k - 1].reach)) *
        (1 + random->Uniform(-4, 4) * 0x1p-52);
    for (int axis = 0; axis < 3; ++axis) {
      if (sides[axis] > 0) point.c[axis] = points[k - 1].c[axis] + away[axis] * apart;
    }
  }
  return points;
}

bool Build(const std::vector<ReachPoint>& points, PointGrid* grid) {
  const auto at = [&](std::uint32_t k, ReachPoint* point) {
    *point = points[k];
    return true;
  };
  const auto count = static_cast<std::uint32_t>(points.size());
  return grid->Build(count, count, 0, at);
}

std::vector<Pair> PairsOf(PointGrid* grid) {
  std::vector<Pair> pairs;
  grid->ForEachPair([&](std::uint32_t k, std::uint32_t l) { pairs.push_back(std::minmax(k, l)); });
  return pairs;
}

TEST(PointGrid, FindsEachTouchingPairOnceAndFewOthers) {
  constexpr double kShapes[][3] = {
      {40, 40, 40}, {400, 6, 6},  {6, 400, 6}, {6, 6, 400}, {90, 90, 0},
      {0, 0, 2000}, {2000, 0, 0}, {3, 3, 3},   {0, 0, 0},
  };
  PointGrid grid;
  std::size_t touching = 0, others = 0, built = 0, all = 0;
  for (int seed = 0; seed < 90; ++seed) {
    Random random(seed);
    const double size = random.LogUniform(1e-9, 1e9);
    const double middle = size * random.Uniform(-1, 1) * (seed % 3 == 0 ? 0 : 1e6);
    const auto count = static_cast<std::uint32_t>(seed < 20 ? 1 + seed * 7 : 700);
    const auto points = Draw(&random, count, kShapes[seed % std::size(kShapes)], size, middle);
    ++all;
    if (!Build(points, &grid)) continue;
    ++built;
    const std::vector<Pair> pairs = PairsOf(&grid);
    const std::set<Pair> found(pairs.begin(), pairs.end());
    ASSERT_EQ(found.size(), pairs.size()) << "a pair twice, seed " << seed;
    for (std::uint32_t k = 0; k < count; ++k) {
      for (std::uint32_t l = k + 1; l < count; ++l) {
        const double gap = Gap(points[k], points[l]);
        if (gap > 1e-3 * size) continue;
        if (!Touch(points[k], points[l])) continue;
        ++touching;
        ASSERT_TRUE(found.contains({k, l})) << "seed " << seed << ": " << k << ", " << l;
      }
    }
    for (const auto& [k, l] : pairs) ASSERT_NE(k, l);
    for (const auto& [k, l] : pairs) others += Gap(points[k], points[l]) > 0.02 * size;
  }
  EXPECT_GT(touching, 10'000u);
  EXPECT_LT(others, touching / 20);
  EXPECT_GT(built, all * 2 / 3);
}

// So close together that reaches decide how wide a cell is.
TEST(PointGrid, FindsAllInADenseBox) {
  Random random(3);
  std::vector<ReachPoint> points(6000);
  for (ReachPoint& point : points) {
    for (double& c : point.c) c = random.Uniform(0, 20);
    point.reach = 1;
  }
  PointGrid grid;
  ASSERT_TRUE(Build(points, &grid));
  std::size_t touching = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t l = k + 1; l < points.size(); ++l) {
      touching += Gap(points[k], points[l]) <= 0;
    }
  }
  std::size_t found = 0;
  for (const auto& [k, l] : PairsOf(&grid)) found += Gap(points[k], points[l]) <= 0;
  EXPECT_EQ(found, touching);
}

TEST(PointGrid, RefusesCrowds) {
  PointGrid grid;
  Random random(5);
  std::vector<ReachPoint> points(2000);
  for (std::size_t k = 0; k < points.size(); ++k) {
    // Two clusters, far apart.
    for (double& c : points[k].c) c = random.Uniform(0, 1) + (k % 2 == 0 ? 1e5 : 0);
    points[k].reach = 0.01f;
  }
  EXPECT_FALSE(Build(points, &grid));
  points.resize(30);  // So few are in one cell.
  ASSERT_TRUE(Build(points, &grid));
  EXPECT_LT(PairsOf(&grid).size(), 300u);  // A wide row costs digits.
}

// Part of a scene: absent agents give no pairs, and an agent beyond the sampled ones, or with a
// larger reach, is found as well.
TEST(PointGrid, FindsAgentsBeyondTheSampleAndNoAbsentOnes) {
  constexpr std::uint32_t kCount = 9000;  // Every third is sampled.
  constexpr double kSides[] = {40, 40, 40};
  for (const double odd_one : {0.0, 30.0, -30.0, 1e4}) {
    Random random(7);
    auto points = Draw(&random, kCount, kSides, 1, 5);
    const auto is_there = [](std::uint32_t k) { return k % 7 != 1; };
    for (std::uint32_t k = 1000; k < 1020; ++k) {
      if (k % 3 != 0) points[k].c[1] += odd_one;
    }
    if (odd_one < 0) points[1001].reach = 1.6f;
    const auto at = [&](std::uint32_t k, ReachPoint* point) {
      *point = points[k];
      return is_there(k);
    };
    PointGrid grid;
    // So far away they make the grid too wide.
    ASSERT_EQ(grid.Build(kCount, kCount, 0, at), odd_one < 1e4);
    if (odd_one == 1e4) continue;
    std::set<Pair> touching, truth;
    for (const auto& [k, l] : PairsOf(&grid)) {
      ASSERT_TRUE(is_there(k) && is_there(l));
      if (Gap(points[k], points[l]) <= 0) touching.insert({k, l});
    }
    for (std::uint32_t k = 0; k < kCount; ++k) {
      for (std::uint32_t l = k + 1; l < kCount; ++l) {
        const bool there = is_there(k) && is_there(l);
        if (there && Gap(points[k], points[l]) <= 0) truth.insert({k, l});
      }
    }
    EXPECT_GT(truth.size(), 1000u);
    EXPECT_EQ(touching, truth);
  }
}

// Two that pass each other within `own`, at any time within the half, are found; of those whose
// places are near, but whose lines are not, few.
TEST(PointGrid, ComparesLinesWhereAsked) {
  Random random(8);
  constexpr double kHalf = 0.5;
  std::vector<ReachPoint> points(4000);
  for (ReachPoint& point : points) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      point.c[axis] = random.Uniform(0, 40);
      point.v[axis] = static_cast<float>(random.Uniform(-3, 3));
      square += static_cast<double>(point.v[axis]) * static_cast<double>(point.v[axis]);
    }
    constexpr double kUp = 1 + 2 * static_cast<double>(kFilterSlack);
    const double own = random.Uniform(0.1, 0.4), way = kHalf * std::sqrt(square);
    point.own = static_cast<float>(own * kUp + static_cast<double>(kFilterSlack) * way);
    point.reach = static_cast<float>((own + way) * kUp);
  }
  const auto at = [&](std::uint32_t k, ReachPoint* point) {
    *point = points[k];
    return true;
  };
  PointGrid places, lines;
  ASSERT_TRUE(places.Build(4000, 4000, 0, at));
  ASSERT_TRUE(lines.Build(4000, 4000, kHalf, at));
  const std::vector<Pair> reported = PairsOf(&lines);
  const std::set<Pair> found(reported.begin(), reported.end());
  ASSERT_EQ(found.size(), reported.size());
  std::size_t meet = 0;
  for (std::uint32_t k = 0; k < 4000; ++k) {
    for (std::uint32_t l = k + 1; l < 4000; ++l) {
      double away = 0, speed = 0, square = 0;
      double d[3], w[3];
      for (int axis = 0; axis < 3; ++axis) {
        d[axis] = points[l].c[axis] - points[k].c[axis];
        w[axis] = static_cast<double>(points[l].v[axis]) - static_cast<double>(points[k].v[axis]);
        away += d[axis] * w[axis], speed += w[axis] * w[axis];
      }
      const double u = std::clamp(-away / speed, -kHalf, kHalf);
      for (int axis = 0; axis < 3; ++axis) square += std::pow(d[axis] + w[axis] * u, 2);
      constexpr double kDown = 1 - 2 * static_cast<double>(kFilterSlack);
      const double own = static_cast<double>(points[k].own) + static_cast<double>(points[l].own);
      const double slack = static_cast<double>(kFilterSlack) * kHalf * std::sqrt(speed);
      if (std::sqrt(square) > own * kDown - 2 * slack) continue;
      ++meet;
      ASSERT_TRUE(found.contains({k, l})) << k << ", " << l;
    }
  }
  EXPECT_GT(meet, 400u);
  EXPECT_LT(found.size(), meet + meet / 50);
  EXPECT_GT(PairsOf(&places).size(), 3 * found.size());
}

TEST(PointGrid, EveryWidthGivesTheSame) {
  Random random(9);
  constexpr std::uint32_t kCount = 61;
  std::size_t reported = 0, tested = 0;
  std::vector<float> arrays[8];
  for (auto& array : arrays) {
    array.resize(kCount + kLanesMax);
    for (float& value : array) value = static_cast<float>(random.Uniform(-1, 1));
  }
  for (const int reach : {3, 7}) {
    for (float& value : arrays[reach]) value = 0.3f + 0.2f * value;
  }
  arrays[0][7] = INFINITY, arrays[3][7] = INFINITY, arrays[1][9] = NAN, arrays[5][11] = NAN;
  const PointView places{arrays[0].data(), arrays[1].data(), arrays[2].data(), arrays[3].data()};
  PointView lines = places;
  lines.vx = arrays[4].data(), lines.vy = arrays[5].data(), lines.vz = arrays[6].data();
  lines.own = arrays[7].data();
  for (int trial = 0; trial < 200; ++trial) {
    const PointView& view = trial % 2 == 0 ? places : lines;
    // One to eight queries; rows of any length in any place.
    const auto first = static_cast<std::uint32_t>(random.Below(30));
    const QueryPoints asked{first,
                            first + 1 + static_cast<std::uint32_t>(trial / 2 % kQueryPointsMax),
                            0.7f, 0.5f, 0.4f};
    std::vector<PointRow> rows;
    for (int row = 0; row < 5; ++row) {
      const auto begin = static_cast<std::uint32_t>(random.Below(kCount - 1));
      const auto end = begin + 1 + static_cast<std::uint32_t>(random.Below(kCount - 1 - begin));
      rows.push_back({begin, end, row % 3 - 1, row % 2});
    }
    const auto hits_of = [&](PointFilter scan) {
      std::vector<std::uint32_t> queries(kQueryPointsMax * 5 * kCount + kLanesMax), others(queries);
      const PointCounts counts = scan(view, asked, rows.data(), 5, {queries.data(), others.data()});
      std::vector<Pair> hits = {{counts.tests, counts.ranges}};
      for (std::uint32_t k = 0; k < counts.hits; ++k) hits.push_back({queries[k], others[k]});
      return hits;
    };
    const auto plain = hits_of(PlainPointFilter());
    reported += plain.size() - 1, tested += plain[0].first;
    for (const PointFilter scan : {Avx2PointFilter(), Avx512PointFilter(), WidestPointFilter()}) {
      if (scan != nullptr) {
        ASSERT_EQ(hits_of(scan), plain) << "trial " << trial;
      }
    }
  }
  EXPECT_GT(reported, 1000u);
  EXPECT_LT(reported, tested / 2);
}

}  // namespace
}  // namespace collision::broad_phase
