// Names the services of the world: the others in the log, this one in the status.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "idl/config.pb.h"
#include "idl/messages.pb.h"
#include "server/claim/standby_readiness.h"
#include "server/process/names_log.h"

namespace collision::server {

/// DDS has told a newcomer by then of all who are there; their clients wait longer for a grant.
inline constexpr std::int64_t kAwaitOthersNs = 5'000'000'000;

/// Keeps what was heard of other services: a line for each that begins to serve or to stand by, or
/// is gone; one for each that is configured otherwise, so that results change with a take-over; and
/// the reason of a take-over. From the same statuses it says when this one is ready, and when time
/// may begin here. Times are nanoseconds of the monotonic clock. One thread.
class ServiceReport {
 public:
  /// `complete`: the configuration of this service. `process`: its ProcessText(); empty: not known.
  ServiceReport(const v1::Config& complete, std::uint64_t service_id, std::string process);

  /// A status of a service, or its end. Returns fits().
  bool Hear(const v1::ServiceHeard& heard, std::int64_t now_ns);

  /// This one stands by beside the service whose status that is (StandbyReadiness::Hear()). True:
  /// it is ready to take over from now on, which is logged.
  bool HearProgress(const v1::ServiceHeard& heard, std::size_t agents, Instant newest);

  /// Time begins anew, or this process has stood still: of what the other service has not told,
  /// nothing is known yet.
  void ForgetProgress() { readiness_ = {}; }

  /// Writes what is new, and ServiceClaim::Conflicts().
  void Write(const std::vector<std::string>& conflicts, std::int64_t now_ns);

  /// This service takes over: writes from which one, for how long that one has been silent, and
  /// whether this one was not ready.
  void LogTakeOver(std::int64_t now_ns) const;

  /// Whether time may begin here as it has in the service that serves, or served: as many `agents`
  /// of simulators that hold time are known here as there, but at least one, or the first of these
  /// simulators since kAwaitOthersNs. While this one `stands_by` the other one must have begun: a
  /// status from before then does not count all.
  bool MayBegin(std::optional<std::size_t> agents, bool stands_by, std::int64_t now_ns);

  /// Whether the service that serves, or served, has the kind of clock that this one has. From one
  /// that has the other kind no simulator could go on to this one.
  bool fits() const {
    return !served_.has_simulated_clock() || served_.simulated_clock() == simulated_;
  }

  /// ConfigurationDigest() of this service.
  std::uint64_t configuration() const { return configuration_; }

  /// For the status: "process", "lease_s", and of one that `stands_by` "standby".
  void AddExtensions(bool stands_by, std::vector<v1::KeyValue>* extensions) const;

 private:
  const bool simulated_;
  const std::uint64_t configuration_;
  const std::uint64_t service_id_;
  const std::string process_;
  const double lease_s_;
  StandbyReadiness readiness_;
  std::map<std::uint64_t, v1::ServiceHeard> others_;  ///< At most kOthersMax; further are not told.
  v1::ServiceHeard served_;                           ///< The newest status of one that served.
  std::int64_t served_ns_ = 0;                        ///< When it was heard.
  std::optional<std::int64_t> awaits_since_ns_;
  NamesLog standbys_{"{} has become a standby in this world", spdlog::level::info};
  NamesLog serving_{"{} serves this world", spdlog::level::info};
  NamesLog gone_{"{} is gone: it has ended, or was not heard for its lease", spdlog::level::info};
  NamesLog misfits_{"{} has the other kind of clock: this one does not take over from it"};
  NamesLog configured_otherwise_{
      "{} is configured otherwise: results change when one takes over from the other; compare "
      "collisiond --print-config of both"};
};

}  // namespace collision::server
