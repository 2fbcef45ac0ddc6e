// Goal:   calling Earliest() changes no later event and no later clearance.
// Method: random scenes of agents that jump, breach, widen, leave and crowd, in two detectors
//         alike; Earliest() is called after every step of one, and never of the other; each method
//         of the broad phase.
#include <gtest/gtest.h>

#include <vector>

#include "collision_core/numeric/seconds.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

constexpr std::uint32_t kAgents = 40;
constexpr double kStep = 1.0 / 32;

struct Mover {
  motion::MotionState state;
  AgentDeclaration declaration;
  std::uint32_t generation = 0;  ///< 0: not there.
};

AgentId IdOf(std::uint32_t slot, std::uint32_t generation) {
  AgentId id = Id(slot);
  id.generation = generation;
  return id;
}

std::vector<std::int64_t> OutputOf(Detector* detector) {
  std::vector<std::int64_t> output;
  for (const CollisionEvent& event : detector->events()) {
    output.insert(output.end(),
                  {static_cast<std::int64_t>(event.status), event.lower.slot, event.higher.slot,
                   event.contact, event.revision, event.begin.earliest.nanoseconds(),
                   event.begin.latest.nanoseconds(), event.end.latest.nanoseconds(),
                   static_cast<std::int64_t>(event.work)});
  }
  for (const AgentClearance& clearance : detector->TakeChangedClearances()) {
    output.insert(output.end(), {clearance.agent.slot, clearance.clear_until.nanoseconds(),
                                 clearance.unannounced_until.nanoseconds(), clearance.saturated,
                                 clearance.void_from.nanoseconds()});
  }
  return output;
}

class Scene {
 public:
  Scene(std::uint64_t seed, broad_phase::BroadPhaseMethod method)
      : random_(seed), asked_(Options(method)), unasked_(Options(method)) {}

  void Step() {
    now_ += kStep;
    for (std::uint32_t slot = 0; slot < kAgents; ++slot) SendState(slot);
    for (Detector* detector : {&asked_, &unasked_}) {
      detector->Advance(At(now_));
      ASSERT_NO_THROW(detector->Validate());
    }
    found_ += asked_.Earliest().found;
    ASSERT_NO_THROW(asked_.Validate());
    const std::vector<std::int64_t> output = OutputOf(&asked_);
    events_ += asked_.events().size();
    ASSERT_EQ(output, OutputOf(&unasked_)) << "at " << now_;
  }

  int found() const { return found_; }
  std::size_t events() const { return events_; }

 private:
  static DetectorOptions Options(broad_phase::BroadPhaseMethod method) {
    DetectorOptions options;
    options.announce_within = 0.5;
    options.pairs_per_agent_max = 6;
    options.broad_phase = method;
    return options;
  }

  Vector3d Place() {
    return {random_.Uniform(0, 60), random_.Uniform(0, 60), random_.Uniform(0, 60)};
  }

  template <typename Call>
  void Both(Call call) {
    call(&asked_);
    call(&unasked_);
  }

  void Admit(std::uint32_t slot) {
    Mover& mover = movers_[slot];
    ++mover.generation;
    mover.state = State(now_, Place(), random_.UnitVector() * random_.Uniform(0, 10));
    mover.declaration = {.limits = {.radius = random_.LogUniform(0.2, 3),
                                    .acceleration_max = random_.LogUniform(0.01, 100)}};
    Both([&](Detector* detector) {
      detector->Admit(IdOf(slot, mover.generation), mover.declaration, mover.state, At(now_));
    });
    there_[slot] = true;
  }

  void SendState(std::uint32_t slot) {
    Mover& mover = movers_[slot];
    const AgentId id = IdOf(slot, mover.generation);
    if (!there_[slot]) {
      if (random_.Chance(0.3)) Admit(slot);
      return;
    }
    if (random_.Chance(0.01)) {
      there_[slot] = false;
      return Both([&](Detector* detector) { detector->Remove(id); });
    }
    if (random_.Chance(0.5)) {
      // Perhaps ahead of now, as where an owner was granted more time than others.
      const double t = now_ + (random_.Chance(0.1) ? 0.7 : 0);
      if (At(t) < mover.state.stamp) return;
      const double s = numeric::SecondsBetween(mover.state.stamp, At(t)).middle();
      mover.state = State(t, mover.state.p_WA + s * mover.state.v_WA, mover.state.v_WA);
      if (random_.Chance(0.02)) {
        mover.state.p_WA = Place();
        mover.state.discontinuity = random_.Chance(0.5);
      }
      Both([&](Detector* detector) { detector->Update(id, mover.state, At(now_)); });
    }
    Both([&](Detector* detector) { detector->SetHeardUntil(OwnerOf(id), At(now_)); });
  }

  Random random_;
  Detector asked_, unasked_;
  Mover movers_[kAgents];
  bool there_[kAgents] = {};
  double now_ = 0;
  int found_ = 0;
  std::size_t events_ = 0;
};

TEST(EarliestAsked, ChangesNoLaterEventAndNoClearance) {
  for (const broad_phase::BroadPhaseMethod method :
       {broad_phase::BroadPhaseMethod::kAllPairs, broad_phase::BroadPhaseMethod::kExhaustive,
        broad_phase::BroadPhaseMethod::kSpatialIndex}) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      Scene scene(seed, method);
      for (int step = 0; step < 160 && !HasFatalFailure(); ++step) scene.Step();
      EXPECT_GT(scene.found(), 100);
      EXPECT_GT(scene.events(), 100u);
    }
  }
}

}  // namespace
}  // namespace collision::detection
