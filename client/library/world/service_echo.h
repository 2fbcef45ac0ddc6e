// What a simulator's clocks say of the service's clock.
#pragma once

#include <cstdint>
#include <limits>

#include "idl/messages.pb.h"

namespace collision::client {

/// In real time every clock of a simulator answers the newest sample that it has heard of the
/// service: from the two times of the service and the two of the simulator the service learns how
/// far their clocks are apart (idl/PROTOCOL.md, Wall clock). Book-keeping only.
class ServiceEcho {
 public:
  /// A sample of the service in force was heard at `heard_ns` by the simulator's wall clock.
  void Hear(const v1::ServiceStamp& stamp, std::int64_t now_ns, std::int64_t heard_ns);

  /// Fills in a clock that leaves at `sent_ns` by the simulator's wall clock.
  void FillIn(std::int64_t sent_ns, v1::SimulatorClock* clock) const;

 private:
  std::uint64_t service_id_ = 0;
  std::uint32_t epoch_ = 0;
  std::int64_t now_ns_ = std::numeric_limits<std::int64_t>::max();  ///< Never: none was heard.
  std::int64_t heard_ns_ = 0;
};

}  // namespace collision::client
