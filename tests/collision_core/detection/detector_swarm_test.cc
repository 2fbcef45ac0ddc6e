// Goal:   in a crowd no contact is late, none is made up, brackets contain the truth and are nearly
//         tight, and the cached earliest intersection is the one computed from scratch.
// Method: seeded crowds under forces that honour M exactly, with states of unequal rate; the
//         truth is BallContacts (tests/support/truth).
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "collision_core/detection/detector.h"
#include "collision_core/intersection/earliest_intersection.h"
#include "tests/support/random.h"
#include "tests/support/truth/ball_contacts.h"

namespace collision::detection {
namespace {

using Eigen::Vector3d;

constexpr double kStep = 1.0 / 64;
constexpr double kRadius = 0.5;
constexpr double kAccelerationMax = 5;
// More than a position 7,000 km from the origin is rounded by, in all steps of a run [m].
constexpr double kTolerance = 1e-7;

Instant At(double seconds) {
  return Instant::FromNanoseconds(static_cast<std::int64_t>(std::llround(seconds * 1e9)));
}
double Seconds(Instant t) { return static_cast<double>(t.nanoseconds()) * 1e-9; }

// Every agent's exact motion: quadratic over each step.
class Crowd {
 public:
  Crowd(std::uint64_t seed, std::size_t agents, double box, int steps, double offset = 0) {
    const Vector3d middle = Vector3d::Constant(offset + box / 2);
    Random random(seed);
    for (std::size_t i = 0; i < agents; ++i) {
      MotionPiece knot;
      knot.p = {offset + random.Uniform(0, box), offset + random.Uniform(0, box),
                offset + random.Uniform(0, box)};
      knot.v = random.UnitVector() * random.Uniform(0, 8);
      PiecewiseMotion motion;
      for (int k = 0; k < steps; ++k) {
        knot.start_ns = At(k * kStep).nanoseconds();
        knot.end_ns = At((k + 1) * kStep).nanoseconds();
        // Towards the middle, and at random; shortened a little, so that rounding cannot pass M.
        const Vector3d pull = (middle - knot.p) / box * kAccelerationMax;
        knot.a = pull + random.UnitVector() * kAccelerationMax;
        knot.a *= random.Uniform(0, 1 - 1e-12) * kAccelerationMax /
                  std::max(knot.a.norm(), kAccelerationMax);
        motion.pieces.push_back(knot);
        knot.p += knot.v * kStep + knot.a * (kStep * kStep / 2);
        knot.v += knot.a * kStep;
      }
      motion_.push_back(motion);
    }
  }

  std::size_t size() const { return motion_.size(); }
  const MotionPiece& Start(std::size_t agent, int step) const {
    return motion_[agent].pieces[static_cast<std::size_t>(step)];
  }
  const PiecewiseMotion& Motion(std::size_t agent) const { return motion_[agent]; }

  Real Gap(std::size_t a, std::size_t b, Instant t) const {
    const std::int64_t t_ns = t.nanoseconds();
    const Vector apart = motion_[b].At(t_ns).TrueAt(t_ns).p - motion_[a].At(t_ns).TrueAt(t_ns).p;
    return apart.norm() - 2 * kRadius;
  }

  Vector Velocity(std::size_t agent, Instant t) const {
    return motion_[agent].At(t.nanoseconds()).TrueAt(t.nanoseconds()).v;
  }

 private:
  std::vector<PiecewiseMotion> motion_;
};

struct Contact {
  std::size_t a, b;
  Instant begin;
};

// Those that begin in motion, and are deeper than rounding of the positions.
std::vector<Contact> TrueContacts(const Crowd& crowd, Instant end) {
  std::vector<Contact> contacts;
  for (std::size_t a = 0; a < crowd.size(); ++a) {
    for (std::size_t b = a + 1; b < crowd.size(); ++b) {
      for (const BallContact& contact :
           BallContacts(crowd.Motion(a), crowd.Motion(b), 2 * kRadius, 0, end.nanoseconds())) {
        if (!contact.begins_in_motion || contact.depth < kTolerance) continue;
        contacts.push_back({a, b, Instant::FromNanoseconds(contact.begin_ns)});
      }
    }
  }
  return contacts;
}

AgentId Id(std::size_t slot) { return {1, static_cast<std::uint32_t>(slot), 1, 1}; }

struct RunLog {
  std::vector<CollisionEvent> events;
  struct Promise {
    Instant now, clear_until;
  };
  std::vector<std::vector<Promise>> promises;  // by agent
  std::uint64_t mismatched_earliest = 0;
  std::uint64_t compared_earliest = 0;
  DetectorCounters counters;
};

motion::MotionState StateOf(const Crowd& crowd, std::size_t agent, int step) {
  motion::MotionState state;
  state.stamp = At(step * kStep);
  state.p_WA = crowd.Start(agent, step).p;
  state.v_WA = crowd.Start(agent, step).v;
  return state;
}

// The agents with a new state in a step: each at a rate of its own, from every step to every
// fourth.
bool HasNewState(std::size_t agent, int step) { return step % (1 + agent % 4) == 0; }

RunLog Simulate(const Crowd& crowd, int steps) {
  RunLog run;
  run.promises.resize(crowd.size());
  Detector detector{DetectorOptions{}};
  std::vector<motion::SpaceTimeBound> newest(crowd.size());
  std::map<std::pair<AgentId, AgentId>, EventStatus> last;
  const AgentDeclaration declaration{.limits = {kRadius, kAccelerationMax}};
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      if (step > 0 && !HasNewState(i, step)) continue;
      const motion::MotionState state = StateOf(crowd, i, step);
      if (step == 0) {
        detector.Admit(Id(i), declaration, state, state.stamp);
      } else {
        EXPECT_EQ(detector.Update(Id(i), state, state.stamp), UpdateOutcome::kKept);
      }
      newest[i] = {state, declaration.limits, 0};
    }
    const Instant now = At(step * kStep);
    for (std::size_t i = 0; i < crowd.size(); ++i) detector.SetHeardUntil(OwnerOf(Id(i)), now);
    detector.Advance(now);
    if (step % 16 == 0) detector.Validate();
    for (const CollisionEvent& event : detector.events()) {
      run.events.push_back(event);
      last[{event.lower, event.higher}] = event.status;
    }
    for (const AgentClearance& clearance : detector.TakeChangedClearances()) {
      run.promises[clearance.agent.slot].push_back({now, clearance.clear_until});
    }
    if (step % 8 != 0) continue;
    const bool contact = std::any_of(last.begin(), last.end(), [](const auto& entry) {
      return entry.second == EventStatus::kConfirmed;
    });
    const EarliestAnswer lazy = detector.Earliest();
    EarliestAnswer scratch;
    for (std::size_t a = 0; a < crowd.size(); ++a) {
      for (std::size_t b = a + 1; b < crowd.size(); ++b) {
        const Instant when =
            intersection::EarliestIntersection(newest[a], newest[b], now).instant();
        if (!when.is_never() && when < scratch.earliest) scratch = {true, when, Id(a), Id(b)};
      }
    }
    if (contact) continue;
    ++run.compared_earliest;
    run.mismatched_earliest += lazy.found != scratch.found || lazy.earliest != scratch.earliest ||
                               lazy.lower != scratch.lower || lazy.higher != scratch.higher;
  }
  run.counters = detector.counters();
  return run;
}

// The least distance of the two within the span that an event speaks of is within its bracket, and
// taken within its bracket of time. Samples tell the truth: the least of them is no less than it,
// and by less than they move between two.
void ExpectClosest(const Crowd& crowd, const CollisionEvent& event) {
  constexpr int kSamples = 400;
  ASSERT_TRUE(event.closest) << "since the event was announced states came";
  const ClosestApproach& closest = *event.closest;
  ASSERT_LE(closest.from, closest.at.earliest);
  ASSERT_LE(closest.at.latest, closest.until);
  const std::int64_t from = closest.from.nanoseconds(), span = closest.until.nanoseconds() - from;
  Real least = std::numeric_limits<Real>::infinity(), least_inside = least;
  for (int i = 0; i <= kSamples; ++i) {
    const Instant at = Instant::FromNanoseconds(from + span * i / kSamples);
    const Real gap = crowd.Gap(event.lower.slot, event.higher.slot, at);
    least = std::min(least, gap);
    if (closest.at.earliest <= at && at <= closest.at.latest) {
      least_inside = std::min(least_inside, gap);
    }
  }
  // No two move faster against each other than 30 m/s.
  const Real between = 30 * Real(span) * 1e-9L / kSamples;
  EXPECT_LE(closest.distance.lower, least + kTolerance);
  EXPECT_GE(closest.distance.upper, least - between - kTolerance);
  EXPECT_GE(least, closest.distance.lower - kTolerance);
  EXPECT_LE(std::min(least_inside, Real(closest.distance.upper)), least + between + kTolerance);
}

// What the truth is off by [ns]: the root, and the nanosecond that it is cut to.
constexpr std::int64_t kOracle = 2;

bool Explains(const CollisionEvent& event, const Contact& contact) {
  if (event.lower != Id(contact.a) || event.higher != Id(contact.b)) return false;
  const std::int64_t begin = contact.begin.nanoseconds();
  const auto within = [&](Instant from, Instant to) {
    return from.nanoseconds() <= begin + kOracle && begin - kOracle <= to.nanoseconds();
  };
  switch (event.status) {
    case EventStatus::kConfirmed:
    case EventStatus::kEnded:
      return within(event.begin.earliest, event.begin.latest) ||
             (!event.continuous && within(event.begin.earliest, event.end.latest));
    case EventStatus::kUndecided:
      return within(event.begin.earliest, event.end.latest);
    default:
      return false;
  }
}

class DetectorSwarm : public testing::TestWithParam<int> {};

TEST_P(DetectorSwarm, NeverLateNeverMadeUpNearlyTight) {
  constexpr int kSteps = 64 * 6;
  // Half of the crowds are 7,000 km from the origin, where a position is known to a nanometre.
  const Crowd crowd(100 + GetParam(), 30, 10, kSteps + 1, GetParam() % 2 == 0 ? 0 : 7e6);
  const RunLog run = Simulate(crowd, kSteps);
  const std::vector<Contact> contacts = TrueContacts(crowd, At((kSteps - 8) * kStep));
  ASSERT_GT(contacts.size(), 5u);

  for (const Contact& contact : contacts) {
    const auto explained = std::any_of(run.events.begin(), run.events.end(),
                                       [&](const auto& event) { return Explains(event, contact); });
    EXPECT_TRUE(explained) << contact.a << "-" << contact.b << " at " << Seconds(contact.begin);
    const auto announced =
        std::any_of(run.events.begin(), run.events.end(), [&](const auto& event) {
          return event.lower == Id(contact.a) && event.higher == Id(contact.b) &&
                 event.now <= contact.begin && event.status == EventStatus::kPossible;
        });
    EXPECT_TRUE(announced) << contact.a << "-" << contact.b << " at " << Seconds(contact.begin);
    for (const std::size_t agent : {contact.a, contact.b}) {
      for (const RunLog::Promise& promise : run.promises[agent]) {
        const bool broken = promise.now <= contact.begin &&
                            contact.begin.nanoseconds() < promise.clear_until.nanoseconds() - 1;
        if (!broken) continue;
        // Only a pair in contact is exempt: the earlier contact of the same two had not ended.
        EXPECT_LE(crowd.Gap(contact.a, contact.b, promise.now), 0)
            << contact.a << "-" << contact.b << " promised " << Seconds(promise.clear_until)
            << " at " << Seconds(promise.now);
      }
    }
  }

  std::vector<double> widths, widths_of_closest;
  for (const CollisionEvent& event : run.events) {
    const std::size_t a = event.lower.slot, b = event.higher.slot;
    if (event.status == EventStatus::kConfirmed || event.status == EventStatus::kEnded) {
      EXPECT_LE(crowd.Gap(a, b, event.begin.latest), kTolerance);
      EXPECT_GE(crowd.Gap(a, b, event.begin.earliest), event.began_before ? -1 : -kTolerance);
    }
    if (event.status == EventStatus::kEnded) {
      EXPECT_GE(crowd.Gap(a, b, event.end.latest), -kTolerance);
      EXPECT_LE(crowd.Gap(a, b, event.end.earliest), kTolerance);
      widths.push_back(Seconds(event.begin.latest) - Seconds(event.begin.earliest));
    }
    if (event.status == EventStatus::kDismissed) {
      EXPECT_GT(crowd.Gap(a, b, event.now), 0);
      if (event.closest) widths_of_closest.push_back(event.closest->distance.width());
    }
    const bool over =
        event.status == EventStatus::kDismissed || event.status == EventStatus::kEnded;
    if (over) ExpectClosest(crowd, event);
    EXPECT_EQ(event.expected.has_value(), event.status == EventStatus::kPossible);
    EXPECT_TRUE(event.lower_state && event.higher_state);
    if (event.status == EventStatus::kConfirmed) {
      ASSERT_TRUE(event.relative_velocity);
      EXPECT_LE((crowd.Velocity(b, event.evaluated_at) - crowd.Velocity(a, event.evaluated_at) -
                 event.relative_velocity->v_AB.cast<Real>())
                    .norm(),
                event.relative_velocity->error);
      // States at most 1/16 s old, 5 m/s² each.
      EXPECT_LE(event.relative_velocity->error, 2 * kAccelerationMax / 16 + 1e-6);
    }
  }
  // Between states T <= 1/16 s apart two bounds of 5 m/s² meet at 2.5 mm; bodies close at metres a
  // second.
  ASSERT_FALSE(widths.empty());
  std::sort(widths.begin(), widths.end());
  EXPECT_LT(widths[widths.size() / 2], 0.01);
  ASSERT_FALSE(widths_of_closest.empty());
  std::sort(widths_of_closest.begin(), widths_of_closest.end());
  EXPECT_LT(widths_of_closest[widths_of_closest.size() / 2], 0.006);

  EXPECT_GT(run.compared_earliest, 0u);
  EXPECT_EQ(run.mismatched_earliest, 0u);
  EXPECT_GT(run.counters.updates_kept, 0u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DetectorSwarm, testing::Range(0, 4));

// Pairs that all meet at the same time, far from the origin: rounding alone decides which is first,
// and it turns out anew with every state. A key kept from an older state must not hide the pair
// that is first now.
TEST(DetectorSwarm, LazyIsScratchWhereRoundingDecides) {
  Random random(31);
  Detector detector{DetectorOptions{}};
  constexpr std::size_t kPairs = 24;
  const AgentDeclaration still{.limits = {1, 0}};
  std::vector<MotionPiece> start;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Vector3d middle =
        random.UnitVector() * random.Uniform(1e6, 9e6) + Vector3d(1e5, 0, 0) * i;
    const Vector3d n = random.UnitVector();
    start.push_back({.p = middle - n * 51, .v = n * 0.5});
    start.push_back({.p = middle + n * 51, .v = n * -0.5});
  }
  std::vector<motion::SpaceTimeBound> newest(start.size());
  for (int step = 0; step < 400; ++step) {
    const double t = step / 7.0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      motion::MotionState state;
      state.stamp = At(t);
      state.p_WA = start[i].p + start[i].v * Seconds(At(t));
      state.v_WA = start[i].v;
      newest[i] = {state, still.limits, 0};
      if (step == 0) detector.Admit(Id(i), still, state, state.stamp);
      if (step > 0) {
        EXPECT_EQ(detector.Update(Id(i), state, state.stamp), UpdateOutcome::kKept);
      }
    }
    detector.Advance(At(t));
    if (step % 16 == 0) detector.Validate();
    EarliestAnswer scratch;
    for (std::size_t i = 0; i < start.size(); i += 2) {
      const Instant when =
          intersection::EarliestIntersection(newest[i], newest[i + 1], At(t)).instant();
      if (when < scratch.earliest) scratch = {true, when, Id(i), Id(i + 1)};
    }
    const EarliestAnswer lazy = detector.Earliest();
    ASSERT_EQ(lazy.earliest, scratch.earliest) << "step " << step;
    ASSERT_EQ(lazy.lower, scratch.lower) << "step " << step;
  }
}

TEST(DetectorSwarm, SameCallsSameEvents) {
  const Crowd crowd(9, 20, 9, 200);
  const RunLog first = Simulate(crowd, 200);
  const RunLog second = Simulate(crowd, 200);
  ASSERT_EQ(first.events.size(), second.events.size());
  for (std::size_t i = 0; i < first.events.size(); ++i) {
    EXPECT_EQ(first.events[i].begin, second.events[i].begin);
    EXPECT_EQ(first.events[i].end, second.events[i].end);
    EXPECT_EQ(first.events[i].separation_upper, second.events[i].separation_upper);
  }
}

}  // namespace
}  // namespace collision::detection
