// Which agents somebody looks at.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>

#include "collision/types.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// The watches that stand: of at most wire::kWatchersMax watchers, those heard last. One thread.
class Watches {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Repeats, changes or ends the watch of one watcher. One whose period or lease is out of range
  /// is ignored.
  void Hear(const v1::Watch& watch, Time now);

  /// Drops those whose lease is over.
  void Expire(Time now);

  bool empty() const { return watches_.empty(); }

  /// The least period at which states of this agent are watched; nullopt: it is not. `id` need not
  /// have a run.
  std::optional<std::chrono::nanoseconds> PeriodOf(const AgentId& id) const;

 private:
  struct Standing {
    v1::Watch watch;
    Time heard, until;
  };

  std::map<std::uint64_t, Standing> watches_;  ///< By watcher.
};

}  // namespace collision::client
