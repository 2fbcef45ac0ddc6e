#include "client/checker/check.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace collision::checker {
namespace {

constexpr std::int64_t kOpen = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kSecond = 1'000'000'000;

// Two balls of 0.5 m on the x axis: a rests at 10 m, b comes from 0 at 1 m/s and goes on for 20 s,
// in pieces of one second. They touch from 9 s to 11 s. c is far away.
class CheckTest : public testing::Test {
 protected:
  CheckTest() {
    std::ostringstream log;
    log << "motion-log 1\nagent a 0.5\nagent b 0.5\nagent c 0.5\n";
    for (int i = 0; i < 20; ++i) {
      const std::int64_t t0 = i * kSecond, t1 = t0 + kSecond;
      log << "piece a " << t0 << ' ' << t1 << " 10 0 0 0 0 0 0 0 0 0 0 0\n";
      log << "piece b " << t0 << ' ' << t1 << ' ' << i << " 1 0 0 0 0 0 0 0 0 0 0\n";
      log << "piece c " << t0 << ' ' << t1 << " 0 0 0 0 99 0 0 0 0 0 0 0\n";
    }
    std::istringstream text(log.str());
    motions_ = ReadMotionLog(text, "sim");
    for (std::uint32_t slot = 0; slot < 3; ++slot) {
      v1::AgentName name;
      *name.mutable_id() = Id(slot);
      name.set_simulator("sim");
      name.set_agent(std::string(1, static_cast<char>('a' + slot)));
      observations_.names.push_back(name);
    }
    Add(1, 7 * kSecond, v1::EVENT_POSSIBLE, {8.9, -1}, {-1, -1});
    Add(2, 10 * kSecond, v1::EVENT_CONFIRMED, {8.999, 9.001}, {-1, -1});
    Add(3, 12 * kSecond, v1::EVENT_ENDED, {8.999, 9.001}, {10.999, 11.001});
  }

  static v1::AgentId Id(std::uint32_t slot) {
    v1::AgentId id;
    id.set_simulator_id(5);
    id.set_run(1);
    id.set_slot(slot);
    id.set_generation(1);
    return id;
  }

  static std::int64_t Instant(double seconds) {
    return seconds < 0 ? kOpen : static_cast<std::int64_t>(seconds * 1e9);
  }

  /// A bracket in seconds; an end that is negative is open.
  struct Bracket {
    double earliest, latest;
  };

  void Add(std::uint32_t revision, std::int64_t now_ns, v1::EventStatus status,
           const Bracket& begin, const Bracket& end) {
    v1::CollisionEvent event;
    *event.mutable_lower() = Id(0);
    *event.mutable_higher() = Id(1);
    event.set_contact(1);
    event.set_revision(revision);
    event.set_now_ns(now_ns);
    event.set_status(status);
    event.set_continuous(true);
    event.clear_proximity();
    event.mutable_begin()->set_earliest_ns(Instant(begin.earliest));
    event.mutable_begin()->set_latest_ns(Instant(begin.latest));
    event.mutable_end()->set_earliest_ns(Instant(end.earliest));
    event.mutable_end()->set_latest_ns(Instant(end.latest));
    observations_.events.push_back(event);
  }

  void AddClearance(std::uint32_t slot, std::int64_t now_ns, std::int64_t clear_until_ns) {
    v1::Clearance sample;
    sample.set_simulator_id(5);
    sample.set_run(1);
    sample.set_now_ns(now_ns);
    auto* agent = sample.add_agents();
    agent->set_slot(slot);
    agent->set_generation(1);
    agent->set_clear_until_ns(clear_until_ns);
    agent->set_void_from_ns(kOpen);
    agent->set_effective_from_ns(std::numeric_limits<std::int64_t>::min());
    observations_.clearances.push_back(sample);
  }

  void AddEarliest(std::int64_t now_ns, bool found, std::int64_t earliest_ns) {
    v1::EarliestIntersection sample;
    sample.set_now_ns(now_ns);
    sample.set_found(found);
    sample.set_earliest_ns(earliest_ns);
    observations_.earliest.push_back(sample);
  }

  // The violations, one per line.
  std::string Verdict(const v1::SceneExpectation& expectation = {}) const {
    std::string text;
    for (const auto& violation : Check(Evidence(motions_, observations_, facts_), expectation)) {
      text += violation + "\n";
    }
    return text;
  }

  std::vector<AgentMotion> motions_;
  Observations observations_;
  RunFacts facts_;
};

// Goal:   an honest run satisfies it, and its truth is the closed form.
TEST_F(CheckTest, HonestRunIsSatisfied) {
  AddClearance(0, kSecond, 5 * kSecond);
  AddClearance(2, kSecond, 20 * kSecond);
  AddEarliest(kSecond, true, 9 * kSecond);
  EXPECT_EQ(Verdict(), "");
  const Evidence evidence(motions_, observations_, facts_);
  ASSERT_EQ(evidence.contacts().size(), 1u);
  EXPECT_NEAR(static_cast<double>(evidence.contacts()[0].begin_ns), 9e9, 1e-2);
  EXPECT_NEAR(static_cast<double>(evidence.contacts()[0].end_ns), 11e9, 1e-2);
  EXPECT_EQ(ContactsUnannounced(evidence), 0u);
  const auto tightness = ClearanceTightness(evidence);
  ASSERT_EQ(tightness.size(), 1u);
  EXPECT_NEAR(tightness[0], 0.5, 1e-9);
}

// Goal:   a contact is announced as long before, and as tightly, as its first revision was.
TEST_F(CheckTest, AnnouncementsAreMeasuredByTheFirstRevision) {
  Add(4, 12 * kSecond, v1::EVENT_ENDED, {8.9995, 9.0005}, {10.999, 11.001});
  const auto announcements = Announcements(Evidence(motions_, observations_, facts_));
  ASSERT_EQ(announcements.size(), 1u);
  EXPECT_NEAR(announcements[0].lead_s, 2, 1e-8);
  EXPECT_NEAR(announcements[0].tightness, 0.95, 1e-8);
  observations_.events[0].set_now_ns(9 * kSecond + 10);
  EXPECT_EQ(Announcements(Evidence(motions_, observations_, facts_)).size(), 0u);
}

TEST_F(CheckTest, MissingEventIsNoticed) {
  observations_.events.clear();
  EXPECT_NE(Verdict().find("no event of the pair"), std::string::npos);
  EXPECT_EQ(ContactsUnannounced(Evidence(motions_, observations_, facts_)), 1u);
}

TEST_F(CheckTest, DismissedContactIsNoticed) {
  observations_.events.resize(1);
  Add(2, 12 * kSecond, v1::EVENT_DISMISSED, {8.9, -1}, {-1, -1});
  EXPECT_NE(Verdict().find("no event brackets its begin"), std::string::npos);
}

// Goal:   an announcement just after the begin is late, one at the begin is not.
TEST_F(CheckTest, LateAnnouncementIsNoticed) {
  observations_.events[0].set_now_ns(9 * kSecond);
  EXPECT_EQ(Verdict(), "");
  observations_.events[0].set_now_ns(9 * kSecond + 10);
  EXPECT_NE(Verdict().find("announced late, at 9.000000010 s"), std::string::npos);
}

// Goal:   contacts that a late admission or jump causes inside granted time are excused, if that is
//         published.
TEST_F(CheckTest, LateAnnouncementInGrantedTimeIsExcused) {
  observations_.events[0].set_now_ns(9 * kSecond + 10);
  AddClearance(1, 8 * kSecond, 8 * kSecond);
  observations_.clearances.back().mutable_agents(0)->set_effective_from_ns(10 * kSecond);
  EXPECT_EQ(Verdict(), "");
  observations_.clearances.back().mutable_agents(0)->set_effective_from_ns(8 * kSecond);
  EXPECT_NE(Verdict(), "");
}

// Goal:   a contact after a jump within time granted before cannot be announced in time if the
//         simulator passes that time at once; then it is announced as soon as the jump arrives.
TEST_F(CheckTest, AJumpInGrantedTimeIsAnnouncedWithItsFirstSample) {
  const auto verdict = [this](std::int64_t jump_s10, std::int64_t granted_s10,
                              std::uint64_t sequence) {
    observations_.clearances.clear();
    motions_[1].jumps_ns = {jump_s10 * kSecond / 10};
    AddClearance(1, 8 * kSecond, 8 * kSecond);
    observations_.clearances.back().set_granted_until_ns(granted_s10 * kSecond / 10);
    AddClearance(1, 9 * kSecond + 10, 9 * kSecond);
    observations_.clearances.back().mutable_stamp()->set_sequence(6);
    observations_.clearances.back().mutable_agents(0)->set_effective_from_ns(10 * kSecond);
    observations_.events[0].set_now_ns(9 * kSecond + 10);
    observations_.events[0].mutable_stamp()->set_sequence(sequence);
    return Verdict();
  };
  EXPECT_EQ(verdict(85, 95, 5), "");
  for (const std::string& late : {verdict(85, 95, 7), verdict(85, 89, 5), verdict(91, 95, 5)}) {
    EXPECT_NE(late.find("announced late"), std::string::npos) << late;
  }
  EXPECT_EQ(verdict(80, 95, 5), "");
  EXPECT_NE(verdict(79, 95, 5), "");
}

// Goal:   brackets that miss their truth by more than the checker's own tolerance are noticed, on
// either side.
TEST_F(CheckTest, WrongBeginBracketIsNoticed) {
  for (const auto& [earliest, latest, good] : {std::tuple{9 * kSecond, 10 * kSecond, true},
                                               {8 * kSecond, 9 * kSecond, true},
                                               {9 * kSecond + 5, 10 * kSecond, false},
                                               {8 * kSecond, 9 * kSecond - 5, false}}) {
    for (int i = 1; i < 3; ++i) {
      observations_.events[i].mutable_begin()->set_earliest_ns(earliest);
      observations_.events[i].mutable_begin()->set_latest_ns(latest);
    }
    EXPECT_EQ(Verdict().empty(), good) << earliest << ' ' << latest;
    if (good) continue;
    EXPECT_NE(Verdict().find("but no true contact begins there"), std::string::npos);
  }
}

TEST_F(CheckTest, WrongEndBracketIsNoticed) {
  observations_.events[2].mutable_end()->set_latest_ns(11 * kSecond - 5);
  EXPECT_NE(Verdict().find("its end is not in the published bracket"), std::string::npos);
}

// Goal:   a contact in progress may end when an agent leaves, but not before it can have left.
TEST_F(CheckTest, ADepartureEndsAContact) {
  facts_.leaving_ns = 10 * kSecond;  // from 10 s on
  const auto told_to_end = [this](double earliest, double latest) {
    observations_.events.pop_back();
    Add(3, 12 * kSecond, v1::EVENT_ENDED, {8.999, 9.001}, {earliest, latest});
    return Verdict();
  };
  EXPECT_EQ(told_to_end(10.5, 10.8), "");
  EXPECT_NE(told_to_end(9.5, 9.9).find("end is not in"), std::string::npos);
}

// Goal:   nothing is promised of an agent that has left; until it can have left, all is.
TEST_F(CheckTest, ADepartureExcusesPromisesFromThenOn) {
  observations_.events.erase(observations_.events.begin());
  facts_.leaving_ns = 12 * kSecond;  // from 8 s on
  AddClearance(0, 8 * kSecond, 12 * kSecond);
  AddEarliest(8 * kSecond, false, kOpen);
  const std::string announced = Verdict();
  AddClearance(0, 8 * kSecond - 1, 12 * kSecond);
  AddEarliest(8 * kSecond - 1, false, kOpen);
  EXPECT_EQ(announced.find("promised"), std::string::npos) << announced;
  EXPECT_EQ(announced.find("earliest"), std::string::npos) << announced;
  EXPECT_NE(Verdict().find("promised"), std::string::npos);
  EXPECT_NE(Verdict().find("earliest"), std::string::npos);
}

// The balls are |10 s − t| − 1 m apart: they are nearest at 10 s, 1 m inside each other.
TEST_F(CheckTest, AWrongClosestApproachIsNoticed) {
  struct Told {
    double from, until, earliest, latest, lower, upper;
    const char* complaint;
  };
  for (const Told& told :
       {Told{8, 12, 9.9, 10.1, -1.01, -0.99, ""}, Told{8, 12, 8, 12, -2, 0, ""},
        Told{8, 9.5, 9.5, 9.5, -0.5, -0.5, ""}, Told{8, 12, 9.9, 10.1, -0.99, -0.5, "at least"},
        Told{8, 12, 9.9, 10.1, -1.3, -1.2, "at most"},
        Told{8, 12, 8, 9.5, -1.01, -0.9, "nearer than while"}}) {
    v1::ClosestApproach* closest = observations_.events[2].mutable_closest();
    closest->set_from_ns(Instant(told.from));
    closest->set_until_ns(Instant(told.until));
    closest->mutable_at()->set_earliest_ns(Instant(told.earliest));
    closest->mutable_at()->set_latest_ns(Instant(told.latest));
    closest->mutable_distance_m()->set_lower(told.lower);
    closest->mutable_distance_m()->set_upper(told.upper);
    const std::string verdict = Verdict();
    EXPECT_EQ(verdict.empty(), *told.complaint == '\0') << verdict;
    EXPECT_NE(verdict.find(told.complaint), std::string::npos) << verdict;
  }
}

TEST_F(CheckTest, EventThatNeverEndsIsNoticed) {
  observations_.events.resize(2);
  EXPECT_NE(Verdict().find("never ended"), std::string::npos);
}

// Goal:   a contact inside an undecided event, or in a gap of a confirmed one, counts as announced.
TEST_F(CheckTest, UndecidedAndGapsCover) {
  observations_.events.resize(1);
  Add(2, 12 * kSecond, v1::EVENT_UNDECIDED, {8.9, 11.1}, {8.9, 11.1});
  EXPECT_EQ(Verdict(), "");
  observations_.events.back().mutable_end()->set_latest_ns(Instant(8.99));
  EXPECT_NE(Verdict(), "");
  observations_.events.resize(1);
  Add(2, 12 * kSecond, v1::EVENT_ENDED, {5, 6}, {10, 11.1});
  EXPECT_NE(Verdict(), "");
  observations_.events.back().set_continuous(false);
  EXPECT_EQ(Verdict(), "");
}

TEST_F(CheckTest, FalseConfirmIsNoticed) {
  v1::CollisionEvent event = observations_.events[1];
  *event.mutable_higher() = Id(2);
  observations_.events.push_back(event);
  EXPECT_NE(Verdict().find("a × c: confirmed"), std::string::npos);
}

// Goal:   a clearance that reaches past a contact is wrong, unless the pair was announced by then.
TEST_F(CheckTest, BrokenClearanceIsNoticed) {
  AddClearance(1, 6 * kSecond, 9 * kSecond + 10);
  EXPECT_NE(Verdict().find("b: at 6.000000000 s clear until 9.000000010 s was promised"),
            std::string::npos);
  observations_.clearances.clear();
  AddClearance(1, 8 * kSecond, 12 * kSecond);
  EXPECT_EQ(Verdict(), "");
}

// Goal:   a jump after the promise excuses it; one before does not.
TEST_F(CheckTest, JumpSinceExcusesAClearance) {
  AddClearance(1, 6 * kSecond, 20 * kSecond);
  motions_[1].jumps_ns = {5 * kSecond};
  EXPECT_NE(Verdict(), "");
  motions_[1].jumps_ns = {6 * kSecond};
  EXPECT_EQ(Verdict(), "");
}

TEST_F(CheckTest, BreachOfHonestMotionIsNoticed) {
  AddClearance(1, 6 * kSecond, 6 * kSecond);
  observations_.clearances.back().mutable_agents(0)->set_cause(v1::CAUSE_BREACH);
  observations_.clearances.back().mutable_agents(0)->set_void_from_ns(6 * kSecond);
  EXPECT_NE(Verdict().find("published as void"), std::string::npos);
}

TEST_F(CheckTest, LateEarliestIsNoticed) {
  AddEarliest(10 * kSecond, false, kOpen);
  EXPECT_EQ(Verdict(), "");
  AddEarliest(3 * kSecond, true, 9 * kSecond + 10);
  EXPECT_NE(Verdict().find("the earliest intersection was 9.000000010 s"), std::string::npos);
  observations_.earliest.clear();
  AddEarliest(3 * kSecond, false, kOpen);
  EXPECT_NE(Verdict().find("the earliest intersection was none"), std::string::npos);
}

// Several steps may have one time: the next contact of the pair counts only from the step on that
// no longer reports it in contact.
TEST_F(CheckTest, TheStampsOrderSamplesOfEqualTime) {
  const std::string late = "the earliest intersection was none";
  observations_.events.clear();
  Add(1, 7 * kSecond, v1::EVENT_CONFIRMED, {6.5, 6.75}, {6.75, -1});
  Add(2, 8 * kSecond, v1::EVENT_ENDED, {6.5, 6.75}, {7.5, 7.75});
  AddEarliest(8 * kSecond, false, kOpen);
  EXPECT_NE(Verdict().find(late), std::string::npos);
  for (const std::uint64_t sequence : {3, 4, 6}) {
    observations_.events[0].mutable_stamp()->set_sequence(2);
    observations_.events[1].mutable_stamp()->set_sequence(5);
    observations_.earliest[0].mutable_stamp()->set_sequence(sequence);
    EXPECT_EQ(Verdict().find(late) == std::string::npos, sequence < 5) << sequence;
  }
  observations_.earliest[0].mutable_stamp()->set_sequence(1);
  EXPECT_NE(Verdict().find(late), std::string::npos);
}

// Goal:   what a scene expects is demanded: the contact, its brackets' widths, no other, the
// earliest times.
TEST_F(CheckTest, SceneExpectationIsDemanded) {
  AddEarliest(3 * kSecond, true, Instant(8.5));
  v1::SceneExpectation expectation;
  auto* contact = expectation.add_contacts();
  contact->set_a("b");
  contact->set_b("a");
  contact->set_begin_s(9);
  contact->set_end_s(11);
  contact->set_tolerance_s(1e-6);
  expectation.set_no_other_contact(true);
  expectation.set_begin_width_max_s(0.0021);
  auto* earliest = expectation.add_earliest();
  earliest->set_at_least_s(8);
  earliest->set_at_most_s(9);
  EXPECT_EQ(Verdict(expectation), "");

  expectation.set_begin_width_max_s(0.0019);
  EXPECT_NE(Verdict(expectation).find("begin bracket is 0.002000 s wide"), std::string::npos);
  expectation.set_begin_width_max_s(0);
  earliest->set_at_least_s(8.6);
  EXPECT_NE(Verdict(expectation).find("expected within [8.600000000 s"), std::string::npos);
  earliest->set_at_least_s(0);
  contact->set_begin_s(9.1);
  EXPECT_NE(Verdict(expectation).find("no confirmed event brackets it"), std::string::npos);
  EXPECT_NE(Verdict(expectation).find("expects no such contact"), std::string::npos);

  observations_.events.clear();
  expectation.clear_no_other_contact();
  facts_.end_ns = 12 * kSecond;
  EXPECT_NE(Verdict(expectation).find("no confirmed event brackets it"), std::string::npos);
  facts_.end_ns = 10 * kSecond;
  EXPECT_EQ(Verdict(expectation).find("no confirmed event brackets it"), std::string::npos);
}

// Goal:   contacts that the service had no time to decide are not demanded.
// Method: the logs end at 9.5 s, in the contact; the last piece of a second is the fair allowance.
TEST_F(CheckTest, ContactAtTheRunsEndIsNotDemanded) {
  observations_.events.resize(1);
  for (AgentMotion& motion : motions_) {
    motion.pieces.resize(10);
    motion.pieces.back().t1_ns = 9'500'000'000;
  }
  EXPECT_EQ(Verdict(), "");
}

}  // namespace
}  // namespace collision::checker
