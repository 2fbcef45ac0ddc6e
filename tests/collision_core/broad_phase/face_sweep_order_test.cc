#include <gtest/gtest.h>

#include <map>
#include <set>

#include "collision_core/broad_phase/face_sweep/crossing_order.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"

namespace collision::broad_phase {
namespace {

constexpr int kRounds = kSanitized ? 100 : 2000;

std::int64_t WholeWithin(std::int64_t extent, Random* random) {
  return static_cast<std::int64_t>(random->Below(2 * extent + 1)) - extent;
}

std::vector<AlphaTFace> RandomFaces(int count, std::int64_t extent, Random* random) {
  std::vector<AlphaTFace> faces;
  for (int i = 0; i < count; ++i) {
    const std::int64_t start = WholeWithin(extent, random);
    faces.push_back({start, WholeWithin(extent, random), static_cast<std::uint32_t>(i)});
  }
  return faces;
}

/// The face's coordinate at a tick, times kTicks: a whole number.
__int128 Scaled(const AlphaTFace& face, std::uint32_t tick) {
  return static_cast<__int128>(face.start) * (CrossingOrder::kTicks - tick) +
         static_cast<__int128>(face.end) * tick;
}

/// Each pair that changes places, lower name first, with the first tick at which it has.
using Crossings = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

/// From the definition, by bisection over all ticks.
Crossings AllCrossings(const std::vector<AlphaTFace>& faces) {
  Crossings crossings;
  for (const AlphaTFace& below : faces) {
    for (const AlphaTFace& above : faces) {
      if (below.start > above.start || below.end <= above.end) continue;
      if (below.start == above.start) continue;  // Ordered by their ends at once.
      std::uint32_t before = 0, after = CrossingOrder::kTicks;
      while (after - before > 1) {
        const std::uint32_t middle = before + (after - before) / 2;
        (Scaled(below, middle) > Scaled(above, middle) ? after : before) = middle;
      }
      crossings[std::minmax(below.face, above.face)] = after;
    }
  }
  return crossings;
}

/// Runs the whole window; checks time, order and queue on the way.
Crossings SweepAll(const std::vector<AlphaTFace>& faces, std::uint32_t step) {
  CrossingOrder order;
  order.Start(faces);
  Crossings crossings;
  std::uint32_t last = 0;
  for (std::uint64_t limit = step; limit < CrossingOrder::kTicks + std::uint64_t{step};
       limit += step) {
    const auto tick =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(limit, CrossingOrder::kTicks));
    while (order.HasNext(tick)) {
      const FaceCrossing crossing = order.Next();
      EXPECT_GE(crossing.tick, last);
      EXPECT_LE(crossing.tick, tick);
      last = crossing.tick;
      EXPECT_GT(crossing.rising.end, crossing.falling.end);
      const auto names = std::minmax(crossing.rising.face, crossing.falling.face);
      EXPECT_TRUE(crossings.emplace(names, crossing.tick).second) << "a pair crossed twice";
    }
    const std::vector<AlphaTFace>& now = order.faces();
    for (std::size_t i = 0; i + 1 < now.size(); ++i) {
      EXPECT_LE(Scaled(now[i], tick), Scaled(now[i + 1], tick));
    }
  }
  EXPECT_LE(order.queued_max() + 1, std::max<std::size_t>(faces.size(), 1));
  return crossings;
}

// Goal:   a pair of faces that changes places is reported once, at the right tick and in the order
//         of time; the faces are in order after every tick; no more is queued than neighbours.
// Method: against bisection from the definition. A range of 3 units makes faces coincide, start,
//         end and cross together; one of 2^50 needs exact products.
TEST(CrossingOrder, TellsEveryCrossingOnceAndInOrder) {
  Random random(1);
  std::size_t reported = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::int64_t extents[] = {1, 3, 100, 1'000'000'000, std::int64_t{1} << 50};
    const int count = static_cast<int>(random.Below(40));
    const auto faces = RandomFaces(count, extents[round % 5], &random);
    const Crossings crossings =
        SweepAll(faces, static_cast<std::uint32_t>(CrossingOrder::kTicks / (1 + random.Below(5))));
    EXPECT_EQ(AllCrossings(faces), crossings) << "round " << round;
    reported += crossings.size();
  }
  EXPECT_GT(reported, kRounds * 100u);
}

/// The x in [0, odd) with 2^30 x = 1 modulo `odd`: 2 is inverted thirty times.
std::int64_t InverseOfTicks(std::int64_t odd) {
  std::int64_t x = 1;
  for (int i = 0; i < CrossingOrder::kTickBits; ++i) x = x % 2 == 0 ? x / 2 : (x + odd) / 2;
  return x;
}

// Goal:   the tick is exact also where a quotient in doubles is not.
// Method: quotients that miss a whole number of ticks by one part in 2^51, on either side.
TEST(CrossingOrder, TicksNextToAWholeNumberAreExact) {
  Random random(5);
  for (int i = 0; i < kRounds; ++i) {
    const auto closing = static_cast<std::int64_t>((1ull << 50) + random.Below(1ull << 50)) | 1;
    const std::int64_t inverse = InverseOfTicks(closing);
    for (const std::int64_t at_start : {inverse, closing - inverse}) {
      const AlphaTFace below{0, 0, 0}, above{at_start, at_start - closing, 1};
      const std::uint32_t tick = CrossingTick(below, above);
      EXPECT_GT(Scaled(below, tick), Scaled(above, tick));
      EXPECT_LE(Scaled(below, tick - 1), Scaled(above, tick - 1));
    }
  }
}

// Goal:   any number of faces may cross at one point, and at one tick.
// Method: 60 faces through the middle of the window: every pair crosses, at the tick after it.
TEST(CrossingOrder, ManyFacesCrossAtOnePoint) {
  std::vector<AlphaTFace> faces;
  for (std::uint32_t i = 0; i < 60; ++i) faces.push_back({i, 100 - static_cast<int>(i), i});
  const Crossings crossings = SweepAll(faces, CrossingOrder::kTicks);
  EXPECT_EQ(60u * 59 / 2, crossings.size());
  for (const auto& [names, tick] : crossings) EXPECT_EQ(CrossingOrder::kTicks / 2 + 1, tick);
}

// Goal:   faces that never change places cost nothing: parallel, coincident, touching at an end.
TEST(CrossingOrder, TouchingIsNoCrossing) {
  EXPECT_TRUE(SweepAll({{0, 5, 0}, {1, 6, 1}, {1, 6, 2}, {3, 6, 3}, {6, 6, 4}}, 1u << 28).empty());
}

// Goal:   the queue holds one event per place, and the least of them is in front.
// Method: against an ordered set, through many random changes.
TEST(CrossingQueue, IsTheLeastOfAnOrderedSet) {
  Random random(2);
  CrossingQueue queue;
  queue.Reset(50);
  std::map<std::uint32_t, std::uint32_t> ticks;
  for (int i = 0; i < 20 * kRounds; ++i) {
    const auto place = static_cast<std::uint32_t>(random.Below(50));
    if (random.Chance(0.6)) {
      ticks[place] = static_cast<std::uint32_t>(random.Below(100));
      queue.Set(place, ticks[place]);
    } else {
      ticks.erase(place);
      queue.Clear(place);
    }
    ASSERT_EQ(ticks.size(), queue.size());
    std::set<std::pair<std::uint32_t, std::uint32_t>> events;
    for (const auto& [at, tick] : ticks) events.emplace(tick, at);
    ASSERT_EQ(events.empty(), queue.empty());
    if (events.empty()) continue;
    ASSERT_EQ(events.begin()->first, queue.tick());
    ASSERT_EQ(events.begin()->second, queue.place());
  }
}

}  // namespace
}  // namespace collision::broad_phase
