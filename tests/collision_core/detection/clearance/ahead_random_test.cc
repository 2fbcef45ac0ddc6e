// Goal:   no clearance lies beyond a meeting, however far ahead states lie and whichever agents
//         have no room for pairs.
// Method: random histories of agents on lines, of accelerations of every magnitude, with states
//         ahead, jumps, weaker promises, new declarations and departures; against the canonical
//         routine for every pair, and the true places up to the newest states.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/numeric/seconds.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"

namespace collision::detection {
namespace {

constexpr std::uint64_t kHistories = kSanitized ? 20 : 60;

/// A line from a stamp on, up to the next one.
struct Leg {
  Instant from;
  Vector3d p, v;
};

struct Agent {
  motion::SpaceTimeBound bound;
  std::vector<Leg> legs;

  Vector3d PlaceAt(Instant t) const {
    const Leg* leg = &legs.front();
    for (const Leg& next : legs) {
      if (next.from <= t) leg = &next;
    }
    return leg->p + numeric::SecondsBetween(leg->from, t).middle() * leg->v;
  }
};

class History {
 public:
  explicit History(std::uint64_t seed) : random_(seed), detector_(Options()) {}

  void Step() {
    now_ = numeric::AddRoundedUp(now_, 0.1 * options_.announce_within * random_.Uniform(0.2, 4));
    while (agents_.size() < wanted_) Admit();
    std::vector<std::uint32_t> gone;
    for (auto& [slot, agent] : agents_) {
      if (random_.Chance(0.3)) SendState(slot, &agent);
      if (random_.Chance(0.01)) gone.push_back(slot);
    }
    for (const std::uint32_t slot : gone) {
      detector_.Remove(Id(slot));
      agents_.erase(slot);
    }
    for (const auto& [slot, agent] : agents_) detector_.SetHeardUntil(OwnerOf(Id(slot)), now_);
    if (random_.Chance(0.2)) detector_.Earliest();
    detector_.Advance(now_);
    detector_.Validate();
    for (const CollisionEvent& event : detector_.events()) {
      told_[{event.lower.slot, event.higher.slot}].push_back(event);
    }
  }

  void Judge() {
    for (auto a = agents_.begin(); a != agents_.end(); ++a) {
      for (auto b = std::next(a); b != agents_.end(); ++b) JudgePair(*a, *b);
    }
  }

  int saturated = 0, ahead = 0;

 private:
  using Entry = std::pair<const std::uint32_t, Agent>;

  DetectorOptions Options() {
    options_.announce_within = random_.LogUniform(0.1, 1);
    options_.temporal_resolution = options_.announce_within / 64;
    if (random_.Chance(0.5)) {
      options_.pairs_per_agent_max = 1 + static_cast<std::uint32_t>(random_.Below(3));
    }
    return options_;
  }

  Vector3d Place() { return random_.Uniform(0, box_) * random_.UnitVector(); }

  AgentDeclaration Declaration() {
    AgentDeclaration declaration;
    declaration.limits.radius = random_.LogUniform(0.2, 3);
    declaration.limits.acceleration_max = random_.Chance(0.3) ? 0 : random_.LogUniform(1e-3, 1e3);
    return declaration;
  }

  void Admit() {
    const std::uint32_t slot = slots_++;
    motion::MotionState state;
    state.stamp = now_;
    state.p_WA = Place();
    state.v_WA = random_.Uniform(0, 20) * random_.UnitVector();
    const AgentDeclaration declaration = Declaration();
    ASSERT_TRUE(detector_.Admit(Id(slot), declaration, state, now_));
    agents_[slot] = {{state, declaration.limits, 0}, {{now_, state.p_WA, state.v_WA}}};
  }

  void SendState(std::uint32_t slot, Agent* agent) {
    motion::MotionState state = agent->bound.state;
    const Instant last = state.stamp;
    state.stamp = numeric::AddRoundedUp(now_, random_.Chance(0.5) ? 0 : random_.Uniform(0, 5));
    if (state.stamp <= last) return;
    state.p_WA = agent->PlaceAt(state.stamp);
    state.discontinuity = last <= now_ && random_.Chance(0.05);
    if (state.discontinuity) {
      state.p_WA = Place();
      agent->legs.push_back({state.stamp, state.p_WA, state.v_WA});
    } else if (random_.Chance(0.03)) {
      state.position_error = random_.Uniform(0, 0.5);
    }
    if (last <= now_ && random_.Chance(0.03)) {
      AgentDeclaration declaration = Declaration();
      declaration.limits.radius = agent->bound.limits.radius;
      agent->bound.limits = declaration.limits;
      detector_.Redeclare(Id(slot), declaration, now_);
    }
    EXPECT_NE(detector_.Update(Id(slot), state, now_), UpdateOutcome::kBreached);
    detector_.SetHeardUntil(OwnerOf(Id(slot)), state.stamp);
    agent->bound.state = state;
    ahead += state.stamp > now_;
  }

  bool IsClearAt(std::uint32_t slot, Instant t) {
    const AgentClearance clearance = *detector_.ClearanceOf(Id(slot));
    saturated += clearance.saturated;
    return clearance.clear_until > t && !clearance.in_contact;
  }

  void JudgePair(const Entry& a, const Entry& b) {
    const Instant when =
        intersection::EarliestIntersection(a.second.bound, b.second.bound, now_).instant();
    if (!when.is_never()) {
      // Answers may be early by 1e-9 of the way; those of older states by another one.
      const Instant rounded =
          numeric::AddRoundedUp(when, 2e-9 + 2e-9 * numeric::SecondsBetween(now_, when).upper);
      EXPECT_FALSE(IsClearAt(a.first, rounded) || IsClearAt(b.first, rounded))
          << a.first << "-" << b.first;
    }
    const Instant end = std::max(a.second.bound.state.stamp, b.second.bound.state.stamp);
    const double sum = a.second.bound.limits.radius + b.second.bound.limits.radius;
    for (Instant t = now_; t < end; t = numeric::AddRoundedUp(t, 0.02)) {
      if ((a.second.PlaceAt(t) - b.second.PlaceAt(t)).norm() > sum - 1e-6 || WasTold(a, b, t))
        continue;
      EXPECT_FALSE(IsClearAt(a.first, t) || IsClearAt(b.first, t)) << a.first << "-" << b.first;
    }
  }

  bool WasTold(const Entry& a, const Entry& b, Instant t) {
    const std::vector<CollisionEvent>& events = told_[{a.first, b.first}];
    return std::any_of(events.begin(), events.end(), [t](const CollisionEvent& event) {
      return event.begin.earliest <= t && t <= event.end.latest;
    });
  }

  Random random_;
  const double box_ = random_.LogUniform(20, 500);
  const std::size_t wanted_ = 4 + random_.Below(20);
  DetectorOptions options_;
  Detector detector_;
  Instant now_ = At(0);
  std::map<std::uint32_t, Agent> agents_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<CollisionEvent>> told_;
  std::uint32_t slots_ = 0;
};

TEST(StateAhead, OfRandomHistories) {
  int saturated = 0, ahead = 0;
  for (std::uint64_t seed = 1; seed <= kHistories && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    History history(seed);
    for (int step = 0; step < 100 && !testing::Test::HasFailure(); ++step) {
      history.Step();
      history.Judge();
    }
    saturated += history.saturated;
    ahead += history.ahead;
  }
  EXPECT_GT(saturated, static_cast<int>(kHistories));
  EXPECT_GT(ahead, static_cast<int>(kHistories));
}

}  // namespace
}  // namespace collision::detection
