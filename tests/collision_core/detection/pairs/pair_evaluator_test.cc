// Goal:   the three horizons of a pair: what is settled is final, what is heard is a preview, and
//         beyond it only freedom is promised.
// Method: one unit ball passes through another at 8 m/s without acceleration, so that they touch
//         from 1 s to 1.5 s exactly; the time heard and the time of the step vary.
#include "collision_core/detection/pairs/pair_evaluator.h"

#include <gtest/gtest.h>

#include "collision_core/detection/agents/agent_table.h"
#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

constexpr double kBegin = 1, kEnd = 1.5;  // of the contact [s]

class PairEvaluatorTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const AgentIndex agent : {a_, b_}) {
      agents_.Admit(Id(agent.value()), {.limits = {.radius = 1}}, At(0));
      StoreAt(agent, 0);
    }
  }

  /// The agent's state at this time.
  void StoreAt(AgentIndex agent, double t) {
    const double speed = agent == a_ ? 0 : -8, x = agent == a_ ? 0 : 10;
    agents_.Store(agent, State(t, {x + speed * t, 0, 0}, {speed, 0, 0}), Link::kFollows);
  }

  ContactTracker Evaluate(double now, double heard, Finality finality = Finality::kOngoing) {
    for (const AgentIndex agent : {a_, b_}) {
      agents_.SetHeardUntil(OwnerOf(Id(agent.value())), At(heard));
    }
    clock_.now = At(now);
    WorkBudget work(1000);
    return evaluator_.Evaluate({agents_[a_], agents_[b_], pair_}, finality, &work);
  }

  static void ExpectTheContact(const ContactEpisode& episode) {
    EXPECT_TRUE(episode.contact);
    EXPECT_LE(episode.begin.earliest, At(kBegin));
    EXPECT_GE(episode.begin.latest, At(kBegin));
    EXPECT_LE(episode.end.earliest, At(kEnd));
    EXPECT_GE(episode.end.latest, At(kEnd));
  }

  const AgentIndex a_{0u}, b_{1u};
  StepClock clock_{.now = At(0), .step = 7, .announce_within = 2};
  AgentTable agents_{{}};
  DetectorCounters counters_;
  IndexSet<AgentIndex> dirty_;
  PairEvaluator evaluator_{{clock_, agents_, &counters_, &dirty_}};
  PairRecord pair_{
      .lower = a_, .higher = b_, .tracker = ContactTracker(At(0), Past::kKnown), .clear_until = {}};
};

TEST_F(PairEvaluatorTest, WaitsForAStateAsLongAsEventsAreAnnouncedOrTwiceTheLastInterval) {
  EXPECT_EQ(evaluator_.LongestWaitFor(agents_[a_]), 2);
  StoreAt(a_, 3);
  EXPECT_EQ(evaluator_.LongestWaitFor(agents_[a_]), 6);
  StoreAt(a_, 3.5);
  EXPECT_EQ(evaluator_.LongestWaitFor(agents_[a_]), 2);
}

TEST_F(PairEvaluatorTest, AContactIsHeardBeforeItIsSettled) {
  const ContactTracker preview = Evaluate(1.25, 1.25);
  EXPECT_EQ(pair_.tracker.at(), At(0)) << "a state may still come";
  EXPECT_EQ(preview.at(), At(1.25));
  ASSERT_TRUE(preview.in_contact());
  EXPECT_LE(preview.episode().begin.earliest, At(kBegin));
  EXPECT_GE(preview.episode().begin.latest, At(kBegin));
}

TEST_F(PairEvaluatorTest, NewStatesOfBothSettleWhatLiesBeforeThem) {
  StoreAt(a_, 3);
  Evaluate(3, 3);
  EXPECT_TRUE(pair_.tracker.finished().empty()) << "B's next state may still come";
  StoreAt(b_, 3);
  const ContactTracker preview = Evaluate(3, 3);
  EXPECT_EQ(pair_.tracker.TakeFinished().size(), 1u);
  EXPECT_TRUE(preview.finished().empty()) << "settled episodes are not heard once more";
}

TEST_F(PairEvaluatorTest, WithoutNewStatesTimeIsSettledWhenPatienceEnds) {
  Evaluate(3, 1.25);
  EXPECT_EQ(pair_.tracker.at(), At(1));
  Evaluate(4, 1.25);
  EXPECT_EQ(pair_.tracker.at(), At(1.25)) << "time that was not heard is not settled";
  Evaluate(4, 4);
  ASSERT_EQ(pair_.tracker.finished().size(), 1u);
  ExpectTheContact(pair_.tracker.finished()[0]);
}

TEST_F(PairEvaluatorTest, BeyondTheTimeHeardFreedomIsPromised) {
  const ContactTracker preview = Evaluate(0.5, 0.5);
  EXPECT_TRUE(preview.free());
  EXPECT_LE(preview.free_until(), At(kBegin));
  EXPECT_GT(preview.free_until(), At(kBegin - 1e-6));
  EXPECT_EQ(pair_.tracker.free_until(), preview.free_until());
  EXPECT_EQ(pair_.canonical, preview.free_until());
  EXPECT_EQ(pair_.canonical_step, 7u);
  EXPECT_EQ(counters_.pair_queries, 1u);
}

TEST_F(PairEvaluatorTest, APromiseFromBeforeNowIsNotTheCanonicalAnswerOfTheStep) {
  const ContactTracker preview = Evaluate(0.5, 0.25);
  EXPECT_LE(preview.free_until(), At(kBegin));
  EXPECT_GT(preview.free_until(), At(kBegin - 1e-6));
  EXPECT_TRUE(pair_.canonical.is_never());
}

TEST_F(PairEvaluatorTest, TheLastEvaluationSettlesWhatWasHeardAndPromisesNothing) {
  EXPECT_EQ(Evaluate(0.5, 0.5, Finality::kLast).free_until(), At(0.5));
  EXPECT_EQ(counters_.pair_queries, 0u);
  pair_.tracker = ContactTracker(At(0.5), Past::kKnown);
  Evaluate(1.25, 1.25, Finality::kLast);
  EXPECT_EQ(pair_.tracker.at(), At(1.25));
  EXPECT_TRUE(pair_.tracker.in_contact());
}

TEST_F(PairEvaluatorTest, RefusesAgentsThatCannotMeet) {
  agents_[b_].declaration.filter.mask = 0;
  EXPECT_THROW(Evaluate(0.5, 0.5), CheckFailure);
}

// Goal:   a contact that lies after now is recorded until it has passed.
TEST_F(PairEvaluatorTest, RecordsAContactAhead) {
  StoreAt(a_, 3);
  StoreAt(b_, 3);
  const ContactTracker preview = Evaluate(0.5, 3);
  RecordContactAhead(preview, At(0.5), &pair_);
  EXPECT_LE(pair_.ahead_from, At(kBegin));
  EXPECT_GE(pair_.ahead_until, At(kEnd));
  EXPECT_LT(pair_.ahead_until, At(3));
  RecordContactAhead(preview, At(2), &pair_);
  EXPECT_TRUE(pair_.ahead_from.is_never() && pair_.ahead_until.is_never());
}

}  // namespace
}  // namespace collision::detection
