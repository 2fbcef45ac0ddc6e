// Goal:   each change of the rules (a breach, a jump, a mask, an expiry, a limit) is reported with
//         its cause, and loses no meeting.
// Method: few agents on lines, whose meetings are exact; states every 1/16 s, one clock.
#include <gtest/gtest.h>

#include "collision_core/base/check.h"
#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

TEST(Detector, BreachNotifiesThePartnerFromWhenPromisesAreVoid) {
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

// Back at the same place after a second, so fast that no motion of 1 m/s² leads there, though both
// the place and the speed could be reached. Earlier promises hold, but the update reports a breach.
TEST(Detector, StatesThatNoMotionJoinsAreABreach) {
  Line line;
  line.detector.Admit(Id(1), {.limits = {1, 1}}, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  line.detector.Admit(Id(2), {.limits = {1, 0}}, State(0, {3, 0, 0}, {0, 0, 0}), At(0));
  const auto update = [&line](double now, const Vector3d& p, const Vector3d& v) {
    line.now = now;
    const UpdateOutcome outcome = line.detector.Update(Id(1), State(now, p, v), At(now));
    line.Step();
    return outcome;
  };
  EXPECT_EQ(update(1, {0, 0, 0}, {0, 0.41, 0}), UpdateOutcome::kKept);
  line.detector.TakeChangedClearances();
  EXPECT_EQ(update(2, {0, 0.41, 0}, {0, 0.83, 0}), UpdateOutcome::kBreached);
  const auto changed = line.detector.TakeChangedClearances();
  const auto own = std::find_if(changed.begin(), changed.end(),
                                [](const AgentClearance& c) { return c.agent == Id(1); });
  ASSERT_NE(own, changed.end());
  EXPECT_EQ(own->cause, ClearanceCause::kBreach);
  EXPECT_EQ(own->cause_agent, Id(1));
  EXPECT_EQ(own->void_from, At(1));
  EXPECT_EQ(line.detector.counters().breaches, 1u);
}

// At rest at both ends, 990 m apart: half the way speeding up, half slowing down, 4 · 990 m / s².
TEST(Detector, ABreachIsExplainedByTheBoundThatWasInForce) {
  Line line;
  line.detector.Admit(Id(1), {.limits = {1, 2}}, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  EXPECT_THROW(line.detector.ExplainLastBreach(), CheckFailure);
  line.Step();
  EXPECT_EQ(line.detector.Update(Id(1), State(2, {990, 0, 0}, {0, 0, 0}), At(2)),
            UpdateOutcome::kBreached);
  line.detector.Redeclare(Id(1), {.limits = {1, 1e4}}, At(2));
  EXPECT_EQ(line.detector.Update(Id(1), State(3, {990, 0, 0}, {0, 0, 0}), At(3)),
            UpdateOutcome::kKept);
  const motion::BrokenBound broken = line.detector.ExplainLastBreach();
  EXPECT_EQ(broken.bound, motion::DeclaredBound::kAccelerationMax);
  EXPECT_EQ(broken.declared, 2);
  EXPECT_LE(broken.seen, 990);
  EXPECT_GE(broken.seen, 988);
  EXPECT_EQ(broken.from, At(0));
  EXPECT_EQ(broken.at, At(2));
}

// An agent admitted in the same step lowers the same clearance, but voids nothing.
TEST(Detector, BreachIsReportedWhateverElseComesInTheSameStep) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {1000, 0, 0}, {0, 0, 0});
  line.RunTo(1);
  line.detector.TakeChangedClearances();
  const double next = line.now + 1.0 / 16;
  line.detector.Update(Id(1), State(next, {990, 0, 0}, {0, 0, 0}), At(next));
  line.detector.Admit(Id(3), {.limits = {1, 1}}, State(next, {1003, 0, 0}, {0, 0, 0}), At(next));
  line.detector.Advance(At(next));
  const auto changed = line.detector.TakeChangedClearances();
  const auto partner = std::find_if(changed.begin(), changed.end(),
                                    [](const AgentClearance& c) { return c.agent == Id(2); });
  ASSERT_NE(partner, changed.end());
  EXPECT_EQ(partner->cause, ClearanceCause::kBreach);
  EXPECT_EQ(partner->cause_agent, Id(1));
  EXPECT_EQ(partner->void_from, At(1));
}

TEST(Detector, DeclaredJumpIsNoBreach) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {1000, 0, 0}, {0, 0, 0});
  line.RunTo(1);
  motion::MotionState jump = State(line.now, {997.5, 0, 0}, {0, 0, 0});
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
  line.detector.Admit(
      Id(1), {.limits = {.radius = 1, .acceleration_max = 1}, .filter = {.group = 1, .mask = 2}},
      State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  line.detector.Admit(
      Id(2), {.limits = {.radius = 1, .acceleration_max = 1}, .filter = {.group = 1, .mask = 2}},
      State(0, {1, 0, 0}, {0, 0, 0}), At(0));
  line.Step();
  EXPECT_TRUE(line.events.empty());
  EXPECT_FALSE(line.detector.Earliest().found);
  // A widened mask is a new danger; they overlap already.
  line.detector.Redeclare(
      Id(1), {.limits = {.radius = 1, .acceleration_max = 1}, .filter = {.group = 3, .mask = 3}},
      At(0));
  line.detector.Redeclare(
      Id(2), {.limits = {.radius = 1, .acceleration_max = 1}, .filter = {.group = 3, .mask = 3}},
      At(0));
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
  line.detector.Redeclare(Id(1), {.limits = {1, 100}}, At(3));
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
  motion::MotionState state = State(0, {0, 0, 0}, {0, 0, 0});
  state.expiry = At(2);
  line.detector.Admit(Id(1), {.limits = {1, 1}}, state, At(0));
  line.detector.Admit(Id(2), {.limits = {1, 1}}, State(0, {3, 0, 0}, {0, 0, 0}), At(0));
  line.Step();
  ASSERT_EQ(line.With(EventStatus::kPossible).size(), 1u);
  line.now = 2;
  line.Step();
  const std::vector<CollisionEvent> undecided = line.With(EventStatus::kUndecided);
  ASSERT_EQ(undecided.size(), 1u) << "they may have met before";
  EXPECT_EQ(undecided[0].end.latest, At(2));
  EXPECT_EQ(line.detector.ClearanceOf(Id(2))->clear_until, Instant::Never());
  // A new state comes: promises include the agent from here on.
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
      EXPECT_LE(clearance.clear_until, At(line.now));
    }
  }
  EXPECT_GT(saturated, 0u);
  EXPECT_LE(line.detector.pairs_tracked(), 8u * 3 / 2);
}

// Its newest state lies ahead: what is promised of it still ends now.
TEST(Detector, ASaturatedAgentIsNotClearUpToAStateAhead) {
  DetectorOptions options;
  options.pairs_per_agent_max = 1;
  Detector detector(options);
  for (std::uint32_t slot = 0; slot < 4; ++slot) {
    detector.Admit(Id(slot), {.limits = {1, 1}}, State(1, {2.5 * slot, 0, 0}, {0, 0, 0}), At(0));
  }
  detector.Advance(At(0.5));
  std::size_t saturated = 0;
  for (std::uint32_t slot = 0; slot < 4; ++slot) {
    const AgentClearance clearance = *detector.ClearanceOf(Id(slot));
    if (!clearance.saturated) continue;
    ++saturated;
    EXPECT_TRUE(clearance.not_clear);
    EXPECT_LE(clearance.clear_until, At(0.5));
  }
  EXPECT_GT(saturated, 0u);
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
  // A jump of the velocity alone, declared as such.
  motion::MotionState turn =
      State(line.now, line.agents[1].p + line.agents[1].v * line.now, {-0.9, 0, 0});
  turn.discontinuity = true;
  line.detector.Update(Id(2), turn, At(line.now));
  line.agents[1] = {2, turn.p_WA, turn.v_WA, line.now};
  line.Step();
  line.RunTo(20);
  EXPECT_FALSE(line.With(EventStatus::kConfirmed).empty());
}

// A contact just before a declared jump counts, although the state after the jump lies far away.
TEST(Detector, JumpDoesNotUndoWhatCameBefore) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {3.03, 0, 0}, {-1, 0, 0});
  line.RunTo(1);
  motion::MotionState jump = State(line.now + 1.0 / 16, {500, 0, 0}, {0, 0, 0});
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
  detector.Admit(Id(1), {.limits = {1, 0}}, State(0, {5000, 9000, 0}, {0, 0, 0}), At(0));
  detector.Admit(Id(2), {.limits = {1, 0}}, State(0, {0, 0, 0}, fast), At(0));
  step(0);
  detector.Update(Id(2), State(1.0, {1000, 0, 0}, fast), At(1));
  step(1);
  detector.Update(Id(2), State(1.0625, {1062.5, 0, 0}, fast), At(1.0625));
  step(1.0625);
  // At 1 s it jumped to where the other passed at 1.03 s; the state comes at 1.1 s.
  motion::MotionState jump = State(1, {1030, 0, 0}, {0, 0, 0});
  jump.discontinuity = true;
  detector.Update(Id(1), jump, At(1.1));
  detector.SetHeardUntil(OwnerOf(Id(1)), At(1.0625));
  detector.SetHeardUntil(OwnerOf(Id(2)), At(1.0625));
  step(1.125);
  const auto confirmed = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.status == EventStatus::kConfirmed;
  });
  ASSERT_NE(confirmed, events.end());
  EXPECT_LE(confirmed->begin.earliest, At(1.028));
  EXPECT_GE(confirmed->begin.latest, At(1.028));
}

// One agent was granted time up to 10 s and used it; then the other's jump makes them meet at 4.5
// s. No query in between may lose that meeting, in whichever order the two were admitted.
TEST(Detector, MeetingBeforeAStateThatIsAheadIsNotLost) {
  for (const bool first_jumps : {true, false}) {
    Detector detector{DetectorOptions{}};
    std::vector<CollisionEvent> events;
    const AgentId jumper = first_jumps ? Id(1) : Id(2), runner = first_jumps ? Id(2) : Id(1);
    const AgentDeclaration ball{.limits = {1, 0}};
    const auto step = [&](double now) {
      detector.Advance(At(now));
      events.insert(events.end(), detector.events().begin(), detector.events().end());
      return detector.Earliest();
    };
    detector.Admit(Id(1), ball, State(0, {0, first_jumps ? 500.0 : 0.0, 0}, {0, 0, 0}), At(0));
    detector.Admit(Id(2), ball, State(0, {0, first_jumps ? 0.0 : 500.0, 0}, {0, 0, 0}), At(0));
    step(0);
    motion::MotionState jump = State(1, {-16, 0, 0}, {4, 0, 0});
    jump.discontinuity = true;
    detector.Update(jumper, jump, At(10));
    step(1);
    detector.Update(runner, State(10, {0, 0, 0}, {0, 0, 0}), At(10));
    detector.SetHeardUntil(OwnerOf(runner), At(10));
    detector.SetHeardUntil(OwnerOf(jumper), At(2));
    const EarliestAnswer earliest = step(2);
    ASSERT_TRUE(earliest.found);
    EXPECT_LE(earliest.earliest, At(4.5));
    for (double now = 2; now <= 8; now += 0.5) {
      if (now > 2)
        detector.Update(jumper, State(now, {-16 + 4 * (now - 1), 0, 0}, {4, 0, 0}), At(10));
      detector.SetHeardUntil(OwnerOf(jumper), At(now));
      step(now);
    }
    const auto confirmed = std::find_if(events.begin(), events.end(), [](const auto& event) {
      return event.status == EventStatus::kConfirmed;
    });
    ASSERT_NE(confirmed, events.end()) << "first jumps: " << first_jumps;
    EXPECT_LE(confirmed->begin.earliest, At(4.5));
    EXPECT_GE(confirmed->begin.latest, At(4.5));
  }
}

// With clocks that differ by 10 ms a jump may have come 10 ms before or after its stamp: what
// depends on which is neither confirmed nor denied.
TEST(Detector, NothingIsCertainWithinTheSkewAboutAJump) {
  for (const bool jumps_onto : {true, false}) {
    DetectorOptions options;
    options.skew = 0.01;
    Detector detector{options};
    std::vector<CollisionEvent> events;
    const AgentDeclaration ball{.limits = {1, 0}};
    const Vector3d here(0, 0, 0), away(0, 100, 0);
    detector.Admit(Id(1), ball, State(0, jumps_onto ? away : here, {0, 0, 0}), At(0));
    // The other passes the origin, touching only within 5 ms about 1 s.
    detector.Admit(Id(2), ball, State(0, {-1000, 0, 0}, {1000, 0, 0}), At(0));
    for (double now = 0.0625; now <= 2; now += 0.0625) {
      motion::MotionState state = State(now, (now >= 1) == jumps_onto ? here : away, {0, 0, 0});
      state.discontinuity = now == 1;
      detector.Update(Id(1), state, At(now));
      detector.Update(Id(2), State(now, {-1000 + 1000 * now, 0, 0}, {1000, 0, 0}), At(now));
      detector.SetHeardUntil(OwnerOf(Id(1)), At(now));
      detector.SetHeardUntil(OwnerOf(Id(2)), At(now));
      detector.Advance(At(now));
      events.insert(events.end(), detector.events().begin(), detector.events().end());
    }
    bool undecided = false;
    for (const CollisionEvent& event : events) {
      EXPECT_NE(event.status, EventStatus::kConfirmed) << "jumps onto: " << jumps_onto;
      undecided |= event.status == EventStatus::kUndecided && event.begin.earliest <= At(0.998) &&
                   event.end.latest >= At(1.002);
    }
    EXPECT_TRUE(undecided) << "jumps onto: " << jumps_onto;
  }
}

TEST(Detector, RefusesAgentsBeyondTheLimitAndUnknownOnes) {
  DetectorOptions options;
  options.agents_max = 1;
  Line line(options);
  EXPECT_TRUE(
      line.detector.Admit(Id(1), {.limits = {1, 1}}, State(0, {0, 0, 0}, {0, 0, 0}), At(0)));
  EXPECT_FALSE(
      line.detector.Admit(Id(1), {.limits = {1, 1}}, State(0, {0, 0, 0}, {0, 0, 0}), At(0)));
  EXPECT_FALSE(
      line.detector.Admit(Id(2), {.limits = {1, 1}}, State(0, {0, 0, 0}, {0, 0, 0}), At(0)));
  EXPECT_EQ(line.detector.Update(Id(2), State(0, {0, 0, 0}, {0, 0, 0}), At(0)),
            UpdateOutcome::kUnknown);
  EXPECT_EQ(line.detector.Update(Id(1), State(-1, {0, 0, 0}, {0, 0, 0}), At(0)),
            UpdateOutcome::kOlder);
}

}  // namespace
}  // namespace collision::detection
