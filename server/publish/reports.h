// What the service tells each simulator about itself: who it is, and what has arrived of it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "idl/messages.pb.h"
#include "server/world/world.h"

namespace collision::server {

/// The least time between two reports of one simulator [ns].
inline constexpr std::int64_t kReportPeriodNs = 100'000'000;

/// Makes the reports that are due: of each simulator at once when it is new to the world, and then
/// when something in its report has changed, at most every kReportPeriodNs. A change that comes
/// earlier is told when that is over. One thread.
class Reports {
 public:
  /// Without stamps. Those returned count as published.
  [[nodiscard]] std::vector<v1::SimulatorReport> TakeDue(const World& world);

  /// The monotonic time at which a change is due; nullopt: everything has been told.
  std::optional<std::int64_t> next_ns() const { return next_ns_; }

 private:
  /// Everything that a report says, as numbers.
  using Content = std::tuple<std::uint32_t, std::uint32_t, bool, v1::RunEnd, std::uint64_t,
                             std::uint64_t, std::size_t, std::size_t, std::uint64_t>;
  struct Told {
    Content content;
    std::int64_t at_ns = 0;
  };

  static Content ContentOf(const Simulator& simulator, v1::RunEnd ended);

  std::map<std::uint64_t, Told> told_;  ///< By simulator.
  std::optional<std::int64_t> next_ns_;
};

}  // namespace collision::server
