// Goal:   the filter of all methods loses no agent that may come near, on any processor, and does
//         not let all agents through either.
// Method: random balls of all scales, placed so that many just touch; the truth in exact rational
//         arithmetic; each width of vectors beside the plain loop.
#include "collision_core/broad_phase/filter/sphere_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/exact.h"

namespace collision::broad_phase {
namespace {

constexpr int kScenes = kSanitized ? 40 : 600;
constexpr int kBalls = 37;  // Fills no vector.

struct Ball {
  double p[3], v[3];
  double reach;
};

struct Balls {
  std::vector<float> arrays[10];
  std::vector<Ball> truth;
  FilterView view() const {
    return {arrays[0].data(), arrays[1].data(), arrays[2].data(), arrays[3].data(),
            arrays[4].data(), arrays[5].data(), arrays[6].data(), arrays[7].data(),
            arrays[8].data(), nullptr,          arrays[9].data()};
  }
};

struct Query {
  FilterQuery query;
  FilterRange range;
  Ball query_ball;
};

/// The exact square of the least distance of the centres for u in [first, last].
Exact LeastSquare(const Ball& a, const Ball& b, const Exact& first, const Exact& last) {
  Exact d[3], w[3], away = 0, square = 0;
  for (int i = 0; i < 3; ++i) {
    d[i] = Exact(b.p[i]) - Exact(a.p[i]);
    w[i] = Exact(b.v[i]) - Exact(a.v[i]);
    away += d[i] * w[i];
    square += w[i] * w[i];
  }
  Exact u = first;
  if (square > 0) {
    u = -away / square;
    if (u < first) u = first;
    if (u > last) u = last;
  }
  Exact sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Exact at = d[i] + w[i] * u;
    sum += at * at;
  }
  return sum;
}

/// Enlarges a reach as the filter requires: by a share of itself and of the way.
float WithSlack(double reach, double way) {
  constexpr double kSlack = kFilterSlack;
  return static_cast<float>((reach + kSlack * (reach + way)) * (1 + 0x1p-22)) + kReachLeast;
}

class SphereFilterTest : public testing::Test {
 protected:
  /// Distances, speeds and times of one scale each; every second ball just touches the query_ball,
  /// or just does not, at some time.
  void Draw(int seed, double size_least = 1e-6, double size_most = 1e6) {
    Random random(seed);
    const double size = random.LogUniform(size_least, size_most),
                 time = random.LogUniform(1e-3, 1e3);
    const double speed = random.Chance(0.2) ? 0 : size / time * random.LogUniform(1e-3, 1e3);
    const double first = -time * random.Uniform(0, 1), last = time * random.Uniform(0, 1);
    const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    for (auto& array : balls_.arrays) array.assign(kBalls + kLanesMax, 0);
    balls_.truth.clear();
    Ball& query_ball = query_.query_ball;
    for (int i = 0; i < 3; ++i) {
      query_ball.p[i] = single(random.Uniform(-size, size));
      query_ball.v[i] = single(random.Uniform(-speed, speed));
    }
    query_ball.reach = single(size * random.Uniform(0, 0.5));
    query_.query.first = static_cast<float>(first);
    query_.query.last = static_cast<float>(last);
    query_.query.time = static_cast<float>(last);
    first_ = static_cast<double>(query_.query.first);
    last_ = static_cast<double>(query_.query.last);
    const double reach_time = std::max(std::abs(first_), std::abs(last_));
    const auto speed_of = [](const Ball& ball) {
      return std::sqrt(ball.v[0] * ball.v[0] + ball.v[1] * ball.v[1] + ball.v[2] * ball.v[2]);
    };
    const auto way = [&](const Ball& ball) { return reach_time * speed_of(ball); };
    query_.query.vx = static_cast<float>(query_ball.v[0]);
    query_.query.vy = static_cast<float>(query_ball.v[1]);
    query_.query.vz = static_cast<float>(query_ball.v[2]);
    query_.query.reach = WithSlack(query_ball.reach, way(query_ball));
    query_.query.speed = WithSlack(speed_of(query_ball), 0);
    query_.query.u_max = static_cast<float>(reach_time);
    query_.range = {0, kBalls, static_cast<float>(query_ball.p[0]),
                    static_cast<float>(query_ball.p[1]), static_cast<float>(query_ball.p[2])};
    for (int k = 0; k < kBalls; ++k) {
      Ball ball;
      for (int i = 0; i < 3; ++i) {
        ball.p[i] = single(query_ball.p[i] + random.Uniform(-3 * size, 3 * size));
        ball.v[i] = single(random.Uniform(-speed, speed));
      }
      const double least = std::sqrt(
          static_cast<double>(LeastSquare(query_ball, ball, Exact(first_), Exact(last_))));
      ball.reach = std::max(
          0.0, k % 2 == 0 ? (least - query_ball.reach) * (1 + random.Uniform(-4, 4) * 0x1p-52)
                          : size * random.Uniform(0, 0.5));
      for (int i = 0; i < 3; ++i) {
        balls_.arrays[i][k] = static_cast<float>(ball.p[i]);
        balls_.arrays[3 + i][k] = static_cast<float>(ball.v[i]);
      }
      // The reach is split between radius and growth in any proportion.
      const double share = last_ > 0 ? random.Uniform(0, 1) : 0;
      balls_.arrays[6][k] = WithSlack(ball.reach * (1 - share), way(ball));
      balls_.arrays[9][k] = WithSlack(speed_of(ball), 0);
      if (last_ > 0) balls_.arrays[7][k] = WithSlack(ball.reach * share / last_, 0);
      balls_.truth.push_back(ball);
    }
  }

  std::vector<std::uint32_t> Hits(SphereFilter scan) const {
    std::vector<std::uint32_t> hits(kBalls + kLanesMax);
    const FilterRange ranges[] = {{0, 5, query_.range.x, query_.range.y, query_.range.z},
                                  {5, kBalls, query_.range.x, query_.range.y, query_.range.z}};
    hits.resize(scan(balls_.view(), query_.query, ranges, 2, hits.data()));
    return hits;
  }

  Balls balls_;
  Query query_;
  double first_ = 0, last_ = 0;
};

TEST_F(SphereFilterTest, LosesNoNeighbourAndRulesOutMost) {
  int near = 0, let_through = 0, far = 0;
  for (int seed = 0; seed < kScenes; ++seed) {
    Draw(seed);
    std::vector<bool> hit(kBalls);
    for (const std::uint32_t k : Hits(PlainSphereFilter())) hit[k] = true;
    for (int k = 0; k < kBalls; ++k) {
      const Exact square =
          LeastSquare(query_.query_ball, balls_.truth[k], Exact(first_), Exact(last_));
      const Exact reach = Exact(query_.query_ball.reach) + Exact(balls_.truth[k].reach);
      if (square <= reach * reach) {
        ++near;
        ASSERT_TRUE(hit[k]) << "seed " << seed << ", ball " << k;
      } else if (square > reach * reach * Exact(1.01)) {
        ++far;
        let_through += hit[k];
      }
    }
  }
  EXPECT_GT(near, kBalls * kScenes / 5);
  EXPECT_GT(far, kBalls * kScenes / 5);
  EXPECT_LT(let_through, far / 50);  // A long way costs digits.
}

// Where balls are less than kReachLeast apart, the squares of distances and reaches lose digits, or
// are zero.
TEST_F(SphereFilterTest, LosesNoNeighbourWhoseSquareUnderflows) {
  int near = 0, ruled_out = 0;
  for (int seed = 0; seed < kScenes; ++seed) {
    Draw(seed, 1e-24, 1e-14);
    std::vector<bool> hit(kBalls);
    for (const std::uint32_t k : Hits(PlainSphereFilter())) hit[k] = true;
    for (int k = 0; k < kBalls; ++k) {
      ruled_out += !hit[k];
      const Exact square =
          LeastSquare(query_.query_ball, balls_.truth[k], Exact(first_), Exact(last_));
      const Exact reach = Exact(query_.query_ball.reach) + Exact(balls_.truth[k].reach);
      if (square > reach * reach) continue;
      ++near;
      ASSERT_TRUE(hit[k]) << "seed " << seed << ", ball " << k;
    }
  }
  EXPECT_GT(near, kBalls * kScenes / 5);
  EXPECT_GT(ruled_out, kBalls * kScenes / 20);
}

TEST_F(SphereFilterTest, EveryWidthGivesTheSame) {
  for (int seed = 0; seed < kScenes; ++seed) {
    Draw(seed);
    const std::vector<std::uint32_t> plain = Hits(PlainSphereFilter());
    for (const SphereFilter scan :
         {Avx2SphereFilter(), Avx512SphereFilter(), WidestSphereFilter()}) {
      if (scan != nullptr) {
        ASSERT_EQ(Hits(scan), plain) << "seed " << seed;
      }
    }
  }
}

TEST_F(SphereFilterTest, WhatIsNotANumberIsAHit) {
  Draw(1);
  for (const float value : {INFINITY, -INFINITY, NAN}) {
    balls_.arrays[0].assign(kBalls + kLanesMax, value);
    balls_.arrays[6].assign(kBalls + kLanesMax, INFINITY);
    for (const SphereFilter scan :
         {PlainSphereFilter(), Avx2SphereFilter(), Avx512SphereFilter()}) {
      if (scan != nullptr) {
        EXPECT_EQ(Hits(scan).size(), static_cast<std::size_t>(kBalls));
      }
    }
  }
}

}  // namespace
}  // namespace collision::broad_phase
