// What a monitor receives, as the messages of idl/messages.proto.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "client/library/network/contact_sequence.h"
#include "client/library/network/current_service.h"
#include "client/library/network/revision_filter.h"
#include "client/library/network/transport.h"
#include "collision/monitor.h"
#include "collision/notice.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Stands behind Monitor. Programs of this project that print or keep messages (collisionctl, the
/// scene runner) use it directly; rules of use as for Monitor.
///
/// It knows of contacts that do not come from the number that the status tells (kContactsCounter).
class MessageMonitor {
 public:
  /// Each may be empty.
  struct Callbacks {
    std::function<void(const v1::ServiceHello&)> hello = {};  ///< Also of another revision.
    std::function<void(const v1::CollisionEvent&)> event = {};
    std::function<void(const v1::EarliestIntersection&)> earliest = {};
    std::function<void(const v1::ServiceStatus&)> status = {};
    std::function<void(const v1::ServiceStatus&)> standby = {};  ///< Of one that stands by.
    std::function<void(const v1::AgentDescription&)> description = {};
    std::function<void(const v1::AgentRemoval&)> removal = {};
    std::function<void(const v1::ShapePart&)> shape_part = {};
    std::function<void(const v1::ShapeRemoval&)> shape_removal = {};
    std::function<void(const v1::AgentStates&)> states = {};
    std::function<void(const v1::SimulatorClock&)> clock = {};
    std::function<void(const v1::Clearance&)> clearance = {};
    std::function<void(const v1::Rejection&)> rejection = {};
    std::function<void(const v1::SimulatorReport&)> report = {};
    std::function<void(const v1::AgentBreach&)> breach = {};
    std::function<void(const Notice&)> notice = {};  ///< Empty: standard error is told.
  };

  /// Throws std::runtime_error if an option is out of range or DDS is not available.
  MessageMonitor(const MonitorOptions& options, Callbacks callbacks);
  MessageMonitor(std::unique_ptr<Receiver> receiver, Callbacks callbacks);

  /// Waits at most `timeout` for an arrival, then calls back for everything that has arrived.
  /// Returns the number of samples.
  std::size_t Poll(std::chrono::nanoseconds timeout);

  bool service_alive() const { return receiver_->service_alive(); }
  /// A sentence for people: there is a service of another wire revision, of which nothing is read;
  /// empty: there is none.
  const std::string& unreadable() const { return unreadable_text_; }

  std::uint64_t contacts_missed() const { return contacts_.missed(); }
  std::uint64_t contacts_repeated() const { return filter_.contacts_repeated(); }

 private:
  /// Contacts up to `sequence` were published by the time `since`.
  struct Awaited {
    std::uint64_t sequence;
    CurrentService::Time since;
  };

  void TellOfCredentials();
  void HandOn(const v1::Input& input);
  void HandOn(const v1::Output& output);
  void Take(const v1::ServiceHello& hello);
  bool Accept(const v1::ServiceStamp& stamp, bool followed = true);
  void Await(const v1::ServiceStatus& status);
  void GiveUpOverdue();

  std::unique_ptr<Receiver> receiver_;
  Callbacks callbacks_;
  CurrentService service_;
  std::set<std::uint64_t> unreadable_;  ///< Services of another wire revision.
  std::string unreadable_text_;
  OtherServices others_;
  CurrentService::Time now_{};
  ContactSequence contacts_;
  std::optional<Awaited> awaited_;
  RevisionFilter filter_;
};

}  // namespace collision::client
