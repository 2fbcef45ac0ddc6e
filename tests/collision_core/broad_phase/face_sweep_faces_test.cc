#include <gtest/gtest.h>

#include "collision_core/broad_phase/face_sweep/face_sweep_start.h"
#include "collision_core/broad_phase/face_sweep/face_sweep_window.h"
#include "collision_core/motion/hypertrapezoid.h"
#include "tests/collision_core/broad_phase/face_sweep_scenes.h"
#include "tests/support/truth/exact_bound.h"

namespace collision::broad_phase {
namespace {

constexpr int kBounds = 300;

motion::SpaceTimeBound RandomBound(Random* random) {
  const double scale = random->LogUniform(1e-6, 1e9);
  motion::SpaceTimeBound bound =
      Agent(RandomVector(random, scale), random->Uniform(-9, 9) * Eigen::Vector3d(2, 3, 6),
            random->Uniform(0, 1), random->Chance(0.3) ? 0 : scale);
  bound.state.position_error = random->Uniform(0, 1);
  bound.state.velocity_error = random->Uniform(0, 1);
  bound.limits.time_step = random->Uniform(0, 1);
  return bound;
}

/// What the padding is a part of, but for the way from the stamp, which the faces make up for.
Exact Magnitude(const motion::SpaceTimeBound& bound, const FaceLines& lines) {
  Exact magnitude = 0;
  for (int face = 0; face < 6; ++face) {
    magnitude += abs(Exact(lines.start[face])) + abs(Exact(lines.end[face]));
    magnitude += abs(Exact(bound.state.p_WA[face % 3]));
  }
  return magnitude;
}

// Goal:   faces contain the horn wherever it counts, also where the stamp lies inside the window,
//         and are no boxes turned inside out; where it does not lie inside, they touch the horn at
//         both ends, up to the padding.
// Method: exact rational arithmetic, at the ends and between; clocks of 1970, windows of 1 ns to
//         hours.
TEST(FaceLines, ContainTheHorn) {
  Random random(3);
  for (int i = 0; i < kBounds; ++i) {
    const motion::SpaceTimeBound bound = RandomBound(&random);
    const auto length = static_cast<std::int64_t>(random.LogUniform(1, 1e13));
    const std::int64_t start = 1'700'000'000 * kSecond;
    const std::int64_t late = random.Chance(0.5) ? random.Below(length + 1) : 0;
    motion::SpaceTimeBound moved = bound;
    moved.state.stamp = At(late > 0 ? start + late : start - random.Below(length));
    const Instant counts_from = std::max(moved.state.stamp, At(start));
    const FaceLines lines = *FaceLinesOf(moved, At(start), At(start + length));
    const ExactHorn horn(moved, counts_from);
    for (int part = 0; part <= 4; ++part) {
      const Exact t = Exact(late) + Exact(length - late) * Exact(part) / 4;  // From the start, ns.
      const Exact fraction = t / Exact(length), delta = (t - Exact(late)) / Exact(kSecond);
      const Exact reach = Exact(moved.limits.radius) + Evaluate(horn.u, delta);
      for (int axis = 0; axis < 3; ++axis) {
        const Exact centre = horn.p[axis] + horn.v[axis] * delta;
        const auto line = [&](int face) {
          return Exact(lines.start[face]) * (1 - fraction) + Exact(lines.end[face]) * fraction;
        };
        EXPECT_LE(line(axis), centre - reach);
        EXPECT_GE(line(axis + 3), centre + reach);
        EXPECT_LE(lines.start[axis], lines.start[axis + 3]);
        if (late > 0 || part % 4 != 0) continue;
        EXPECT_GE(line(axis), centre - reach - Magnitude(moved, lines) * Exact(0x1p-42));
        EXPECT_LE(line(axis + 3), centre + reach + Magnitude(moved, lines) * Exact(0x1p-42));
      }
    }
  }
}

TEST(FaceLines, NotFiniteIsNone) {
  EXPECT_FALSE(FaceLinesOf(Agent({0, 0, 0}, {1e308, 0, 0}, 1), At(0), At(100 * kSecond)));
  EXPECT_FALSE(FaceLinesOf(Agent({0, 0, 0}, {0, 0, 0}, numeric::kInfinity), At(0), At(kSecond)));
  EXPECT_FALSE(FaceLinesOf(Agent({0, 0, 0}, {0, 0, 0}, 1, 1e308), At(0), At(100 * kSecond)));
}

/// All pairs of slots that FaceSweepStart tells, with a ceiling that never comes down.
std::vector<std::pair<std::uint32_t, std::uint32_t>> ReportedPairs(const AlphaTFaces& faces) {
  std::array<CrossingOrder, 3> orders;
  for (int axis = 0; axis < 3; ++axis) orders[axis].Start(faces.faces(axis));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> reported;
  FaceSweepStart().ForEach({&orders[0].faces(), &orders[1].faces(), &orders[2].faces()}, ~0u,
                           [&](std::uint32_t lower, std::uint32_t higher) {
                             reported.emplace_back(lower, higher);
                             return ~0u;
                           });
  std::sort(reported.begin(), reported.end());
  return reported;
}

// Goal:   exactly the pairs that overlap at the start are reported, each once.
// Method: against all pairs, in metres with room for the padding, over every layout: boxes in many
//         strips, all in one, some across all.
TEST(FaceSweepStart, TellsEachOverlapOnce) {
  for (int layout = 0; layout < kLayouts; ++layout) {
    Random random(40 + layout);
    BoundList bounds;
    std::vector<std::uint32_t> agents;
    for (motion::SpaceTimeBound& bound : LayOut(static_cast<SweepLayout>(layout), 400, &random)) {
      agents.push_back(static_cast<std::uint32_t>(bounds.size()));
      bounds.emplace_back(bound);
    }
    AlphaTFaces faces;
    faces.Build(bounds, agents, At(0), At(kSecond));
    const auto reported = ReportedPairs(faces);
    EXPECT_EQ(reported.end(), std::adjacent_find(reported.begin(), reported.end()));
    std::size_t expected = 0;
    for (std::uint32_t a = 0; a < faces.agents().size(); ++a) {
      for (std::uint32_t b = a + 1; b < faces.agents().size(); ++b) {
        const motion::Hypertrapezoid h_A =
            MakeHypertrapezoid(bounds[faces.agents()[a]]->bound, At(0), At(0));
        const motion::Hypertrapezoid h_B =
            MakeHypertrapezoid(bounds[faces.agents()[b]]->bound, At(0), At(0));
        if (FirstOverlap(h_A, h_B) > 0) continue;
        ++expected;
        EXPECT_TRUE(std::binary_search(reported.begin(), reported.end(), std::pair(a, b)));
      }
    }
    // Pairs that touch within the grid's unit are reported as well.
    EXPECT_TRUE(layout != static_cast<int>(SweepLayout::kUniform) || expected == reported.size());
    EXPECT_GT(expected, 0u);
  }
}

// Goal:   a horn's first window fits the scene, and follows its bounds alone.
// Method: spheres of 1 m in a heap, M = 1 m/s²: ½ M w² = ½ m at one second. No motion: no limit.
TEST(FirstWindow, FitsTheScene) {
  BoundList bounds(100, Agent({1, 1, 1}, {0, 0, 0}, 1, 1));
  std::vector<std::uint32_t> agents(100);
  for (std::uint32_t i = 0; i < 100; ++i) agents[i] = i;
  EXPECT_EQ(kSecond, FirstWindow(bounds, agents));
  for (int i = 0; i < 10; ++i) bounds[i] = Agent({1e9, 1e9, 1e9}, {1e9, 0, 0}, 1e9, 1e18);
  EXPECT_EQ(kSecond, FirstWindow(bounds, agents)) << "a few do not decide";
  bounds.assign(100, Agent({1, 1, 1}, {5, 0, 0}, 1));
  EXPECT_GT(FirstWindow(bounds, agents), kCentury) << "a convoy stands still";
  bounds.assign(100, Agent({1, 1, 1}, {0, 0, 0}, 0, 1));
  EXPECT_EQ(1, FirstWindow(bounds, agents));
}

// Goal:   the sweep goes on for as long as a canonical time may be early: 1e-9 of the way.
// Method: the least instant that may still be reported as `time`, from nanoseconds to centuries.
TEST(WithEarliness, CoversTheCanonicalTolerance) {
  Random random(6);
  for (int i = 0; i < kBounds; ++i) {
    const Instant first = At(1'700'000'000 * kSecond + random.Below(kSecond));
    const auto way = static_cast<std::int64_t>(random.LogUniform(1, 7e18));
    const Instant time = At(first.nanoseconds() + way), last = WithEarliness(first, time);
    EXPECT_GT(Exact(last.nanoseconds()) - (Exact(way) + 1) * Exact(1e-9),
              Exact(time.nanoseconds()) + 1);
    EXPECT_LT(Exact(last.nanoseconds()), Exact(time.nanoseconds()) + Exact(way) * Exact(2e-9) + 5);
  }
  EXPECT_FALSE(WithEarliness(At(0), Instant::Never()).is_never());
}

}  // namespace
}  // namespace collision::broad_phase
