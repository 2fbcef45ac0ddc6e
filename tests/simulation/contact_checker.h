// The truth against what the service said. Shares no code with the service.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "idl/messages.pb.h"
#include "tests/simulation/simulated_simulator.h"

namespace collision::server {

struct CheckerOptions {
  /// The truth is worked out in doubles: times are good to this, and overlaps below `grazing` may
  /// go either way.
  std::int64_t time_tolerance_ns = 100;
  double grazing = 1e-7;
  /// Whether two agents can meet at all; of others there is no event. Null: all can.
  std::function<bool(const detection::AgentId& a, const detection::AgentId& b)> can_meet = {};
};

struct CheckerResult {
  std::size_t contacts = 0;         ///< True ones that were checked.
  std::size_t confirmed = 0;        ///< Of them, confirmed by the service.
  std::size_t promises = 0;         ///< Clearances held against a contact.
  double begin_width_greatest = 0;  ///< Of the confirmed ones [s].
  std::vector<std::string> violations;
};

/// Every true contact that begins in motion must be announced (an event of its pair whose begin
/// bracket holds it, first published with now <= begin) and, where confirmed, bracketed; every
/// confirmed event must be true. Contacts that begin by an admission or a jump, or end by one, must
/// be covered but need no notice.
CheckerResult CheckContacts(const std::vector<const SimulatedSimulator*>& simulators,
                            const std::vector<v1::Output>& published, std::int64_t end_ns,
                            const CheckerOptions& options = {});

/// The violations, one a line.
std::string ViolationsOf(const CheckerResult& result);

/// How many events were published with each status, by v1::EventStatus; each change of status
/// counts once.
std::vector<int> CountStatuses(const std::vector<v1::Output>& published);

}  // namespace collision::server
