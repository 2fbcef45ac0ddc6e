// A scene of messages by hand, and readers of its channels.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "client/programs/foxglove/foxglove_channels.h"
#include "client/programs/foxglove/messages/foxglove.pb.h"
#include "idl/identity.h"

namespace collision::client {

class FoxgloveTest : public testing::Test {
 protected:
  static constexpr std::uint64_t kSimulator = 9;

  v1::AgentDescription Agent(std::uint32_t slot, double radius = 0.5) const {
    v1::AgentDescription description;
    description.set_simulator_id(kSimulator);
    description.set_slot(slot);
    description.set_run(1);
    description.set_simulator_name("people");
    description.set_agent_name("agent-" + std::to_string(slot));
    description.set_radius_m(radius);
    description.set_acceleration_max_m_s2(1);
    return description;
  }

  void Describe(const v1::AgentDescription& description) { all_.description(description); }

  void Remove(std::uint32_t slot) {
    v1::AgentRemoval removal;
    removal.set_simulator_id(kSimulator);
    removal.set_slot(slot);
    all_.removal(removal);
  }

  void Place(std::uint32_t slot, double x, std::int64_t stamp_ns = 0) {
    v1::AgentStates states;
    states.set_simulator_id(kSimulator);
    states.set_run(1);
    v1::AgentState* state = states.add_states();
    state->set_slot(slot);
    state->set_stamp_ns(stamp_ns);
    state->mutable_position_m()->set_x(x);
    state->mutable_orientation()->set_w(0.1);
    state->mutable_orientation()->set_x(0.7);
    state->mutable_orientation()->set_y(0.5);
    state->mutable_orientation()->set_z(-0.5);
    all_.states(states);
  }

  v1::ServiceStatus Status(std::int64_t now_ns) const {
    v1::ServiceStatus status;
    status.set_service_id(1);
    status.mutable_stamp()->set_service_id(1);
    status.mutable_stamp()->set_term(1);
    status.set_phase(v1::PHASE_SERVING);
    status.set_world("lab");
    status.set_now_ns(now_ns);
    v1::SimulatorStatus* people = status.add_simulators();
    people->set_simulator_id(kSimulator);
    people->set_name("people");
    people->set_run(1);
    people->set_alive(true);
    return status;
  }

  /// Of the agents in slots 0 and 1, from 4.4 to 4.6 s on.
  v1::CollisionEvent Event(v1::EventStatus status, std::uint32_t contact = 1) const {
    v1::CollisionEvent event;
    event.mutable_stamp()->set_service_id(1);
    event.mutable_lower()->set_simulator_id(kSimulator);
    event.mutable_lower()->set_run(1);
    event.mutable_higher()->set_simulator_id(kSimulator);
    event.mutable_higher()->set_run(1);
    event.mutable_higher()->set_slot(1);
    event.set_pair_slot(contact);
    event.set_contact(contact);
    event.set_status(status);
    const bool is_contact = status == v1::EVENT_CONFIRMED || status == v1::EVENT_ENDED;
    event.set_contacts_sequence(is_contact ? contact : 0);
    event.mutable_begin()->set_earliest_ns(4'400'000'000);
    event.mutable_begin()->set_latest_ns(4'600'000'000);
    event.mutable_end()->set_latest_ns(std::numeric_limits<std::int64_t>::max());
    v1::PairProximity* proximity = event.mutable_proximity();
    proximity->mutable_point_m()->set_x(3);
    proximity->mutable_normal()->mutable_direction()->set_y(1);
    proximity->mutable_separation_m()->set_lower(-0.25);
    proximity->mutable_separation_m()->set_upper(0.5);
    return event;
  }

  void Step() { channels_.Put(scene_, scene_.TakeChanges(), service_alive_); }

  /// All that is new to the reader.
  template <class Message>
  static std::vector<Message> News(ChannelReader* reader) {
    std::vector<Message> all;
    while (const Payload payload = reader->Next()) {
      EXPECT_TRUE(all.emplace_back().ParseFromString(std::string(MessageOf(*payload))));
    }
    return all;
  }

  ShapeStore shapes_;
  Scene scene_{&shapes_};
  FoxgloveChannels channels_;
  MessageMonitor::Callbacks all_ = scene_.Callbacks();
  bool service_alive_ = true;
};

/// What a 3D panel has after these updates, by id.
class Panel {
 public:
  void Take(const std::vector<foxglove::SceneUpdate>& updates) {
    for (const foxglove::SceneUpdate& update : updates) {
      for (const foxglove::SceneEntityDeletion& one : update.deletions()) {
        one.type() == foxglove::SceneEntityDeletion::ALL ? entities_.clear() : Delete(one.id());
      }
      for (const foxglove::SceneEntity& one : update.entities()) entities_[one.id()] = one;
    }
  }

  bool Has(const std::string& id) const { return entities_.count(id) > 0; }
  const foxglove::SceneEntity& At(const std::string& id) const { return entities_.at(id); }
  std::size_t size() const { return entities_.size(); }

 private:
  void Delete(const std::string& id) { entities_.erase(id); }

  std::map<std::string, foxglove::SceneEntity> entities_;
};

}  // namespace collision::client
