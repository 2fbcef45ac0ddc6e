// Goal:   on demand the promises are those of a stream: nothing late, every contact announced and
//         bracketed as narrowly, while agents join and jump; for a fraction of the states.
// Method: the client library against a daemon in the same thread; a crowd under random forces,
//         flown once as a stream and once on demand, in lock-step and on the wall clock with late
//         answers; the independent checker judges both with the exact motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "client/checker/check.h"
#include "tests/client/service/in_process_service.h"
#include "tests/support/random.h"

namespace collision::client {
namespace {

constexpr std::int64_t kStep = 1'000'000'000 / 64;  // exact in binary, so that motions are as well
constexpr std::int64_t kWallStart = 1'700'000'000'000'000'000;
constexpr double kBox = 30, kAccelerationMax = 5, kSpeedMax = 12, kRadius = 0.5;

struct Plan {
  bool on_demand = true;
  bool wall = false;
  std::size_t late = 0;  ///< Steps of the daemon that an answer is under way.
  int agents = 24;
  int steps = 64 * 8;
};

struct Outcome {
  checker::Violations violations;
  std::size_t contacts = 0, unannounced = 0;
  std::size_t events = 0;                        ///< False alarms among them.
  std::vector<double> begin_widths, end_widths;  ///< Of the last revisions [s], sorted.
  Traffic traffic;

  double median() const { return begin_widths.at(begin_widths.size() / 2); }
};

/// Flies under a new random force every quarter of a second.
class Walker {
 public:
  Walker(std::string name, std::uint64_t seed) : name_(std::move(name)), random_(seed) {
    for (int axis = 0; axis < 3; ++axis) state_.position_m[axis] = random_.Uniform(0, kBox);
  }

  /// The motion from `t0_ns` over a step; the state becomes that at its end.
  void Step(std::int64_t t0_ns) {
    if (steps_++ % 16 == 0) force_ = Force();
    const double h = static_cast<double>(kStep) * 1e-9;
    checker::Piece piece{t0_ns, t0_ns + kStep, {}};
    for (int axis = 0; axis < 3; ++axis) {
      double &p = state_.position_m[axis], &v = state_.velocity_m_s[axis];
      piece.p_WA[axis] = {p, v, force_[axis] / 2, 0};
      p += h * (v + h * force_[axis] / 2);
      v += h * force_[axis];
    }
    motion_.pieces.push_back(piece);
    state_.discontinuity = false;
    state_.stamp_ns = t0_ns + kStep;
  }

  void Jump() {
    for (int axis = 0; axis < 3; ++axis) state_.position_m[axis] = random_.Uniform(0, kBox);
    state_.discontinuity = true;
    motion_.jumps_ns.push_back(state_.stamp_ns);
  }

  void Join(World* world, const std::string& simulator, std::int64_t now_ns) {
    state_.stamp_ns = now_ns;
    motion_.simulator = simulator;
    motion_.agent = name_;
    motion_.radius_m = kRadius;
    agent_.emplace(world->AddAgent(
        {.name = name_, .radius_m = kRadius, .acceleration_max_m_s2 = kAccelerationMax}, state_));
  }

  void SetState() { agent_->SetState(state_); }
  bool joined() const { return agent_.has_value(); }
  const checker::AgentMotion& motion() const { return motion_; }

 private:
  /// Towards a random point, less than M; braking above the speed cap.
  Vector3 Force() {
    const Eigen::Vector3d v(state_.velocity_m_s[0], state_.velocity_m_s[1], state_.velocity_m_s[2]);
    const Eigen::Vector3d p(state_.position_m[0], state_.position_m[1], state_.position_m[2]);
    Eigen::Vector3d to = -p;
    for (int axis = 0; axis < 3; ++axis) to[axis] += random_.Uniform(0.2, 0.8) * kBox;
    if (v.norm() > kSpeedMax) to = -v;
    const Eigen::Vector3d a = to / (to.norm() + 1e-9) * 0.999 * kAccelerationMax;
    return {a.x(), a.y(), a.z()};
  }

  std::string name_;
  Random random_;
  State state_;
  Vector3 force_{};
  int steps_ = 0;
  checker::AgentMotion motion_;
  std::optional<Agent> agent_;
};

v1::Config ConfigOf(const Plan& plan) {
  v1::Config config;
  config.set_announce_within_s(0.5);
  config.set_temporal_resolution_s(1.0 / 64);
  config.set_status_period_s(10);
  if (plan.wall) {
    config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
    config.mutable_clock()->set_skew_max_s(1e-6);
  } else {
    config.mutable_clock()->set_simulators_awaited(2);
    config.mutable_clock()->set_grant_ahead_max_s(0.1);
  }
  return config;
}

void Observe(const std::vector<v1::Output>& said, checker::Observations* seen) {
  for (const v1::Output& output : said) {
    if (output.has_clearance()) seen->clearances.push_back(output.clearance());
    if (output.has_collision_event()) seen->events.push_back(output.collision_event());
    if (output.has_earliest_intersection()) {
      seen->earliest.push_back(output.earliest_intersection());
    }
  }
}

class Flight {
 public:
  explicit Flight(const Plan& plan) : plan_(plan), service_(ConfigOf(plan), plan.late) {
    for (const std::string name : {"a", "b"}) {
      worlds_.push_back(
          service_.Connect(worlds_.size() + 1, {.simulator = name,
                                                .lock_step = !plan.wall,
                                                .on_demand = plan.on_demand,
                                                .wall_clock = [this] { return wall_ns_; }}));
    }
    for (int i = 0; i < plan.agents; ++i) {
      walkers_.emplace_back("walker-" + std::to_string(i), 77 + 1000 * i);
    }
  }

  Outcome Fly() {
    const std::int64_t start_ns = plan_.wall ? kWallStart : 0;
    // The last one of each simulator joins later.
    for (std::size_t i = 0; i + 2 < walkers_.size(); ++i) Join(i, start_ns);
    Advance(start_ns);
    for (int step = 0; step < plan_.steps; ++step) {
      const std::int64_t t0_ns = start_ns + step * kStep;
      for (std::size_t i = 0; i < walkers_.size(); ++i) {
        if (step == 100 && !walkers_[i].joined()) Join(i, t0_ns);
        if (!walkers_[i].joined()) continue;
        walkers_[i].Step(t0_ns);
        if (step % 97 == 50 && i % 8 == 3) walkers_[i].Jump();
        walkers_[i].SetState();
      }
      Advance(t0_ns + kStep);
    }
    return Judge(start_ns);
  }

 private:
  void Join(std::size_t i, std::int64_t now_ns) {
    walkers_[i].Join(&worlds_[i % 2], i % 2 == 0 ? "a" : "b", now_ns);
  }

  /// Advances both worlds to `t_ns`. In lock-step a world that waits lets the daemon step.
  void Advance(std::int64_t t_ns) {
    if (plan_.wall) {
      wall_ns_ = t_ns;
      for (World& world : worlds_) world.Publish(t_ns);
      service_.Step(static_cast<double>(kStep) * 1e-9);
      for (World& world : worlds_) world.Poll();
      return;
    }
    std::size_t there = 0;
    for (int turn = 0; there < worlds_.size(); ++turn) {
      ASSERT_LT(turn, 1000) << "the world's time stands still";
      there = 0;
      for (World& world : worlds_) {
        there += world.AdvanceTo(t_ns, std::chrono::nanoseconds(0)) == Advance::kReached;
      }
      if (there < worlds_.size()) service_.Step(0.001);
    }
  }

  Outcome Judge(std::int64_t start_ns) {
    for (int i = 0; i < 3; ++i) service_.Step(static_cast<double>(kStep) * 1e-9);
    checker::Observations seen;
    Observe(service_.said(), &seen);
    std::vector<checker::AgentMotion> motions;
    for (std::size_t i = 0; i < walkers_.size(); ++i) {
      motions.push_back(walkers_[i].motion());
      v1::AgentName& name = seen.names.emplace_back();
      name.mutable_id()->set_simulator_id(SimulatorId(motions.back().simulator));
      name.mutable_id()->set_run(1);
      name.mutable_id()->set_slot(static_cast<std::uint32_t>(i / 2));
      name.mutable_id()->set_generation(1);
      name.set_simulator(motions.back().simulator);
      name.set_agent(motions.back().agent);
    }
    const checker::Evidence evidence(
        std::move(motions), seen, {.start_ns = start_ns, .transit_ns = plan_.wall ? 4 * kStep : 0});
    Outcome outcome;
    outcome.violations = checker::Check(evidence, {});
    outcome.contacts = evidence.contacts_certain();
    outcome.unannounced = checker::ContactsUnannounced(evidence);
    outcome.events = evidence.histories().size();
    const auto add = [](const v1::TimeBracket& bracket, std::vector<double>* widths) {
      if (bracket.latest_ns() == kNever) return;
      widths->push_back(static_cast<double>(bracket.latest_ns() - bracket.earliest_ns()) * 1e-9);
    };
    for (const checker::EventHistory& history : evidence.histories()) {
      if (!history.confirmed) continue;
      add(history.last().begin(), &outcome.begin_widths);
      add(history.last().end(), &outcome.end_widths);
    }
    std::sort(outcome.begin_widths.begin(), outcome.begin_widths.end());
    std::sort(outcome.end_widths.begin(), outcome.end_widths.end());
    for (const World& world : worlds_) {
      outcome.traffic.states_set += world.traffic().states_set;
      outcome.traffic.states_sent += world.traffic().states_sent;
    }
    return outcome;
  }

  Plan plan_;
  std::int64_t wall_ns_ = kWallStart;
  InProcessService service_;
  std::vector<World> worlds_;
  std::vector<Walker> walkers_;
};

void ExpectAsGood(const Outcome& on_demand, const Outcome& stream) {
  for (const Outcome* outcome : {&on_demand, &stream}) {
    for (const std::string& violation : outcome->violations) ADD_FAILURE() << violation;
    EXPECT_EQ(outcome->unannounced, 0u);
  }
  EXPECT_EQ(on_demand.contacts, stream.contacts) << "they fly the same";
  EXPECT_GT(stream.contacts, 10u);
  // The first states of the two late agents are replaced by the next ones before the clock moves.
  EXPECT_EQ(stream.traffic.states_sent + 2, stream.traffic.states_set);
  EXPECT_EQ(on_demand.traffic.states_set, stream.traffic.states_set);
  EXPECT_LT(on_demand.traffic.states_sent, on_demand.traffic.states_set / 2);
  testing::Test::RecordProperty("states_sent", std::to_string(on_demand.traffic.states_sent));
}

TEST(OnDemandService, InLockStepIsAsGoodAsAStream) {
  const Outcome on_demand = Flight({.on_demand = true}).Fly();
  const Outcome stream = Flight({.on_demand = false}).Fly();
  ExpectAsGood(on_demand, stream);
  EXPECT_LE(on_demand.median(), stream.median() * 1.01);
  EXPECT_LE(on_demand.begin_widths.back(), stream.begin_widths.back() * 1.01);
  // The state after the end is requested as well.
  ASSERT_EQ(on_demand.end_widths.size(), stream.end_widths.size());
  EXPECT_LE(on_demand.end_widths.back(), stream.end_widths.back() * 1.01);
  // Bounds that have grown announce more events; those announced already must not hide others.
  EXPECT_LE(static_cast<double>(on_demand.events), static_cast<double>(stream.events) * 1.4);
}

// Answers take three steps of the daemon, 47 ms, as the lead allows.
TEST(OnDemandService, OnTheWallClockIsAsGoodAsAStream) {
  const Outcome on_demand = Flight({.on_demand = true, .wall = true, .late = 3}).Fly();
  const Outcome stream = Flight({.on_demand = false, .wall = true, .late = 3}).Fly();
  ExpectAsGood(on_demand, stream);
  EXPECT_LE(on_demand.median(), stream.median() * 1.01);
}

}  // namespace
}  // namespace collision::client
