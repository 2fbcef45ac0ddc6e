// A simulator in lock-step: what idl/PROTOCOL.md asks of one, for two balls.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "bus.h"
#include "collisionPubSubTypes.h"
#include "options.h"

namespace example {

class Simulator {
 public:
  explicit Simulator(const Options& options);

  /// Joins the world, flies for so long (world time) and leaves. Throws std::runtime_error when
  /// that is impossible: no service, another wire revision, a name that is taken.
  void Run(double seconds);

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// What one service has said. There are more than one where a standby takes over, and what it
  /// says may be read before it counts.
  struct Service {
    std::optional<std::int64_t> granted_ns;  ///< For this run of this program.
    std::uint64_t clearances = 0;            ///< Taken in up to this sequence.
    std::uint64_t contacts_named = 0;        ///< By a clearance: they count before its grant.
    SteadyTime contacts_named_at;
    std::uint64_t contacts_heard = 0;
  };

  void Join();
  void Describe();
  void WriteStates(std::int64_t expiry_ns);
  void WriteClock(std::int64_t clock_ns, std::int64_t next_ns);
  /// The last one, if there was one: with the run and the service that are in force now.
  void RepeatClock();
  void SendClock();
  void Leave();

  /// Reads and keeps its clock alive until `condition` holds.
  void WaitFor(const std::function<bool()>& condition);
  bool IsGranted(std::int64_t instant_ns);

  void Read();
  void ReadHello(const collision::v1::ServiceHello& hello);
  void ReadStatus(const collision::v1::ServiceStatus& status);
  void ReadReport(const collision::v1::SimulatorReport& report);
  void ReadClearance(const collision::v1::Clearance& clearance);
  void ReadContact(const collision::v1::CollisionEvent& contact);
  void ReadRejection(const collision::v1::Rejection& rejection);

  /// From here on this service counts, of those that have been heard.
  void Follow(std::uint64_t service_id, std::uint32_t term);
  Service& InForce() { return services_[service_in_force_]; }

  Options options_;
  std::uint64_t id_;
  std::uint32_t incarnation_;
  std::uint32_t run_ = 1;
  bool name_is_taken_ = false;

  Bus bus_;
  Writer<collision::v1::SimulatorHelloPubSubType> hello_;
  Writer<collision::v1::AgentDescriptionPubSubType> descriptions_;
  Writer<collision::v1::AgentStatesPubSubType> states_;
  Writer<collision::v1::SimulatorClockPubSubType> clock_;
  Reader<collision::v1::ServiceHelloPubSubType> hellos_;
  Reader<collision::v1::ServiceStatusPubSubType> statuses_;
  Reader<collision::v1::SimulatorReportPubSubType> reports_;
  Reader<collision::v1::RejectionPubSubType> rejections_;
  Reader<collision::v1::ClearancePubSubType> clearances_;
  Reader<collision::v1::CollisionEventPubSubType> contacts_;

  std::map<std::uint64_t, Service> services_;  ///< By service_id.
  std::uint64_t service_in_force_ = 0;         ///< 0: none was heard.
  std::uint32_t term_in_force_ = 0;
  SteadyTime heard_at_;  ///< The service in force.

  std::int64_t begin_ns_ = 0;
  std::int64_t now_ns_ = 0;
  std::uint64_t descriptions_sequence_ = 0;
  std::uint64_t states_sequence_ = 0;
  std::uint32_t agents_ = 0;
  collision::v1::SimulatorClock last_clock_;
  SteadyTime clock_written_at_;
};

}  // namespace example
