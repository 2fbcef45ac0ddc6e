// A view of a world whose network is under the test's control.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "client/programs/shared/world_view.h"
#include "tests/client/fake_receiver.h"

namespace collision::client {

inline void Extend(v1::ServiceStatus* status, const std::string& key, const std::string& value) {
  v1::KeyValue* extension = status->add_extensions();
  extension->set_key(key);
  extension->set_value(value);
}

class CollisionctlTest : public testing::Test {
 protected:
  void Poll(std::size_t expected) {
    EXPECT_EQ(monitor_.Poll(std::chrono::nanoseconds(0)), expected);
  }

  v1::ServiceStatus* Status() {
    v1::ServiceStatus* status = next_.outputs.emplace_back().mutable_service_status();
    status->set_service_id(1);
    status->mutable_stamp()->set_term(2);
    status->set_phase(v1::PHASE_SERVING);
    status->set_version("0.1.0");
    status->set_world("lab");
    status->set_simulated_clock(true);
    status->set_now_ns(12'345'678'901);
    status->set_agents(1);
    return status;
  }

  v1::AgentDescription* Describe(const std::string& name, std::uint32_t run, std::uint32_t slot) {
    auto* description = next_.inputs.emplace_back().mutable_agent_description();
    description->set_simulator_id(5);
    description->set_simulator_name("sim");
    description->set_agent_name(name);
    description->set_run(run);
    description->set_slot(slot);
    description->set_generation(1);
    description->set_radius_m(0.5);
    description->set_acceleration_max_m_s2(7.9);
    return description;
  }

  void Place(std::uint32_t run, std::uint32_t generation) {
    v1::AgentStates* states = next_.inputs.emplace_back().mutable_agent_states();
    states->set_simulator_id(5);
    states->set_run(run);
    v1::AgentState* state = states->add_states();
    state->set_generation(generation);
    state->set_stamp_ns(2'000'000'000);
    state->mutable_position_m()->set_x(1.5);
  }

  void Clear(std::uint32_t run) {
    v1::Clearance* clearance = next_.outputs.emplace_back().mutable_clearance();
    clearance->set_simulator_id(5);
    clearance->set_run(run);
    v1::AgentClearance* agent = clearance->add_agents();
    agent->set_generation(1);
    agent->set_clear_until_ns(kNever);
  }

  /// Of the first agent in the slot.
  v1::AgentBreach* Break(std::uint32_t run, std::uint32_t slot) {
    v1::AgentBreach* breach = next_.outputs.emplace_back().mutable_agent_breach();
    breach->set_simulator_id(5);
    breach->set_run(run);
    breach->set_slot(slot);
    breach->set_generation(1);
    breach->set_field("acceleration_max_m_s2");
    breach->set_declared(2);
    breach->set_seen(3.5);
    breach->set_from_ns(1'200'000'000);
    breach->set_at_ns(1'300'000'000);
    breach->set_count(4);
    return breach;
  }

  Arrivals next_;
  WorldView view_;
  MessageMonitor monitor_{std::make_unique<FakeReceiver>(&next_), view_.Callbacks()};
};

}  // namespace collision::client
