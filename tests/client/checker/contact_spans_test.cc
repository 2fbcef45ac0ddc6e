#include "client/checker/motion/contact_spans.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/checker/motion/true_contacts.h"
#include "tests/support/random.h"

namespace collision::checker {
namespace {

// Goal:   head-on on straight lines: a quadratic with known roots.
// Method: distance 2²+3²+6²=7² shrinks at 7 m/s, reach 1: from 6/7 s to 8/7 s.
TEST(ContactSpans, StraightLinesMeetExactly) {
  const Cubic3 d = {{{2, -2, 0, 0}, {3, -3, 0, 0}, {6, -6, 0, 0}}};
  const auto spans = SpansWithin(d, 2, 1);
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_NEAR(static_cast<double>(spans[0].begin - 6.0L / 7), 0, 1e-12);
  EXPECT_NEAR(static_cast<double>(spans[0].end - 8.0L / 7), 0, 1e-12);
}

// Goal:   a pair that touches, parts and returns within one piece gives each span.
// Method: x = (t-1)(t-2)(t-3) · 10: |x| <= 1 around each root; the sextic's six roots against
// bisection.
TEST(ContactSpans, ThreeMeetingsInOnePiece) {
  const Cubic3 d = {{{-60, 110, -60, 10}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
  const auto spans = SpansWithin(d, 4, 1);
  ASSERT_EQ(spans.size(), 3u);
  const auto x = [](long double t) { return 10 * (t - 1) * (t - 2) * (t - 3); };
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(static_cast<double>(std::fabs(x(spans[i].begin))), 1, 1e-9);
    EXPECT_NEAR(static_cast<double>(std::fabs(x(spans[i].end))), 1, 1e-9);
    EXPECT_LT(spans[i].begin, i + 1);
    EXPECT_GT(spans[i].end, i + 1);
  }
}

// Goal:   grazing is decided on both sides of touching.
TEST(ContactSpans, GrazingWithinAndBeyond) {
  const auto graze = [](long double y) {
    return SpansWithin({{{-1, 1, 0, 0}, {y, 0, 0, 0}, {0, 0, 0, 0}}}, 2, 1).size();
  };
  EXPECT_EQ(graze(1 - 1e-9L), 1u);
  EXPECT_EQ(graze(1), 1u);
  EXPECT_EQ(graze(1 + 1e-9L), 0u);
}

// Goal:   resting contact and lasting distance end at once, whatever the rounding.
TEST(ContactSpans, RestingContactIsOneSpan) {
  const auto spans = SpansWithin({{{0.6L, 0, 0, 0}, {0.8L, 0, 0, 0}, {0, 0, 0, 0}}}, 1000, 1);
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_EQ(spans[0].begin, 0);
  EXPECT_EQ(spans[0].end, 1000);
  EXPECT_TRUE(SpansWithin({{{0.7L, 0, 0, 0}, {0.8L, 0, 0, 0}, {0, 0, 0, 0}}}, 1000, 1).empty());
}

// Goal:   culling does not lose a motion that bulges between its ends.
// Method: x = 27 t (1-t)² is 0 at both ends and 4 at t = 1/3; its mirror in time at 2/3. Another
// ball waits there.
TEST(TrueContacts, BulgesBetweenEndsAreSeen) {
  const std::array<double, 4> bulges[] = {{0, 27, -54, 27}, {0, 0, 27, -27}};
  for (int i = 0; i < 2; ++i) {
    Piece moving{0, 1'000'000'000, {}}, waiting = moving;
    moving.p_WA[0] = bulges[i];
    waiting.p_WA[0] = {4.999, 0, 0, 0};
    const auto contacts =
        TrueContacts({{"s", "a", 0.5, {moving}, {}}, {"s", "b", 0.5, {waiting}, {}}});
    ASSERT_EQ(contacts.size(), 1u);
    const auto middle = static_cast<double>((contacts[0].begin_ns + contacts[0].end_ns) / 2);
    EXPECT_NEAR(middle * 1e-9, (i + 1) / 3.0, 1e-3);
  }
}

// Goal:   contacts are found across pieces that are cut at different times, boxes cull nothing
// true. Method: the same random cubic motion cut at random instants gives the same contacts as
// uncut.
TEST(TrueContacts, CuttingMotionIntoPiecesChangesNothing) {
  Random random(11);
  std::size_t found = 0;
  for (int run = 0; run < 600; ++run) {
    AgentMotion whole[2], cut[2];
    for (int agent = 0; agent < 2; ++agent) {
      Piece piece{0, 4'000'000'000, {}};
      for (auto& axis : piece.p_WA) {
        axis = {random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-1, 1),
                random.Uniform(-0.2, 0.2)};
      }
      whole[agent] = {"s", std::to_string(agent), 0.5, {piece}, {}};
      cut[agent] = {"s", std::to_string(agent), 0.5, {}, {}};
      for (std::int64_t t = 0; t < 4'000'000'000;) {
        const std::int64_t next =
            std::min<std::int64_t>(4'000'000'000, t + 1 + random.Below(900'000'000));
        Piece part{t, next, {}};
        const double s = static_cast<double>(t) * 1e-9;
        for (int axis = 0; axis < 3; ++axis) {
          const auto& c = piece.p_WA[axis];
          part.p_WA[axis] = {c[0] + s * (c[1] + s * (c[2] + s * c[3])),
                             c[1] + s * (2 * c[2] + s * 3 * c[3]), c[2] + 3 * s * c[3], c[3]};
        }
        cut[agent].pieces.push_back(part);
        t = next;
      }
    }
    const auto expected = TrueContacts({whole[0], whole[1]});
    const auto actual = TrueContacts({cut[0], cut[1]});
    ASSERT_EQ(actual.size(), expected.size()) << "run " << run;
    for (std::size_t i = 0; i < actual.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(actual[i].begin_ns - expected[i].begin_ns), 0, 1);
      EXPECT_NEAR(static_cast<double>(actual[i].end_ns - expected[i].end_ns), 0, 1);
      EXPECT_EQ(actual[i].from_start, expected[i].from_start);
      EXPECT_EQ(actual[i].to_end, expected[i].to_end);
    }
    found += expected.size();
  }
  EXPECT_GE(found, 50u);
}

}  // namespace
}  // namespace collision::checker
