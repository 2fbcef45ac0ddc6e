// The implementation of World and Agent.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/library/deadline.h"
#include "client/library/identity/agent_names.h"
#include "client/library/identity/region_least.h"
#include "client/library/identity/service_fit.h"
#include "client/library/network/clearance_gate.h"
#include "client/library/network/current_service.h"
#include "client/library/network/held_forecasts.h"
#include "client/library/network/revision_filter.h"
#include "client/library/network/transport.h"
#include "client/library/notices/notices.h"
#include "client/library/world/agent_table.h"
#include "client/library/world/arrival.h"
#include "client/library/world/service_echo.h"
#include "client/library/world/shape_publisher.h"
#include "client/library/world/waiting_list.h"
#include "client/library/world/watches.h"
#include "collision/world.h"

namespace collision::client {

inline constexpr std::size_t kEventsMax = 65536;     ///< Kept without a callback.
inline constexpr std::size_t kRejectionsMax = 1024;  ///< Kept until they are taken.

/// Before every other time: there is none yet.
inline constexpr std::int64_t kBeforeAll = std::numeric_limits<std::int64_t>::min();

/// Period of repeating the clock while nothing else is written: a service that counted this
/// simulator as dead (it was stopped for longer than the liveliness lease) notices that it is back.
inline constexpr std::chrono::milliseconds kRepeatPeriod(500);

/// The state of a World.
class World::Implementation {
 public:
  Implementation(const WorldOptions& options, std::unique_ptr<Transport> transport);

  bool WaitForService(std::chrono::nanoseconds timeout);
  AgentId AddAgent(const AgentDescription& description, const State& state);
  void SetState(const AgentId& id, const State& state);
  void SetDescription(const AgentId& id, const AgentDescription& description);
  void RemoveAgent(const AgentId& id);
  Clearance clearance(const AgentId& id) const;

  void Publish(std::int64_t clock_ns);
  Advance AdvanceTo(std::int64_t clock_ns, std::chrono::nanoseconds timeout);
  std::optional<std::int64_t> Join(std::chrono::nanoseconds timeout);
  void Poll(std::chrono::nanoseconds timeout);

  void Finish();

  /// The World is gone, with its agents if they are to leave: no more callbacks, and agents'
  /// handles do nothing.
  void Close();
  bool closed() const { return closed_; }

  std::int64_t clock_ns() const { return clock_ns_; }
  std::int64_t granted_until_ns() const { return granted_until_ns_; }

  std::optional<bool> world_lock_step() const { return world_lock_step_; }

  void OnEvent(std::function<void(const Event&)> callback) { on_event_ = std::move(callback); }
  using ClearanceCallback = std::function<void(const AgentId&, const Clearance&)>;
  void OnClearanceLowered(ClearanceCallback callback) { on_lowered_ = std::move(callback); }
  void OnVoid(ClearanceCallback callback) { on_void_ = std::move(callback); }
  void OnServiceLost(std::function<void()> callback) { on_lost_ = std::move(callback); }
  void OnServiceBack(std::function<void()> callback) { on_back_ = std::move(callback); }
  void OnWaiting(std::function<void(const std::vector<std::string>&)> callback) {
    on_waiting_ = std::move(callback);
  }
  void OnNotice(std::function<void(const Notice&)> callback) { on_notice_ = std::move(callback); }
  std::vector<Event> TakeEvents();
  std::vector<Rejection> TakeRejections();
  std::uint64_t events_lost() const { return events_lost_; }
  std::uint64_t contacts_missed() const { return contacts_.missed(); }
  std::uint32_t run() const { return run_; }
  std::string waits_for_name() const { return OtherText(name_, arrival_); }
  std::string ended_because() const;
  std::string Name(const AgentId& id);
  std::vector<Rejection> standing_refusals() const;
  const Traffic& traffic() const { return agents_.traffic(); }

 private:
  /// What had come from the service that was in force before.
  struct FormerService {
    std::uint64_t id = 0;
    ContactSequence contacts;
    HeldForecasts forecasts, screened;
  };

  Deadline Until(std::chrono::nanoseconds timeout) const;
  void RequireOutsideCallback(const char* function) const;
  void RequireForward(std::int64_t clock_ns) const;

  /// The latest clock that may be set now.
  std::int64_t Reachable() const;

  /// Writes what is due at this clock, then the clock, unless the service knows all of it already.
  void Send(std::int64_t clock_ns);

  /// The same while another program has the name: what is due stays staged, since it would be
  /// refused, and the clock is repeated now and then, so that the service knows who waits.
  void Wait(std::int64_t clock_ns);

  /// Writes what is due at this clock, which is reached now. In lock-step a clock follows when it
  /// is known what comes next (Tell()).
  void Reach(std::int64_t clock_ns);
  void WriteDue(std::int64_t clock_ns);

  /// Lock-step: tells that nothing of any time before `next_ns` follows, unless the service knows.
  void Tell(std::int64_t next_ns);
  void WriteClock();
  void WriteClock(std::int64_t clock_ns);
  void RepeatClock();
  bool IsQuiet() const;  ///< Nothing was written for kRepeatPeriod.

  /// Repeats the clock if nothing was written for kRepeatPeriod, and everything if that is due.
  void Tend();
  bool MustReintroduce();
  /// Repeats everything that still holds.
  void Reintroduce();
  void WriteDescription(const AgentId& id);
  void RemoveAgents();

  /// Hands messages to the network.
  ShapePublisher::Writer Writer();

  /// In real time: the service's clock was set, and it has forgotten all states.
  void BeginEpoch();
  void Void(const std::vector<AgentId>& agents, v1::ClearanceCause cause);

  /// Waits for an arrival, and repeats meanwhile what is due.
  void Listen(std::chrono::nanoseconds timeout);

  /// Takes in what arrives within `timeout`, without callbacks.
  /// False: nothing has arrived.
  bool Gather(std::chrono::nanoseconds timeout);
  void Handle(const v1::Output& output, CurrentService::Time now);
  void Handle(const v1::ServiceHello& hello);
  void Handle(const v1::Rejection& rejection, CurrentService::Time now);
  void Keep(const Rejection& rejection);
  /// What is watched is due as of now.
  void Heed();
  void AddToGate(const v1::Clearance& clearance, CurrentService::Time now);
  void Handle(const v1::Clearance& clearance);
  void Handle(const v1::CollisionEvent& event);
  void Handle(const v1::ScreeningEvent& screening);
  void Handle(const v1::SimulatorReport& report, Arrival::Time now);
  void Handle(const v1::AgentBreach& breach);
  bool IsOwn(const v1::AgentId& id) const;
  /// Not for another program of this name.
  bool IsForThis(std::uint32_t incarnation) const;

  /// Whether the sample is of the service in force; takes note of its time.
  bool Accept(const v1::ServiceStamp& stamp, std::int64_t now_ns, CurrentService::Time now,
              bool followed = true);
  void ChangeService(std::uint64_t former_id);

  /// Notes when the service in force is heard no longer, and when one is heard again.
  void Watch(CurrentService::Time now);

  void DropOldEvents();

  /// Tells the user what stands in the way.
  void TellNotices();
  void Note(const Rejection& rejection);
  void NoteSkew(const v1::AgentClearance& clearance);

  /// Runs the callbacks for what has been received, or for that and the forecasts that are held.
  /// Keeps the event for OnEvent(), unless it is of a level that is not wanted.
  void Keep(const v1::CollisionEvent& event);
  /// Likewise what is told of a hypothetical agent, if it is new.
  void KeepScreened(const v1::CollisionEvent& event);
  void Deliver();
  void DeliverAll();
  template <typename Callback, typename... Values>
  void Call(const Callback& callback, const Values&... values);

  const std::string name_;
  const std::uint64_t simulator_id_;
  std::uint32_t run_;
  const bool lock_step_;
  const OnLeave on_leave_;
  const std::vector<std::string> levels_;  ///< As in WorldOptions.
  std::unique_ptr<Transport> transport_;
  Arrival arrival_;
  AgentTable agents_;
  ShapePublisher shapes_;
  CurrentService service_;
  OtherServices others_;
  ContactSequence contacts_;
  RevisionFilter filter_;
  RevisionFilter screening_filter_;  ///< Likewise of hypothetical agents.
  ClearanceGate gate_;
  HeldForecasts forecasts_;
  HeldForecasts screened_;  ///< Lock-step: likewise of hypothetical agents, also contacts.
  FormerService former_;
  std::function<std::int64_t()> wall_clock_;
  ServiceEcho echo_;
  ServiceFit fit_;
  RegionLeast least_;
  AgentNames names_;
  Watches watches_;

  std::int64_t clock_ns_ = kBeforeAll;
  std::int64_t granted_until_ns_ = kBeforeAll;
  std::optional<bool> world_lock_step_;
  bool clock_published_ = false;
  bool asked_ = false;                     ///< What time it is: Join().
  std::optional<std::int64_t> joined_ns_;  ///< The answer.
  /// Nothing of any time before this one follows, as the service has been told or is told with the
  /// next clock; not above the clock: it is not told.
  std::int64_t next_ns_ = kBeforeAll;
  bool clock_due_ = false;  ///< The clock has been reached by AdvanceTo(), and is not written.
  v1::SimulatorClock last_clock_;  ///< As written.
  Arrival::Time clock_written_{};

  std::int64_t service_now_ns_ = kBeforeAll;  ///< Newest heard.
  std::uint64_t clearances_sequence_ = 0;  ///< Of the newest clearance taken in, of this service.
  bool service_is_new_ = false;  ///< It has taken over, and no clock has been written since.
  bool service_lost_ = false;
  std::optional<bool> lost_news_;  ///< It was lost (true) or is back, and that was not told yet.
  std::deque<std::pair<AgentId, Clearance>> lowered_;  ///< Not told yet.

  ClearanceCallback on_lowered_, on_void_;
  std::function<void()> on_lost_, on_back_;
  std::function<void(const Event&)> on_event_;
  std::function<void(const std::vector<std::string>&)> on_waiting_;
  std::function<void(const Notice&)> on_notice_;
  WaitingList waiting_;
  Notices notices_;
  bool ungranted_ = false;  ///< A step, or the answer to Join(), is waited for.
  std::deque<Event> events_;
  std::deque<Rejection> rejections_;
  std::uint64_t events_lost_ = 0;
  bool in_callback_ = false;
  bool closed_ = false;
};

}  // namespace collision::client
