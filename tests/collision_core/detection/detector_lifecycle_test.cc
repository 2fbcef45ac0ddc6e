// Goal:   each event goes through its life, with brackets that contain the truth.
// Method: few agents on lines, whose meetings are exact; states every 1/16 s, one clock.
#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

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
// Goal:   the end of a contact is published although no more states come.
// Method: two pass through each other and send nothing from the middle on, but their clocks go on.
//         From there |d| = 4 τ exceeds 2 + τ² after 0.59 s: then they are apart, whatever they do.
TEST(Detector, AContactEndsThoughNoMoreStatesCome) {
  Line line;
  line.Add(1, {0, 0, 0}, {2, 0, 0});
  line.Add(2, {10, 0, 0}, {-2, 0, 0});
  line.RunTo(2.5);
  ASSERT_FALSE(line.With(EventStatus::kConfirmed).empty());
  ASSERT_TRUE(line.With(EventStatus::kEnded).empty());
  for (; line.now < 5.75; line.now += 0.25) {
    for (const std::uint32_t slot : {1u, 2u})
      line.detector.SetHeardUntil(OwnerOf(Id(slot)), At(line.now));
    line.Step();
  }
  ASSERT_EQ(line.With(EventStatus::kEnded).size(), 1u);
  const CollisionEvent ended = line.With(EventStatus::kEnded)[0];
  EXPECT_LE(ended.end.earliest, At(3));
  EXPECT_GE(ended.end.latest, At(3));
  EXPECT_LE(ended.end.latest, At(3.1));
}

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

// If surfaces pass within a tenth of a millimetre, a contact between states can be neither excluded
// nor confirmed.
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

// They touched from 2.1 to 2.4 s and leave together at 3 s, known at 0 and 3 s only: the contact
// ends, and what could come after they have left is no news.
TEST(Detector, RemovalAnnouncesNothingNew) {
  Detector detector{DetectorOptions{}};
  const AgentDeclaration ball{.limits = {0.3, 0}};
  detector.Admit(Id(1), ball, State(0, {0, 0, 0}, {2, 0, 0}), At(0));
  detector.Admit(Id(2), ball, State(0, {9, 0, 0}, {-2, 0, 0}), At(0));
  detector.Advance(At(0));
  for (const std::uint32_t slot : {1u, 2u}) {
    detector.Update(Id(slot),
                    State(3, {slot == 1 ? 6.0 : 3.0, 0, 0}, {slot == 1 ? 2.0 : -2.0, 0, 0}), At(3));
    detector.SetHeardUntil(OwnerOf(Id(slot)), At(3));
    detector.Remove(Id(slot));
  }
  detector.Advance(At(3));
  ASSERT_FALSE(detector.events().empty());
  EXPECT_EQ(detector.events().back().status, EventStatus::kEnded);
  EXPECT_EQ(detector.events().back().contact, 1u);
  EXPECT_LE(detector.events().back().end.latest, At(2.4 + 1e-6));
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

// Without acceleration the meeting at 5 s is known from the start; it is announced 2 s ahead, not
// when it comes.
TEST(Detector, AnnouncesAsFarAheadAsConfigured) {
  Detector detector{DetectorOptions{}};
  detector.Admit(Id(1), {.limits = {1, 0}}, State(0, {-6, 0, 0}, {1, 0, 0}), At(0));
  detector.Admit(Id(2), {.limits = {1, 0}}, State(0, {6, 0, 0}, {-1, 0, 0}), At(0));
  detector.Advance(At(2.9375));
  EXPECT_TRUE(detector.events().empty());
  EXPECT_GE(detector.ClearanceOf(Id(1))->clear_until, At(5 - 1e-6));
  EXPECT_LE(detector.ClearanceOf(Id(1))->clear_until, At(5));
  detector.Advance(At(3.0625));
  ASSERT_EQ(detector.events().size(), 1u);
  EXPECT_EQ(detector.events()[0].status, EventStatus::kPossible);
}

// Between two states the owner's word "nothing else happened up to now" is enough to confirm.
TEST(Detector, ConfirmsBetweenStatesUpToTheReportedTime) {
  for (const bool heard : {true, false}) {
    Detector detector{DetectorOptions{}};
    std::size_t confirmed = 0;
    detector.Admit(Id(1), {.limits = {1, 0.01}}, State(0, {-6, 0, 0}, {1, 0, 0}), At(0));
    detector.Admit(Id(2), {.limits = {1, 0.01}}, State(0, {6, 0, 0}, {-1, 0, 0}), At(0));
    for (double now = 0; now <= 6; now += 1.0 / 16) {
      if (heard) {
        detector.SetHeardUntil(OwnerOf(Id(1)), At(now));
        detector.SetHeardUntil(OwnerOf(Id(2)), At(now));
      }
      detector.Advance(At(now));
      for (const CollisionEvent& event : detector.events()) {
        confirmed += event.status == EventStatus::kConfirmed;
      }
    }
    EXPECT_EQ(confirmed > 0, heard) << "a jump that is not reported yet may have come before";
  }
}

// What was confirmed stays confirmed, and ends, although the states after it were lost for seconds.
TEST(Detector, ConfirmedContactEndsAfterLostStates) {
  DetectorOptions options;
  options.history_max = 8;
  Detector detector{options};
  std::vector<CollisionEvent> events;
  const AgentDeclaration ball{.limits = {0.5, 0.1}};
  const auto send = [&](double t) {
    detector.Update(Id(1), State(t, {-20 + 2 * t, 0, 0}, {2, 0, 0}), At(t));
    detector.Update(Id(2), State(t, {20 - 2 * t, 0, 0}, {-2, 0, 0}), At(t));
  };
  const auto step = [&](double now) {
    detector.SetHeardUntil(OwnerOf(Id(1)), At(now));
    detector.SetHeardUntil(OwnerOf(Id(2)), At(now));
    detector.Advance(At(now));
    events.insert(events.end(), detector.events().begin(), detector.events().end());
  };
  detector.Admit(Id(1), ball, State(0, {-20, 0, 0}, {2, 0, 0}), At(0));
  detector.Admit(Id(2), ball, State(0, {20, 0, 0}, {-2, 0, 0}), At(0));
  for (double now = 0; now <= 9.75; now += 0.25) {
    send(now);
    step(now);
  }
  step(9.78125);
  ASSERT_EQ(events.back().status, EventStatus::kConfirmed);
  // The first agent's states come all at once, more than are kept; of the second's only the last.
  for (double t = 10; t < 16.5; t += 0.125) {
    detector.Update(Id(1), State(t, {-20 + 2 * t, 0, 0}, {2, 0, 0}), At(t));
  }
  send(16.5);
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

// Two contacts before the next state: the event is about the first until that is settled, then the
// second gets its own.
TEST(Detector, TwoContactsBetweenStatesAreTwoEvents) {
  Detector detector{DetectorOptions{}};
  std::vector<CollisionEvent> events;
  const AgentDeclaration ball{.limits = {1, 0}};
  detector.Admit(Id(1), ball, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  detector.Admit(Id(2), ball, State(0, {12, 0, 0}, {-40, 0, 0}), At(0));
  for (double now = 0.0625; now <= 3; now += 0.0625) {
    // It passes at 0.25..0.35 s, turns round at 0.5 s and passes again at 0.65..0.75 s.
    if (now <= 0.5) detector.Update(Id(2), State(now, {12 - 40 * now, 0, 0}, {-40, 0, 0}), At(now));
    if (now == 0.5) {
      motion::MotionState turn = State(0.5, {-8, 0, 0}, {40, 0, 0});
      turn.discontinuity = true;
      detector.Update(Id(2), turn, At(now));
    } else if (now > 0.5) {
      detector.Update(Id(2), State(now, {-8 + 40 * (now - 0.5), 0, 0}, {40, 0, 0}), At(now));
    }
    detector.SetHeardUntil(OwnerOf(Id(1)), At(now));
    detector.SetHeardUntil(OwnerOf(Id(2)), At(now));
    detector.Advance(At(now));
    events.insert(events.end(), detector.events().begin(), detector.events().end());
  }
  // The other spoke once only; it is not waited for for ever.
  std::vector<CollisionEvent> ended;
  for (const CollisionEvent& event : events) {
    if (event.status == EventStatus::kEnded) ended.push_back(event);
    if (event.contact == 1 && event.status == EventStatus::kConfirmed) {
      EXPECT_LE(event.begin.earliest, At(0.25));
      EXPECT_LE(event.begin.latest, At(0.26));
    }
  }
  ASSERT_EQ(ended.size(), 2u);
  EXPECT_EQ(ended[0].contact, 1u);
  EXPECT_LE(ended[0].end.earliest, At(0.35));
  EXPECT_GE(ended[0].end.latest, At(0.35));
  EXPECT_EQ(ended[1].contact, 2u);
  EXPECT_LE(ended[1].begin.earliest, At(0.65));
  EXPECT_GE(ended[1].begin.latest, At(0.65));
}

// A contact just before the owner leaves, reported in the same step, counts.
TEST(Detector, ContactBeforeLeavingIsConfirmed) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {3.03, 0, 0}, {-1, 0, 0});
  line.RunTo(1);
  line.now += 1.0 / 16;
  line.detector.Update(Id(1), State(line.now, {0, 0, 0}, {0, 0, 0}), At(line.now));
  line.detector.Update(Id(2), State(line.now, {3.03 - line.now, 0, 0}, {-1, 0, 0}), At(line.now));
  line.detector.Remove(Id(2));
  line.Step();
  ASSERT_EQ(line.With(EventStatus::kConfirmed).size(), 1u);
  EXPECT_LE(line.With(EventStatus::kConfirmed)[0].begin.earliest, At(1.03));
  EXPECT_GE(line.With(EventStatus::kConfirmed)[0].begin.latest, At(1.03));
  ASSERT_EQ(line.With(EventStatus::kEnded).size(), 1u);
}

// Two agents pass each other between two states a second apart: the states before confirm the
// contact, those after it narrow its brackets. The end waits for the next state of each agent.
TEST(Detector, AContactThatIsOverWaitsForTheStatesAfterIt) {
  Detector detector{DetectorOptions{}};
  const AgentDeclaration ball{.limits = {.radius = 1, .acceleration_max = 0.1}};
  const Vector3d p(4, 0, 0), v(-10, 0, 0);
  detector.Admit(Id(1), ball, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  detector.Admit(Id(2), ball, State(0, p, v), At(0));
  const auto hear = [&](double now) {
    detector.SetHeardUntil(OwnerOf(Id(1)), At(now));
    detector.SetHeardUntil(OwnerOf(Id(2)), At(now));
    detector.Advance(At(now));
  };
  hear(0.125);
  EXPECT_EQ(detector.ClearanceOf(Id(1))->unsettled_until, Instant::Always());
  hear(0.875);
  EXPECT_FALSE(detector.ClearanceOf(Id(1))->in_contact);
  for (const std::uint32_t slot : {1u, 2u}) {
    const Instant until = detector.ClearanceOf(Id(slot))->unsettled_until;
    EXPECT_GE(until, At(0.6)) << "they part then";
    EXPECT_LE(until, At(0.65));
  }
  detector.TakeChangedClearances();
  detector.Update(Id(1), State(1, {0, 0, 0}, {0, 0, 0}), At(1));
  hear(1);
  EXPECT_GE(detector.ClearanceOf(Id(2))->unsettled_until, At(0.6)) << "the other one is missing";
  detector.Update(Id(2), State(1, p + v, v), At(1));
  hear(1.125);
  EXPECT_EQ(detector.ClearanceOf(Id(1))->unsettled_until, Instant::Always());
  EXPECT_EQ(detector.ClearanceOf(Id(2))->unsettled_until, Instant::Always());
  EXPECT_EQ(detector.TakeChangedClearances().size(), 2u);
}

// One meeting is announced, the next one is not yet: the clearance says from when that may change.
TEST(Detector, TheClearanceSaysWhenOthersMayBeAnnounced) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {3, 0, 0}, {0, 0, 0});
  line.Add(3, {0, 18, 0}, {0, 0, 0});
  line.Step();
  const AgentClearance clearance = *line.detector.ClearanceOf(Id(1));
  EXPECT_GT(clearance.clear_until, At(0.99));
  EXPECT_LE(clearance.clear_until, At(1)) << "1 m, each at 1 m/s2";
  EXPECT_GT(clearance.unannounced_until, At(3.99));
  EXPECT_LE(clearance.unannounced_until, At(4)) << "16 m";
  EXPECT_EQ(line.detector.ClearanceOf(Id(3))->unannounced_until,
            line.detector.ClearanceOf(Id(3))->clear_until);
}

}  // namespace
}  // namespace collision::detection
