// A daemon that stands by beside another service, whose statuses the test writes.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/server/service/voyage.h"

namespace collision::server {

inline constexpr std::int64_t kSecond = 1'000'000'000;

class StandbyOfDaemonTest : public testing::Test {
 protected:
  explicit StandbyOfDaemonTest(DaemonParts parts = {})
      : daemon_(VoyageConfig(), WithClaim(std::move(parts))) {
    HearOther({.epoch = 1});
  }

  static DaemonParts WithClaim(DaemonParts parts) {
    parts.claim = {.instance = 2, .stands_by = true};
    return parts;
  }

  /// What a status of the service in force says.
  struct Status {
    std::uint32_t epoch = 1;
    std::int64_t now_ns = 0;
    std::int64_t granted_until_ns = 0;
    std::uint32_t agents = 0;
    std::string ended_runs = {};
  };

  void HearOther(const Status& status) {
    v1::Input input;
    v1::ServiceHeard& heard = *input.mutable_service_heard();
    heard.set_service_id(1);
    heard.set_term(1);
    heard.set_phase(v1::PHASE_SERVING);
    heard.set_followed(true);
    heard.set_epoch(status.epoch);
    heard.set_sequence(++sequence_);
    heard.set_granted_until_ns(status.granted_until_ns);
    heard.set_now_ns(status.now_ns);
    heard.set_agents(status.agents);
    heard.set_ended_runs(status.ended_runs);
    daemon_.Step({input});
  }

  /// It takes over in this step.
  void EndOther() {
    v1::Input input;
    input.mutable_service_heard()->set_service_id(1);
    input.mutable_service_heard()->set_ended(true);
    daemon_.Step({input}, 0.01);
    ASSERT_EQ(daemon_.status().phase(), v1::PHASE_SERVING);
  }

  std::uint32_t epoch() { return daemon_.status().stamp().epoch(); }

  std::vector<v1::CollisionEvent> Contacts() {
    std::vector<v1::CollisionEvent> contacts;
    for (const v1::Output& output : daemon_.bus().outputs) {
      const v1::CollisionEvent& event = output.collision_event();
      if (event.contacts_sequence() > 0) contacts.push_back(event);
    }
    return contacts;
  }

  std::int64_t EffectiveFrom(const std::string& simulator) {
    const v1::Clearance clearance = daemon_.clearance(SimulatorId(simulator));
    return clearance.agents().at(0).effective_from_ns();
  }

  ScriptedDaemon daemon_;
  std::uint64_t sequence_ = 0;
};

}  // namespace collision::server
