// Goal:   candidates come in the order that an impact search relies on, and those that cannot be
//         the first are dropped.
// Method: candidates with equal times that differ in one other respect each, pushed in either
//         order.
#include "collision_core/narrow_phase/advancement/impact_queue.h"

#include <gtest/gtest.h>

namespace collision::narrow_phase {
namespace {

using Kind = ImpactCandidate::Kind;

ImpactCandidate Nodes(double time, std::uint32_t a, double size) {
  ImpactCandidate nodes{time, Kind::kNodes, {NodeIndex(a), {}}};
  nodes.size = size;
  return nodes;
}

ImpactCandidate Elements(double time, std::uint32_t b) {
  return {time, Kind::kElements, {}, {{}, ElementIndex(b)}};
}

ImpactCandidate Resolved(double time) { return {time, Kind::kResolved, {}}; }

/// Whether x comes before y, whichever was pushed first.
bool ComesFirst(const ImpactCandidate& x, const ImpactCandidate& y) {
  const auto is_x = [&](const ImpactCandidate& front) {
    return front.time == x.time && front.kind == x.kind && front.size == x.size &&
           front.nodes == x.nodes && front.elements == x.elements;
  };
  ImpactQueue one(8), other(8);
  one.Push(x), one.Push(y);
  other.Push(y), other.Push(x);
  return is_x(one.front()) && is_x(other.Pop());
}

TEST(ImpactQueue, TheEarlierComesFirst) {
  EXPECT_TRUE(ComesFirst(Nodes(1, 5, 2), Nodes(2, 0, 1)));
  EXPECT_TRUE(ComesFirst(Nodes(1, 5, 2), Elements(2, 0)));
}

TEST(ImpactQueue, OfEqualTimesTheFarthestExaminedComesFirst) {
  EXPECT_TRUE(ComesFirst(Resolved(1), Elements(1, 0)));
  EXPECT_TRUE(ComesFirst(Elements(1, 7), Nodes(1, 0, 0.5)));
  EXPECT_TRUE(ComesFirst(Nodes(1, 7, 0.5), Nodes(1, 0, 1)));
}

TEST(ImpactQueue, OfEqualOnesTheLowerNumberComesFirst) {
  EXPECT_TRUE(ComesFirst(Nodes(1, 3, 1), Nodes(1, 4, 1)));
  EXPECT_TRUE(ComesFirst(Elements(1, 3), Elements(1, 4)));
}

TEST(ImpactQueue, DropsWhatCannotBeTheFirst) {
  ImpactQueue queue(8);
  queue.Push(Nodes(9, 0, 1));
  EXPECT_TRUE(queue.empty()) << "beyond the duration";
  queue.Push(Nodes(8, 0, 1));
  EXPECT_FALSE(queue.empty()) << "the end of the duration belongs to it";
  queue.Push(Resolved(4));
  EXPECT_EQ(queue.until(), 4);
  queue.Push(Nodes(5, 0, 1));
  EXPECT_EQ(queue.Pop().kind, Kind::kResolved);
  EXPECT_EQ(queue.Pop().time, 8);
  EXPECT_TRUE(queue.empty()) << "later than one that is resolved";
}

TEST(ImpactQueue, AnEmptyQueueHasNoFront) {
  ImpactQueue queue(8);
  EXPECT_THROW(queue.front(), CheckFailure);
  EXPECT_THROW(queue.Pop(), CheckFailure);
}

}  // namespace
}  // namespace collision::narrow_phase
