// Goal:   hypothetical agents are screened against real ones and nothing else: no pair of two real
//         or two hypothetical ones is looked at, what real ones have does not change, and without
//         hypothetical ones there is no such detector.
// Method: agents at rest and in straight motion, given to all detectors of a service.
#include "server/detectors/screening_detector.h"

#include <gtest/gtest.h>

#include "server/codec/hypothetical.h"
#include "server/config/config.h"
#include "server/detectors/detectors.h"

namespace collision::server {
namespace {

Instant At(double seconds) {
  return Instant::FromNanoseconds(static_cast<std::int64_t>(seconds * 1e9));
}

class ScreeningDetectorTest : public testing::Test {
 protected:
  static constexpr double kStep = 0.0625;

  struct Mover {
    detection::AgentId id;
    Eigen::Vector3d p, v;
    double since;
  };

  static detection::AgentId Id(std::uint32_t slot) { return {1 + slot, slot, 1, 1}; }

  /// A ball of 1 m with at most 1 m/s².
  void Add(std::uint32_t slot, bool hypothetical, const Eigen::Vector3d& p,
           const Eigen::Vector3d& v = {0, 0, 0}, const broad_phase::CollisionFilter& filter = {}) {
    detection::AgentDeclaration ball;
    ball.filter = filter;
    ball.limits.radius = 1;
    ball.limits.acceleration_max = 1;
    if (hypothetical) ball.filter.side = kHypotheticalSide;
    ASSERT_TRUE(detectors_.Admit(Id(slot), ball, StateOf({Id(slot), p, v, now_}), At(now_)));
    movers_.push_back({Id(slot), p, v, now_});
  }

  motion::MotionState StateOf(const Mover& mover) const {
    motion::MotionState state;
    state.stamp = At(now_);
    state.p_WA = mover.p + (now_ - mover.since) * mover.v;
    state.v_WA = mover.v;
    return state;
  }

  void Remove(std::uint32_t slot) {
    ASSERT_TRUE(detectors_.Remove(Id(slot)));
    std::erase_if(movers_, [&](const Mover& mover) { return mover.id == Id(slot); });
  }

  void Step() {
    detectors_.contacts().Advance(At(now_));
    detectors_.AdvanceScreening(At(now_), nullptr);
    detectors_.contacts().Validate();
    if (detectors_.screening() == nullptr) return;
    detectors_.screening()->detector().Validate();
    const auto& events = detectors_.screening()->detector().events();
    events_.insert(events_.end(), events.begin(), events.end());
  }

  void RunTo(double end) {
    while (now_ < end) {
      now_ += kStep;
      for (const Mover& mover : movers_) {
        const auto outcome = detectors_.Update(mover.id, StateOf(mover), At(now_));
        ASSERT_EQ(outcome, detection::UpdateOutcome::kKept);
        detectors_.SetHeardUntil(OwnerOf(mover.id), At(now_), Instant::Always());
      }
      Step();
    }
  }

  std::vector<detection::CollisionEvent> With(detection::EventStatus status) const {
    std::vector<detection::CollisionEvent> found;
    for (const auto& event : events_) {
      if (event.status == status) found.push_back(event);
    }
    return found;
  }

  const v1::Config config_ = CompleteConfig({});
  Detectors detectors_{config_};
  std::vector<Mover> movers_;
  std::vector<detection::CollisionEvent> events_;  ///< Of the screening.
  double now_ = 0;
};

// Goal:   the event has the true times, and says which of the two is hypothetical; it comes first
//         as a forecast, and the detector of contacts knows nothing of it.
TEST_F(ScreeningDetectorTest, FindsWhatAHypotheticalAgentWouldMeet) {
  Add(1, false, {0, 0, 0});
  Add(2, true, {22, 0, 0}, {-4, 0, 0});
  RunTo(8);
  ASSERT_FALSE(events_.empty());
  EXPECT_EQ(events_[0].status, detection::EventStatus::kPossible);
  EXPECT_LT(events_[0].now, At(5));
  const auto begun = With(detection::EventStatus::kConfirmed);
  ASSERT_FALSE(begun.empty());
  EXPECT_LE(begun.back().begin.earliest, At(5)) << "|22 - 4 t| = 2";
  EXPECT_GE(begun.back().begin.latest, At(5));
  EXPECT_EQ(With(detection::EventStatus::kEnded).size(), 1u);
  EXPECT_EQ(begun[0].lower_side, kRealSide);
  EXPECT_EQ(begun[0].higher_side, kHypotheticalSide);
  EXPECT_EQ(detectors_.contacts().agents(), 1u);
  EXPECT_EQ(detectors_.agents(), 2u);
  EXPECT_EQ(detectors_.contacts().counters().pair_queries, 0u);
}

TEST_F(ScreeningDetectorTest, ComparesNoTwoRealAgents) {
  for (std::uint32_t slot = 0; slot < 25; ++slot) {
    Add(slot, false, {2.5 * (slot % 5), 2.5 * (slot / 5), 0});
  }
  Add(25, true, {0, 0, 4}, {0, 0, 0}, {.group = 2, .mask = 2});
  RunTo(0.5);
  ASSERT_GT(detectors_.contacts().pairs_tracked(), 25u) << "they are all but in contact";
  const detection::Detector& screening = detectors_.screening()->detector();
  EXPECT_EQ(screening.counters().pair_queries, 0u);
  EXPECT_EQ(screening.counters().segments, 0u);
  EXPECT_EQ(screening.pairs_tracked(), 0u);
  Add(26, true, {0, 0, 4});
  RunTo(1);
  EXPECT_GT(screening.pairs_tracked(), 0u);
  EXPECT_LE(screening.pairs_tracked(), 25u) << "one partner has all pairs";
  for (const auto& event : events_) EXPECT_EQ(event.higher, Id(26));
}

TEST_F(ScreeningDetectorTest, NoTwoHypotheticalAgentsMeet) {
  Add(1, true, {0, 0, 0});
  Add(2, true, {0.5, 0, 0});
  RunTo(1);
  EXPECT_TRUE(events_.empty());
  EXPECT_EQ(detectors_.screening()->detector().counters().pair_queries, 0u);
  for (const auto& one : detectors_.screening()->TakeChangedClearances()) {
    EXPECT_TRUE(one.clear_until.is_never());
  }
}

TEST_F(ScreeningDetectorTest, GivesClearancesOfHypotheticalAgentsOnly) {
  Add(1, false, {0, 0, 0});
  Add(2, true, {3, 0, 0});
  RunTo(0.5);
  const auto changed = detectors_.screening()->TakeChangedClearances();
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].agent, Id(2));
  EXPECT_LT(changed[0].clear_until, At(2)) << "1 m/s² each, 1 m apart";
}

// Goal:   it begins with what the real agents do, and ends when the last hypothetical one and its
//         events are gone.
TEST_F(ScreeningDetectorTest, IsThereWhileThereAreHypotheticalAgents) {
  Add(1, false, {22, 0, 0}, {-4, 0, 0});
  RunTo(1);
  EXPECT_EQ(detectors_.screening(), nullptr);
  Add(2, true, {0, 0, 0});
  RunTo(5.25);
  EXPECT_EQ(With(detection::EventStatus::kConfirmed)[0].lower, Id(1));
  EXPECT_TRUE(With(detection::EventStatus::kEnded).empty());
  Remove(2);
  EXPECT_EQ(detectors_.agents(), 1u);
  RunTo(5.5);
  EXPECT_EQ(With(detection::EventStatus::kEnded).size(), 1u);
  EXPECT_EQ(detectors_.screening(), nullptr);
  Add(3, true, {4, 0, 0});
  EXPECT_NE(detectors_.screening(), nullptr);
  detectors_.BeginEpoch();
  EXPECT_EQ(detectors_.screening(), nullptr);
}

// Goal:   a breach is explained by the detector that has the agent.
TEST_F(ScreeningDetectorTest, ExplainsTheBreachOfEitherKind) {
  Add(1, false, {0, 0, 0});
  Add(2, true, {1000, 0, 0});
  Step();
  now_ = 1;
  for (const std::uint32_t slot : {1u, 2u}) {
    const motion::MotionState state = StateOf({Id(slot), {100.0 * slot, 0, 0}, {0, 0, 0}, now_});
    ASSERT_EQ(detectors_.Update(Id(slot), state, At(1)), detection::UpdateOutcome::kBreached);
    EXPECT_GE(detectors_.ExplainLastBreach(Id(slot)).seen, slot == 1 ? 200 : 1600);
  }
  EXPECT_EQ(detectors_.counted().breaches, 1u);
}

}  // namespace
}  // namespace collision::server
