// Goal:   a scene that happens again in another epoch, at the same times and with the same agents,
//         is told again, each contact once, whichever of two services tells it.
// Method: two services with clocks that the test sets, one of which stands by, and a simulator
//         whose two agents pass through each other; then all clocks are set back to the begin.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "client/library/network/message_monitor.h"
#include "idl/service_heard.h"
#include "tests/client/fake_receiver.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::client {
namespace {

constexpr std::int64_t kStepNs = 100'000'000;
constexpr std::uint64_t kSender = 10;
constexpr double kSceneS = 6.5;  ///< The agents touch from 5 to 5.67 s.

v1::Config Wall() {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.mutable_clock()->set_skew_max_s(0.002);
  config.set_on_occupied(v1::Config::STAND_BY);
  return config;
}

server::DaemonParts PartsOf(std::uint64_t instance) {
  return {.claim = {.instance = instance, .heard_for_ns = 2'000'000'000, .stands_by = true}};
}

class EpochTakeOverTest : public testing::Test {
 protected:
  /// The scene, or the rest of it, until so long after its begin.
  void Fly(double until_s = kSceneS) {
    for (; elapsed_s_ < until_s; elapsed_s_ += 1e-9 * kStepNs) Step();
  }

  void SetClocksBackToTheBegin() {
    for (auto* service : {first_.get(), &second_}) {
      if (service == nullptr) continue;
      service->bus().wall_ns = begin_ns_;
      service->bus().wall_was_set = true;
    }
    elapsed_s_ = 0;
    ++scene_;
  }

  void EndFirst() {
    first_.reset();
    v1::ServiceHeard* ended = heard_by_second_.emplace_back().mutable_service_heard();
    ended->set_service_id(1);
    ended->set_ended(true);
  }

  /// How often this was told in a scene.
  std::size_t Told(int scene, v1::EventStatus status) { return told_[{scene, status}]; }

  void ExpectEachSceneOnce(int scenes) {
    for (int scene = 1; scene <= scenes; ++scene) {
      EXPECT_GE(Told(scene, v1::EVENT_POSSIBLE), 1u) << scene;
      EXPECT_GE(Told(scene, v1::EVENT_CONFIRMED), 1u) << scene;
      EXPECT_EQ(Told(scene, v1::EVENT_ENDED), 1u) << scene;
    }
    EXPECT_EQ(monitor_.contacts_missed(), 0u);
  }

  std::unique_ptr<server::ScriptedDaemon> first_ =
      std::make_unique<server::ScriptedDaemon>(Wall(), PartsOf(1));

 private:
  std::vector<v1::Input> Written() {
    const std::int64_t now_ns = second_.bus().wall_ns;
    std::vector<v1::Input> inputs;
    for (std::uint32_t slot : {0, 1}) {
      inputs.push_back(server::From(kSender, server::Description("alpha", slot)));
      v1::AgentState state = server::State(slot, now_ns, ++sequence_);
      state.mutable_position_m()->set_x(slot == 0 ? 0 : 32 - 6 * elapsed_s_);
      state.mutable_velocity_m_s()->set_x(slot == 0 ? 0 : -6);
      inputs.push_back(server::From(kSender, state, "alpha"));
    }
    v1::SimulatorClock clock = server::ClockAfter("alpha", now_ns, sequence_, 2);
    clock.set_lock_step(false);
    inputs.push_back(server::From(kSender, clock));
    return inputs;
  }

  void Step() {
    for (auto* service : {first_.get(), &second_}) {
      if (service != nullptr) service->bus().Pass(kStepNs);
    }
    const std::vector<v1::Input> written = Written();
    if (first_ != nullptr) {
      first_->Step(written);
      for (const v1::Output& output : Take(first_.get())) {
        v1::Input heard;
        if (output.has_service_status()) {
          *heard.mutable_service_heard() = HeardOf(output.service_status());
          heard_by_second_.push_back(heard);
        } else if (output.has_collision_event()) {
          *heard.mutable_event_heard() = output.collision_event();
          heard_by_second_.push_back(heard);
        }
      }
    }
    std::vector<v1::Input> inputs = std::exchange(heard_by_second_, {});
    inputs.insert(inputs.end(), written.begin(), written.end());
    second_.Step(inputs);
    Take(&second_);
    monitor_.Poll(std::chrono::nanoseconds(0));
  }

  /// What it has published now goes to the monitor, too.
  std::vector<v1::Output> Take(server::ScriptedDaemon* service) {
    std::vector<v1::Output> outputs = std::exchange(service->bus().outputs, {});
    next_.outputs.insert(next_.outputs.end(), outputs.begin(), outputs.end());
    return outputs;
  }

  MessageMonitor::Callbacks Callbacks() {
    MessageMonitor::Callbacks callbacks;
    callbacks.event = [this](const v1::CollisionEvent& event) {
      ++told_[{scene_, event.status()}];
    };
    return callbacks;
  }

  server::ScriptedDaemon second_{Wall(),
                                 server::DaemonParts{.claim = {.instance = 2, .stands_by = true}}};
  std::vector<v1::Input> heard_by_second_;
  const std::int64_t begin_ns_ = second_.bus().wall_ns;
  std::uint64_t sequence_ = 0;
  double elapsed_s_ = 0;
  int scene_ = 1;
  std::map<std::pair<int, v1::EventStatus>, std::size_t> told_;
  Arrivals next_;
  MessageMonitor monitor_{std::make_unique<FakeReceiver>(&next_), Callbacks()};
};

TEST_F(EpochTakeOverTest, OneServiceTellsEachSceneOnce) {
  Fly();
  SetClocksBackToTheBegin();
  Fly();
  SetClocksBackToTheBegin();
  Fly();
  ExpectEachSceneOnce(3);
}

TEST_F(EpochTakeOverTest, TheStandbyTellsTheNextScene) {
  Fly();
  SetClocksBackToTheBegin();
  Fly(1);
  EndFirst();
  Fly();
  ExpectEachSceneOnce(2);
}

TEST_F(EpochTakeOverTest, WhatTheFirstHasToldInTheNextSceneIsNotToldAgain) {
  Fly();
  SetClocksBackToTheBegin();
  Fly();
  EndFirst();
  Fly(kSceneS + 1);
  ExpectEachSceneOnce(2);
}

TEST_F(EpochTakeOverTest, TheOneThatTookOverTellsTheNextScene) {
  Fly();
  EndFirst();
  Fly(kSceneS + 1);
  SetClocksBackToTheBegin();
  Fly();
  ExpectEachSceneOnce(2);
}

}  // namespace
}  // namespace collision::client
