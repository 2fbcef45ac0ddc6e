// Goal:   for every loop the first collision of the moving cubes is the same; and the paper's loop
//         made local asks less than the global one.
// Method: the naive loop tests every pair in every frame; the others must name its frame and pair,
//         over several seeds, sizes and densities.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "collision_core/broad_phase/face_sweep/face_sweep.h"
#include "collision_core/broad_phase/index/all_pairs.h"
#include "tests/baselines/global_loop.h"
#include "tests/baselines/local_loop.h"
#include "tests/baselines/time_stepping.h"
#include "tests/baselines/turk_hash.h"
#include "tests/baselines/window_loop.h"

namespace collision::baselines {
namespace {

constexpr std::int64_t kFrames = 600;

struct Outcome {
  FirstCollision first;
  LoopWork work;
};

template <typename Loop, typename... Arguments>
Outcome OutcomeOf(const MovingCubes::Options& options, Arguments... arguments) {
  MovingCubes cubes(options);
  Loop loop(std::move(arguments)...);
  const FirstCollision first = FindFirstCollision(&cubes, kFrames, &loop);
  return {first, loop.work()};
}

class Loops : public testing::TestWithParam<MovingCubes::Options> {};

TEST_P(Loops, FindTheSameFirstCollision) {
  const MovingCubes::Options& options = GetParam();
  const Outcome naive = OutcomeOf<TimeStepping>(options);
  for (const double cell : {1.0, 3.0, 8.0}) {
    EXPECT_EQ(OutcomeOf<TurkHash>(options, cell).first, naive.first) << "cell " << cell;
  }
  EXPECT_EQ(OutcomeOf<GlobalLoop>(options, std::make_unique<broad_phase::AllPairs>()).first,
            naive.first);
  EXPECT_EQ(OutcomeOf<GlobalLoop>(options, std::make_unique<broad_phase::FaceSweep>()).first,
            naive.first);
  EXPECT_EQ(OutcomeOf<LocalLoop>(options, std::make_unique<broad_phase::AllPairs>()).first,
            naive.first);
  EXPECT_EQ(OutcomeOf<WindowLoop>(options, std::make_unique<broad_phase::AllPairs>()).first,
            naive.first);
}

std::vector<MovingCubes::Options> Configurations() {
  std::vector<MovingCubes::Options> all;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const auto& [count, density] :
         {std::pair{2u, 0.05}, {10u, 0.001}, {10u, 0.1}, {60u, 0.001}, {60u, 0.02}}) {
      MovingCubes::Options options;
      options.count = count, options.density = density, options.seed = seed;
      all.push_back(options);
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Seeds, Loops, testing::ValuesIn(Configurations()));

// Cubes that overlapped, or nearly did, part and come back: under strong forces, in every frame,
// not only the first.
TEST(Loops, AgreeInEveryFrameAfterTheFirstCollisionToo) {
  int frames_with_overlap = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    MovingCubes::Options options;
    options.count = seed % 20 == 0 ? 12 : 2, options.density = 0.2, options.seed = seed;
    options.speed_max = 0.2, options.acceleration_max = 60;
    MovingCubes cubes(options);
    TimeStepping naive;
    std::vector<std::unique_ptr<CollisionLoop>> loops;
    loops.push_back(std::make_unique<TurkHash>(2));
    loops.push_back(std::make_unique<GlobalLoop>(std::make_unique<broad_phase::AllPairs>()));
    loops.push_back(std::make_unique<LocalLoop>(std::make_unique<broad_phase::AllPairs>()));
    loops.push_back(std::make_unique<WindowLoop>(std::make_unique<broad_phase::AllPairs>()));
    for (int frame = 0; frame < 150; ++frame, cubes.NextFrame()) {
      const auto expected = naive.Look(cubes);
      frames_with_overlap += expected.has_value();
      for (std::size_t i = 0; i < loops.size(); ++i) {
        ASSERT_EQ(loops[i]->Look(cubes), expected)
            << "loop " << i << ", frame " << frame << ", seed " << seed;
      }
    }
  }
  EXPECT_GT(frames_with_overlap, 100);
}

TEST(Loops, SeeCollisionsAtAll) {
  int found = 0;
  for (const auto& options : Configurations()) {
    found += OutcomeOf<TimeStepping>(options).first.frame > 0;
  }
  // Neither never nor at the start, in most configurations.
  EXPECT_GT(found, 15);
}

// The global loop rebuilds all whenever the first two come near; the local one those two.
TEST(Loops, LocalRebuildsLessThanGlobal) {
  std::uint64_t global = 0, local = 0, naive = 0, window = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    MovingCubes::Options options;
    options.count = 60, options.density = 0.001, options.seed = seed;
    const Outcome of_global =
        OutcomeOf<GlobalLoop>(options, std::make_unique<broad_phase::AllPairs>());
    const Outcome of_local =
        OutcomeOf<LocalLoop>(options, std::make_unique<broad_phase::AllPairs>());
    const Outcome of_window =
        OutcomeOf<WindowLoop>(options, std::make_unique<broad_phase::AllPairs>());
    global += of_global.work.rebuilds, local += of_local.work.rebuilds;
    window += of_window.work.rebuilds;
    naive += OutcomeOf<TimeStepping>(options).work.pair_tests;
    EXPECT_LT(2 * of_local.work.rebuilds, of_global.work.rebuilds) << "seed " << seed;
    EXPECT_LT(10 * of_local.work.pair_tests, naive);
  }
  RecordProperty("rebuilds_global", static_cast<int>(global));
  RecordProperty("rebuilds_local", static_cast<int>(local));
  RecordProperty("rebuilds_window", static_cast<int>(window));
}

}  // namespace
}  // namespace collision::baselines
