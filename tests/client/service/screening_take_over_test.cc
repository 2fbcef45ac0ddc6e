// Goal:   a take-over loses nothing of what hypothetical agents would meet: their owner hears again
//         of nothing that it knows, of what it does not know, and of what ended while nobody told;
//         screening goes on; and no other simulator's clearance depends on any of it.
// Method: two services, one of which stands by, and two simulators with the library, which all go
//         by one clock. The first service falls silent, and its end is noticed half a second later;
//         in lock-step time stands meanwhile.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "client/library/network/transport.h"
#include "collision/world.h"
#include "idl/identity.h"
#include "idl/service_heard.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::client {
namespace {

constexpr double kStepS = 0.05;
constexpr double kCrashS = 4, kNoticedS = 4.5;  ///< The end of the first service.

v1::Config ConfigOf(v1::Clock::Kind kind) {
  v1::Config config;
  config.mutable_clock()->set_kind(kind);
  if (kind == v1::Clock::REAL_TIME) {
    config.mutable_clock()->set_skew_max_s(0.002);
  } else {
    config.mutable_clock()->set_simulators_awaited(2);
    config.mutable_clock()->set_grant_ahead_max_s(0.1);
  }
  config.set_on_occupied(v1::Config::STAND_BY);
  return config;
}

/// Carries what simulators write to both services, and what these say to all of them.
class TwoServices {
 public:
  explicit TwoServices(v1::Clock::Kind kind) : kind_(kind) {}

  World Connect(std::uint64_t sender, const std::string& simulator);

  void Step() {
    for (server::ScriptedDaemon* daemon : {first_.get(), &second_}) {
      if (daemon != nullptr) daemon->bus().Pass(static_cast<std::int64_t>(kStepS * 1e9));
    }
    const std::vector<v1::Input> written = std::exchange(written_, {});
    if (first_ != nullptr) {
      first_->Step(written);
      for (const v1::Output& output : std::exchange(first_->bus().outputs, {})) Hand(output);
    }
    std::vector<v1::Input> inputs = std::exchange(heard_by_second_, {});
    inputs.insert(inputs.end(), written.begin(), written.end());
    second_.Step(inputs);
    for (const v1::Output& output : std::exchange(second_.bus().outputs, {})) {
      said_by_second_.push_back(output);
      for (auto& [sender, inbox] : inboxes_) inbox.outputs.push_back(output);
    }
  }

  void CrashFirst() { first_.reset(); }

  void NoticeTheEndOfFirst() {
    v1::Input ended;
    ended.mutable_service_heard()->set_service_id(1);
    ended.mutable_service_heard()->set_ended(true);
    heard_by_second_.push_back(ended);
    for (auto& [sender, inbox] : inboxes_) inbox.inputs.push_back(ended);
  }

  std::int64_t wall_ns() { return second_.bus().wall_ns; }
  const std::vector<v1::Output>& said_by_second() const { return said_by_second_; }

 private:
  class Line;

  /// The network as DDS has it: a standby reads statuses and contacts of another service.
  void Hand(const v1::Output& output) {
    for (auto& [sender, inbox] : inboxes_) inbox.outputs.push_back(output);
    v1::Input heard;
    if (output.has_service_status()) {
      *heard.mutable_service_heard() = HeardOf(output.service_status());
      heard_by_second_.push_back(heard);
    } else if (output.has_collision_event()) {
      *heard.mutable_event_heard() = output.collision_event();
      heard_by_second_.push_back(heard);
    }
  }

  const v1::Clock::Kind kind_;
  std::unique_ptr<server::ScriptedDaemon> first_ = std::make_unique<server::ScriptedDaemon>(
      ConfigOf(kind_),
      server::DaemonParts{
          .claim = {.instance = 1, .heard_for_ns = 2'000'000'000, .stands_by = true}});
  server::ScriptedDaemon second_{ConfigOf(kind_),
                                 server::DaemonParts{.claim = {.instance = 2, .stands_by = true}}};
  std::vector<v1::Input> written_, heard_by_second_;
  std::map<std::uint64_t, Arrivals> inboxes_;
  std::vector<v1::Output> said_by_second_;
};

class TwoServices::Line : public Transport {
 public:
  Line(TwoServices* services, std::uint64_t sender) : services_(*services), sender_(sender) {
    services_.inboxes_[sender];
  }
  void Write(const v1::Input& message) override {
    services_.written_.push_back(message);
    services_.written_.back().set_sender(sender_);
  }
  void Flush() override {}
  bool service_alive() const override { return true; }
  void Receive(std::chrono::nanoseconds, Arrivals* arrivals) override {
    Arrivals& inbox = services_.inboxes_[sender_];
    std::ranges::move(inbox.outputs, std::back_inserter(arrivals->outputs));
    std::ranges::move(inbox.inputs, std::back_inserter(arrivals->inputs));
    inbox = {};
  }

 private:
  TwoServices& services_;
  std::uint64_t sender_;
};

World TwoServices::Connect(std::uint64_t sender, const std::string& simulator) {
  return World::Connect({.simulator = simulator,
                         .lock_step = kind_ == v1::Clock::LOCK_STEP,
                         .run = 1,
                         .incarnation = static_cast<std::uint32_t>(sender),
                         .on_demand = false,
                         .wall_clock = [this] { return wall_ns(); }},
                        std::make_unique<Line>(this, sender));
}

/// "other" has a rock at rest and a drone that passes it by, "pilot" a ship far away and plans.
class Scene {
 public:
  explicit Scene(v1::Clock::Kind kind = v1::Clock::REAL_TIME)
      : lock_step_(kind == v1::Clock::LOCK_STEP), services_(kind) {
    other_.OnEvent([this](const Event& event) { heard_by_other_.push_back(event); });
    pilot_.OnEvent([this](const Event& event) { heard_.push_back(event); });
    movers_.push_back({other_.AddAgent(Ball("rock"), At(0, 0)), 0, 0});
    movers_.push_back({other_.AddAgent(Ball("drone"), At(-40, 5)), -40, 5, 6});
    movers_.push_back({pilot_.AddAgent(Ball("ship"), At(500, 0)), 500, 0});
  }

  static AgentDescription Ball(const std::string& name) {
    return {.name = name, .radius_m = 1, .acceleration_max_m_s2 = 0.1};
  }

  static AgentDescription Plan(const std::string& name, double acceleration_max = 0.1) {
    AgentDescription plan = Ball(name);
    plan.hypothetical = true;
    plan.acceleration_max_m_s2 = acceleration_max;
    return plan;
  }

  /// A plan that touches the rock from so many seconds on, for a second. It is there from 0 on.
  void AddPlan(const std::string& name, double touches_s) {
    const double x = 2 + kSpeed * touches_s;
    movers_.push_back({pilot_.AddAgent(Plan(name), At(x, -kSpeed)), x, -kSpeed});
    plans_[name] = movers_.back().agent.id();
  }

  void Describe(const std::string& name, const AgentDescription& plan) {
    Find(name)->agent.SetDescription(plan);
  }

  void Remove(const std::string& name) { movers_.erase(Find(name)); }

  /// The first service crashes, and its end is noticed, in their time.
  void FlyTo(double until_s) {
    for (; now() < until_s - kStepS / 2; ++step_) {
      for (Mover& mover : movers_) mover.agent.SetState(At(mover.x, mover.v, mover.y));
      if (step_ == Steps(kCrashS)) services_.CrashFirst();
      if (lock_step_) {
        TakeStep();
        continue;
      }
      if (step_ == Steps(kNoticedS)) services_.NoticeTheEndOfFirst();
      for (World* world : {&pilot_, &other_}) {
        world->Publish(services_.wall_ns());
        world->Poll();
      }
      services_.Step();
    }
    for (World* world : {&pilot_, &other_}) world->Poll();
  }

  /// What the owner has heard of a plan.
  std::vector<Event> Heard(const std::string& plan) const {
    std::vector<Event> heard;
    std::ranges::copy_if(heard_, std::back_inserter(heard), [&](const Event& event) {
      return event.lower == plans_.at(plan) || event.higher == plans_.at(plan);
    });
    return heard;
  }

  std::size_t Heard(const std::string& plan, EventStatus status) const {
    return static_cast<std::size_t>(std::ranges::count(Heard(plan), status, &Event::status));
  }

  /// Of the rock and the drone, all that was said of their clearances after the take-over.
  std::vector<std::string> ClearancesOfOther() const {
    std::vector<std::string> said;
    for (const v1::Output& output : services_.said_by_second()) {
      if (!output.has_clearance()) continue;
      v1::Clearance clearance = output.clearance();
      if (clearance.simulator_id() != SimulatorId("other")) continue;
      // The numbers of samples count those for the pilot, too.
      clearance.clear_stamp();
      clearance.clear_forecasts_sequence();
      said.push_back(clearance.ShortDebugString());
    }
    return said;
  }

  const std::vector<Event>& heard() const { return heard_; }
  const std::vector<Event>& heard_by_other() const { return heard_by_other_; }
  const TwoServices& services() const { return services_; }

 private:
  static constexpr double kSpeed = 4;

  struct Mover {
    Agent agent;
    double x, v, y = 0;
  };

  static int Steps(double seconds) { return static_cast<int>(seconds / kStepS + 0.5); }
  double now() const { return kStepS * step_; }

  std::int64_t stamp_ns() { return lock_step_ ? SimulatedNs() : services_.wall_ns(); }
  std::int64_t SimulatedNs() const { return step_ * static_cast<std::int64_t>(kStepS * 1e9); }

  /// Lock-step: both take the step, as soon as they may.
  void TakeStep() {
    constexpr int kTriesMax = 200;
    for (int tries = 0; tries < kTriesMax; ++tries) {
      if (step_ >= Steps(kCrashS) && tries == Steps(kNoticedS - kCrashS)) {
        services_.NoticeTheEndOfFirst();
      }
      const Advance pilot = pilot_.AdvanceTo(SimulatedNs(), std::chrono::nanoseconds(0));
      const Advance other = other_.AdvanceTo(SimulatedNs(), std::chrono::nanoseconds(0));
      if (pilot == Advance::kReached && other == Advance::kReached) return;
      services_.Step();
    }
    ADD_FAILURE() << "time stands at " << now();
  }

  State At(double x, double v, double y = 0) {
    return {.stamp_ns = stamp_ns(), .position_m = {x + v * now(), y, 0}, .velocity_m_s = {v, 0, 0}};
  }

  std::vector<Mover>::iterator Find(const std::string& plan) {
    return std::ranges::find_if(
        movers_, [&](const Mover& mover) { return mover.agent.id() == plans_.at(plan); });
  }

  const bool lock_step_;
  TwoServices services_;
  World pilot_ = services_.Connect(1, "pilot"), other_ = services_.Connect(2, "other");
  std::vector<Mover> movers_;
  std::map<std::string, AgentId> plans_;
  std::vector<Event> heard_, heard_by_other_;
  int step_ = 0;
};

/// Of each plan its whole story was heard: its end once, and last.
void ExpectEachEndOnce(const Scene& scene) {
  for (const char* plan : {"over", "ends", "begins", "stands"}) {
    EXPECT_GE(scene.Heard(plan, EventStatus::kPossible), 1u) << plan;
    EXPECT_GE(scene.Heard(plan, EventStatus::kConfirmed), 1u) << plan;
    EXPECT_EQ(scene.Heard(plan, EventStatus::kEnded), 1u) << plan;
    EXPECT_EQ(scene.Heard(plan).back().status, EventStatus::kEnded) << plan;
  }
}

// Goal:   each outcome once, whichever of the two services tells it.
TEST(ScreeningTakeOver, EachOutcomeIsToldOnce) {
  Scene scene;
  scene.AddPlan("over", 2);       // and until 3 s
  scene.AddPlan("ends", 3.25);    // until 4.25 s, when no service tells
  scene.AddPlan("gone", 5.25);    // but removed before
  scene.AddPlan("begins", 4.25);  // when no service tells
  scene.AddPlan("stands", 5.75);
  scene.FlyTo(4.25);
  scene.Remove("gone");
  scene.FlyTo(9);
  ExpectEachEndOnce(scene);
  EXPECT_GE(scene.Heard("gone", EventStatus::kPossible), 1u);
  EXPECT_EQ(scene.Heard("gone", EventStatus::kWithdrawn), 1u);
  EXPECT_EQ(scene.Heard("gone").back().status, EventStatus::kWithdrawn);
  for (const Event& event : scene.heard()) EXPECT_TRUE(event.hypothetical);
}

// Goal:   likewise where time stands until the next service tells; and it does not stand for ever.
TEST(ScreeningTakeOver, InLockStepEachOutcomeIsToldOnce) {
  Scene scene(v1::Clock::LOCK_STEP);
  for (const auto& [plan, touches_s] :
       {std::pair("over", 2.0), {"ends", 3.02}, {"begins", 4.02}, {"stands", 5.75}}) {
    scene.AddPlan(plan, touches_s);
  }
  scene.AddPlan("gone", 5.25);
  scene.FlyTo(4.25);
  scene.Remove("gone");
  scene.FlyTo(14);
  ExpectEachEndOnce(scene);
  EXPECT_EQ(scene.Heard("gone").back().status, EventStatus::kWithdrawn);
}

// Goal:   what is said a second time is what stands, and what may have ended untold; each once.
TEST(ScreeningTakeOver, TheNextServiceTellsOnceMoreWhatStandsAndWhatIsOver) {
  Scene scene;
  scene.AddPlan("over", 2);
  scene.AddPlan("stands", 5.75);
  scene.FlyTo(kNoticedS + 3 * kStepS);
  std::multiset<v1::EventStatus> said;
  for (const v1::Output& output : scene.services().said_by_second()) {
    if (output.has_screening_event()) said.insert(output.screening_event().event().status());
  }
  EXPECT_EQ(said, (std::multiset{v1::EVENT_POSSIBLE, v1::EVENT_ENDED}));
  EXPECT_EQ(scene.Heard("over", EventStatus::kEnded), 1u);
  EXPECT_EQ(scene.Heard("stands", EventStatus::kPossible), 1u) << "nothing is new of it";
}

// Goal:   a certified begin that is earlier than told is news, also of the same event.
TEST(ScreeningTakeOver, AnEarlierBeginThatNobodyToldIsTold) {
  Scene scene;
  scene.AddPlan("wilder", 5.75);
  scene.FlyTo(4.25);
  const std::vector<Event> before = scene.Heard("wilder");
  ASSERT_FALSE(before.empty());
  scene.Describe("wilder", Scene::Plan("wilder", 10));
  scene.FlyTo(kNoticedS + 3 * kStepS);
  const std::vector<Event> after = scene.Heard("wilder");
  ASSERT_GT(after.size(), before.size());
  EXPECT_EQ(after[before.size()].status, EventStatus::kPossible);
  EXPECT_EQ(after[before.size()].contact, before.back().contact);
  EXPECT_LT(after[before.size()].begin.earliest_ns, before.back().begin.earliest_ns);
}

TEST(ScreeningTakeOver, NoOtherClearanceDependsOnIt) {
  Scene without, with;
  with.AddPlan("over", 2);
  with.AddPlan("ends", 3.25);
  with.AddPlan("stands", 5.75);
  for (Scene* scene : {&without, &with}) scene->FlyTo(8);
  ASSERT_FALSE(with.heard().empty());
  EXPECT_TRUE(without.heard().empty());
  EXPECT_EQ(with.heard_by_other().size(), without.heard_by_other().size());
  ASSERT_GT(without.ClearancesOfOther().size(), 10u);
  EXPECT_EQ(with.ClearancesOfOther(), without.ClearancesOfOther());
}

}  // namespace
}  // namespace collision::client
