// Goal:   each event goes through its life, with brackets that contain the truth, and every cause
// is told. Method: few agents on lines, whose meetings are exact; states every 1/16 s, one clock.
#include <gtest/gtest.h>

#include <algorithm>

#include "collision_core/detection/detector.h"

namespace collision {
namespace {

using Eigen::Vector3d;

Instant At(double seconds) {
  return Instant::FromNanoseconds(static_cast<std::int64_t>(seconds * 1e9));
}

AgentId Id(std::uint32_t slot) { return {1, slot, 1, 1}; }

MotionState State(double t, const Vector3d& p, const Vector3d& v) {
  MotionState state;
  state.stamp = At(t);
  state.p_WA = p;
  state.v_WA = v;
  return state;
}

// Agents that move on lines under a declared bound of 1 m/s², in a detector that hears of them 16
// times a second.
class Line {
 public:
  explicit Line(DetectorOptions options = {}) : detector(options) {}

  void Add(std::uint32_t slot, const Vector3d& p, const Vector3d& v, double radius = 1) {
    detector.Admit(Id(slot), {radius, 1, 0, 1, ~0u}, State(now, p, v), At(now));
    agents.push_back({slot, p, v, now});
  }

  void RunTo(double end) {
    while (now < end) {
      now += 1.0 / 16;
      for (const Mover& agent : agents) {
        const double dt = now - agent.since;
        detector.Update(Id(agent.slot), State(now, agent.p + agent.v * dt, agent.v), At(now));
        detector.Hear(Id(agent.slot), At(now));
      }
      Step();
    }
  }

  void Step() {
    detector.Advance(At(now));
    events.insert(events.end(), detector.events().begin(), detector.events().end());
  }

  std::vector<CollisionEvent> With(EventStatus status) const {
    std::vector<CollisionEvent> found;
    std::copy_if(events.begin(), events.end(), std::back_inserter(found),
                 [&](const CollisionEvent& event) { return event.status == status; });
    return found;
  }

  struct Mover {
    std::uint32_t slot;
    Vector3d p, v;
    double since;
  };
  Detector detector;
  std::vector<Mover> agents;
  std::vector<CollisionEvent> events;
  double now = 0;
};

// Closing at 2 m/s from 12 m, radii 1: they touch on [5, 7] s exactly.
TEST(Detector, PassingThroughIsPossibleConfirmedEnded) {
  Line line;
  line.Add(1, {-6, 0, 0}, {1, 0, 0});
  line.Add(2, {6, 0, 0}, {-1, 0, 0});
  line.Step();
  line.RunTo(9);
  const auto possible = line.With(EventStatus::kPossible);
  const auto confirmed = line.With(EventStatus::kConfirmed);
  const auto ended = line.With(EventStatus::kEnded);
  ASSERT_FALSE(possible.empty());
  ASSERT_FALSE(confirmed.empty());
  ASSERT_EQ(ended.size(), 1u);
  EXPECT_LE(possible.front().now, At(3.1));
  for (const CollisionEvent& event : possible) {
    if (event.contact == 1) {
      EXPECT_LE(event.begin.earliest, At(5));
    }
  }
  for (const CollisionEvent& event : confirmed) {
    EXPECT_LE(event.begin.earliest, At(5));
    EXPECT_GE(event.begin.latest, At(5));
    EXPECT_LE(event.now, At(5.1));
    EXPECT_GT(event.normal.x(), 0.999);
    EXPECT_LE(event.p_WC.norm(), event.point_error + 1e-12);
  }
  EXPECT_LE(ended[0].end.earliest, At(7));
  EXPECT_GE(ended[0].end.latest, At(7));
  // Nearly tight: the states are exact at their stamps, and 5 and 7 s are stamps.
  EXPECT_GE(ended[0].begin.earliest, At(5 - 1e-3));
  EXPECT_LE(ended[0].begin.latest, At(5 + 1e-3));
  EXPECT_TRUE(ended[0].continuous);
}

// Passing at 2.5 m with radii 1: the bounds of 1 m/s² reach each other beforehand, the motion does
// not.
TEST(Detector, PassingByIsDismissed) {
  Line line;
  line.Add(1, {-6, 0, 0}, {1, 0, 0});
  line.Add(2, {6, 2.5, 0}, {-1, 0, 0});
  line.RunTo(16);
  EXPECT_FALSE(line.With(EventStatus::kPossible).empty());
  EXPECT_TRUE(line.With(EventStatus::kConfirmed).empty());
  EXPECT_TRUE(line.With(EventStatus::kUndecided).empty());
  EXPECT_FALSE(line.With(EventStatus::kDismissed).empty());
  EXPECT_EQ(line.detector.pairs_tracked(), 0u);
}

// Surfaces that pass within a tenth of a millimetre of touching cannot be told from touching
// between states.
TEST(Detector, GrazingIsUndecidedWithItsDistance) {
  Line line;
  line.Add(1, {-6.03, 0, 0}, {1, 0, 0});
  line.Add(2, {6, 2 + 1e-7, 0}, {-1, 0, 0});
  line.RunTo(16);
  const auto undecided = line.With(EventStatus::kUndecided);
  ASSERT_EQ(undecided.size(), 1u);
  const double graze = 6.015;
  EXPECT_LE(undecided[0].begin.earliest, At(graze));
  EXPECT_GE(undecided[0].end.latest, At(graze));
  EXPECT_GT(undecided[0].separation_upper, 0);
  EXPECT_LT(undecided[0].separation_upper, 1e-2);
}

TEST(Detector, RemovalWithdraws) {
  Line line;
  line.Add(1, {-2.5, 0, 0}, {1, 0, 0});
  line.Add(2, {2.5, 0, 0}, {-1, 0, 0});
  line.Step();
  ASSERT_EQ(line.With(EventStatus::kPossible).size(), 1u);
  EXPECT_TRUE(line.detector.Remove(Id(2)));
  EXPECT_FALSE(line.detector.Remove(Id(2)));
  line.Step();
  EXPECT_EQ(line.With(EventStatus::kWithdrawn).size(), 1u);
  EXPECT_EQ(line.detector.agents(), 1u);
  EXPECT_EQ(line.detector.ClearanceOf(Id(1))->clear_until, Instant::Never());
}

// An agent that leaves while in contact ends it.
TEST(Detector, RemovalInContactEnds) {
  Line line;
  line.Add(1, {-2.5, 0, 0}, {1, 0, 0});
  line.Add(2, {2.5, 0, 0}, {-1, 0, 0});
  line.RunTo(2);
  ASSERT_FALSE(line.With(EventStatus::kConfirmed).empty());
  line.detector.Remove(Id(1));
  line.Step();
  EXPECT_EQ(line.With(EventStatus::kEnded).size(), 1u);
}

TEST(Detector, BreachTellsThePartnerAndFromWhenPromisesAreVoid) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {1000, 0, 0}, {0, 0, 0});
  line.RunTo(1);
  line.detector.TakeChangedClearances();
  // 990 m in a sixteenth of a second is more than 1 m/s² allows.
  const double next = line.now + 1.0 / 16;
  EXPECT_EQ(line.detector.Update(Id(1), State(next, {990, 0, 0}, {0, 0, 0}), At(next)),
            UpdateOutcome::kBreached);
  line.detector.Advance(At(next));
  const auto changed = line.detector.TakeChangedClearances();
  const auto partner = std::find_if(changed.begin(), changed.end(),
                                    [](const AgentClearance& c) { return c.agent == Id(2); });
  ASSERT_NE(partner, changed.end());
  EXPECT_EQ(partner->cause, ClearanceCause::kBreach);
  EXPECT_EQ(partner->cause_agent, Id(1));
  EXPECT_EQ(partner->void_from, At(1));
  EXPECT_LT(partner->clear_until, At(6));
  EXPECT_EQ(line.detector.counters().breaches, 1u);
}

TEST(Detector, DeclaredJumpIsNoBreach) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {1000, 0, 0}, {0, 0, 0});
  line.RunTo(1);
  MotionState jump = State(line.now, {997.5, 0, 0}, {0, 0, 0});
  jump.discontinuity = true;
  EXPECT_EQ(line.detector.Update(Id(1), jump, At(line.now)), UpdateOutcome::kJumped);
  line.Step();
  EXPECT_EQ(line.detector.counters().breaches, 0u);
  ASSERT_EQ(line.With(EventStatus::kPossible).size(), 1u);
  EXPECT_EQ(line.detector.ClearanceOf(Id(2))->clear_until,
            line.With(EventStatus::kPossible)[0].begin.earliest);
}

TEST(Detector, MasksKeepApart) {
  Line line;
  line.detector.Admit(Id(1), {1, 1, 0, 1, 2}, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  line.detector.Admit(Id(2), {1, 1, 0, 1, 2}, State(0, {1, 0, 0}, {0, 0, 0}), At(0));
  line.Step();
  EXPECT_TRUE(line.events.empty());
  EXPECT_FALSE(line.detector.Earliest().found);
  // A widened mask is a new danger; they overlap already.
  line.detector.Redeclare(Id(1), {1, 1, 0, 3, 3}, At(0));
  line.detector.Redeclare(Id(2), {1, 1, 0, 3, 3}, At(0));
  line.Step();
  EXPECT_EQ(line.With(EventStatus::kPossible).size(), 1u);
  EXPECT_EQ(line.With(EventStatus::kConfirmed).size(), 0u) << "not heard beyond the first state";
  EXPECT_TRUE(line.With(EventStatus::kPossible)[0].began_before);
}

TEST(Detector, WiderBoundLowersThePartnersClearance) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {1000, 0, 0}, {0, 0, 0});
  line.Step();
  line.detector.TakeChangedClearances();
  const Instant before = line.detector.ClearanceOf(Id(2))->clear_until;
  line.detector.Redeclare(Id(1), {1, 100, 0, 1, ~0u}, At(3));
  line.Step();
  const auto changed = line.detector.TakeChangedClearances();
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_LT(changed[1].clear_until, before);
  EXPECT_EQ(changed[1].cause, ClearanceCause::kWidening);
  EXPECT_EQ(changed[1].cause_agent, Id(1));
  EXPECT_EQ(changed[0].effective_from, At(3));
}

TEST(Detector, ExpiredAgentsLeaveThePromises) {
  Line line;
  MotionState state = State(0, {0, 0, 0}, {0, 0, 0});
  state.expiry = At(2);
  line.detector.Admit(Id(1), {1, 1, 0, 1, ~0u}, state, At(0));
  line.detector.Admit(Id(2), {1, 1, 0, 1, ~0u}, State(0, {3, 0, 0}, {0, 0, 0}), At(0));
  line.Step();
  ASSERT_EQ(line.With(EventStatus::kPossible).size(), 1u);
  line.now = 2;
  line.Step();
  EXPECT_EQ(line.With(EventStatus::kWithdrawn).size(), 1u);
  EXPECT_EQ(line.detector.ClearanceOf(Id(2))->clear_until, Instant::Never());
  // It speaks again: promises count it from here on.
  line.detector.Update(Id(1), State(3, {0, 0, 0}, {0, 0, 0}), At(3));
  line.now = 3;
  line.Step();
  EXPECT_EQ(line.With(EventStatus::kPossible).size(), 2u);
}

TEST(Detector, BeyondItsPairsAnAgentIsSaturatedNotSilent) {
  DetectorOptions options;
  options.pairs_per_agent_max = 3;
  Line line(options);
  for (std::uint32_t slot = 0; slot < 8; ++slot) line.Add(slot, {2.5 * slot, 0, 0}, {0, 0, 0});
  line.Step();
  line.RunTo(0.5);
  std::size_t saturated = 0;
  for (std::uint32_t slot = 0; slot < 8; ++slot) {
    const AgentClearance clearance = *line.detector.ClearanceOf(Id(slot));
    saturated += clearance.saturated;
    if (clearance.saturated) {
      EXPECT_TRUE(clearance.not_clear);
      EXPECT_LE(clearance.clear_until, line.detector.now());
    }
  }
  EXPECT_GT(saturated, 0u);
  EXPECT_LE(line.detector.pairs_tracked(), 8u * 3 / 2);
}

// After it was dismissed a pair is covered by its agents' keys again: they turn round and meet.
TEST(Detector, DismissedPairIsNotForgotten) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {3.5, 0, 0}, {0.9, 0, 0});
  line.RunTo(8);
  ASSERT_FALSE(line.With(EventStatus::kDismissed).empty());
  ASSERT_EQ(line.detector.pairs_tracked(), 0u);
  EXPECT_LT(line.detector.ClearanceOf(Id(1))->clear_until, At(20));
  // A jump of the velocity alone, told as such.
  MotionState turn = State(line.now, line.agents[1].p + line.agents[1].v * line.now, {-0.9, 0, 0});
  turn.discontinuity = true;
  line.detector.Update(Id(2), turn, At(line.now));
  line.agents[1] = {2, turn.p_WA, turn.v_WA, line.now};
  line.Step();
  line.RunTo(20);
  EXPECT_FALSE(line.With(EventStatus::kConfirmed).empty());
}

// Without acceleration the meeting at 5 s is known from the start; it is announced 2 s ahead, not
// when it comes.
TEST(Detector, AnnouncesAsFarAheadAsAsked) {
  Detector detector{DetectorOptions{}};
  detector.Admit(Id(1), {1, 0, 0, 1, ~0u}, State(0, {-6, 0, 0}, {1, 0, 0}), At(0));
  detector.Admit(Id(2), {1, 0, 0, 1, ~0u}, State(0, {6, 0, 0}, {-1, 0, 0}), At(0));
  detector.Advance(At(2.9375));
  EXPECT_TRUE(detector.events().empty());
  EXPECT_GE(detector.ClearanceOf(Id(1))->clear_until, At(5 - 1e-6));
  EXPECT_LE(detector.ClearanceOf(Id(1))->clear_until, At(5));
  detector.Advance(At(3.0625));
  ASSERT_EQ(detector.events().size(), 1u);
  EXPECT_EQ(detector.events()[0].status, EventStatus::kPossible);
}

// Between two states the owner's word "nothing else happened up to now" is enough to confirm.
TEST(Detector, ConfirmsBetweenStatesUpToWhatWasHeard) {
  for (const bool heard : {true, false}) {
    Detector detector{DetectorOptions{}};
    std::size_t confirmed = 0;
    detector.Admit(Id(1), {1, 0.01, 0, 1, ~0u}, State(0, {-6, 0, 0}, {1, 0, 0}), At(0));
    detector.Admit(Id(2), {1, 0.01, 0, 1, ~0u}, State(0, {6, 0, 0}, {-1, 0, 0}), At(0));
    for (double now = 0; now <= 6; now += 1.0 / 16) {
      if (heard) {
        detector.Hear(Id(1), At(now));
        detector.Hear(Id(2), At(now));
      }
      detector.Advance(At(now));
      for (const CollisionEvent& event : detector.events()) {
        confirmed += event.status == EventStatus::kConfirmed;
      }
    }
    EXPECT_EQ(confirmed > 0, heard) << "a jump that nobody told of yet may have come before";
  }
}

// What was confirmed stays confirmed, and ends, although the states after it were lost for seconds.
TEST(Detector, ConfirmedContactEndsAfterLostStates) {
  DetectorOptions options;
  options.history_max = 8;
  Detector detector{options};
  std::vector<CollisionEvent> events;
  const AgentDeclaration ball{0.5, 0.1, 0, 1, ~0u};
  const auto speak = [&](double t) {
    detector.Update(Id(1), State(t, {-20 + 2 * t, 0, 0}, {2, 0, 0}), At(t));
    detector.Update(Id(2), State(t, {20 - 2 * t, 0, 0}, {-2, 0, 0}), At(t));
  };
  const auto step = [&](double now) {
    detector.Hear(Id(1), At(now));
    detector.Hear(Id(2), At(now));
    detector.Advance(At(now));
    events.insert(events.end(), detector.events().begin(), detector.events().end());
  };
  detector.Admit(Id(1), ball, State(0, {-20, 0, 0}, {2, 0, 0}), At(0));
  detector.Admit(Id(2), ball, State(0, {20, 0, 0}, {-2, 0, 0}), At(0));
  for (double now = 0; now <= 9.75; now += 0.25) {
    speak(now);
    step(now);
  }
  step(9.78125);
  ASSERT_EQ(events.back().status, EventStatus::kConfirmed);
  // The first agent's states come all at once, more than are kept; of the second's only the last.
  for (double t = 10; t < 16.5; t += 0.125) {
    detector.Update(Id(1), State(t, {-20 + 2 * t, 0, 0}, {2, 0, 0}), At(t));
  }
  speak(16.5);
  step(16.5);
  step(16.75);
  const auto ended = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.status == EventStatus::kEnded;
  });
  ASSERT_NE(ended, events.end());
  EXPECT_LE(ended->begin.earliest, At(9.75));
  EXPECT_GE(ended->begin.latest, At(9.75));
  EXPECT_LE(ended->end.earliest, At(10.25));
  EXPECT_GE(ended->end.latest, At(10.25));
  EXPECT_GE(ended->end.earliest, At(10.2));
  EXPECT_LE(ended->end.latest, At(10.5));
}

// A contact just before a declared jump counts, although the state after the jump lies far away.
TEST(Detector, JumpDoesNotUndoWhatCameBefore) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {3.03, 0, 0}, {-1, 0, 0});
  line.RunTo(1);
  MotionState jump = State(line.now + 1.0 / 16, {500, 0, 0}, {0, 0, 0});
  jump.discontinuity = true;
  line.now += 1.0 / 16;
  line.detector.Update(Id(1), State(line.now, {0, 0, 0}, {0, 0, 0}), At(line.now));
  line.detector.Update(Id(2), jump, At(line.now));
  line.agents.pop_back();
  line.Step();
  line.RunTo(1.25);
  const auto confirmed = line.With(EventStatus::kConfirmed);
  ASSERT_FALSE(confirmed.empty());
  EXPECT_LE(confirmed.back().begin.earliest, At(1.03));
  EXPECT_GE(confirmed.back().begin.latest, At(1.03));
}

// News of a jump comes late: what the jumped agent met before the partner's newest state is found
// as well.
TEST(Detector, ContactBetweenALateJumpAndNewerStatesIsFound) {
  Detector detector{DetectorOptions{}};
  std::vector<CollisionEvent> events;
  const auto step = [&](double now) {
    detector.Advance(At(now));
    events.insert(events.end(), detector.events().begin(), detector.events().end());
  };
  const Vector3d fast(1000, 0, 0);
  detector.Admit(Id(1), {1, 0, 0, 1, ~0u}, State(0, {5000, 9000, 0}, {0, 0, 0}), At(0));
  detector.Admit(Id(2), {1, 0, 0, 1, ~0u}, State(0, {0, 0, 0}, fast), At(0));
  step(0);
  detector.Update(Id(2), State(1.0, {1000, 0, 0}, fast), At(1));
  step(1);
  detector.Update(Id(2), State(1.0625, {1062.5, 0, 0}, fast), At(1.0625));
  step(1.0625);
  // At 1 s it jumped to where the other passed at 1.03 s; told at 1.1 s.
  MotionState jump = State(1, {1030, 0, 0}, {0, 0, 0});
  jump.discontinuity = true;
  detector.Update(Id(1), jump, At(1.1));
  detector.Hear(Id(1), At(1.0625));
  detector.Hear(Id(2), At(1.0625));
  step(1.125);
  const auto confirmed = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.status == EventStatus::kConfirmed;
  });
  ASSERT_NE(confirmed, events.end());
  EXPECT_LE(confirmed->begin.earliest, At(1.028));
  EXPECT_GE(confirmed->begin.latest, At(1.028));
}

TEST(Detector, LimitsAndStrangers) {
  DetectorOptions options;
  options.agents_max = 1;
  Line line(options);
  EXPECT_TRUE(line.detector.Admit(Id(1), {1, 1, 0, 1, ~0u}, State(0, {0, 0, 0}, {0, 0, 0}), At(0)));
  EXPECT_FALSE(
      line.detector.Admit(Id(1), {1, 1, 0, 1, ~0u}, State(0, {0, 0, 0}, {0, 0, 0}), At(0)));
  EXPECT_FALSE(
      line.detector.Admit(Id(2), {1, 1, 0, 1, ~0u}, State(0, {0, 0, 0}, {0, 0, 0}), At(0)));
  EXPECT_EQ(line.detector.Update(Id(2), State(0, {0, 0, 0}, {0, 0, 0}), At(0)),
            UpdateOutcome::kUnknown);
  EXPECT_EQ(line.detector.Update(Id(1), State(-1, {0, 0, 0}, {0, 0, 0}), At(0)),
            UpdateOutcome::kOlder);
}

}  // namespace
}  // namespace collision
