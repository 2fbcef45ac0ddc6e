// Which simulators the world's time has waited for, and since when.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace collision::server {

/// A simulator that holds time, as of one step.
struct TimeHolder {
  std::uint64_t id = 0;
  bool is_last = false;      ///< Its clock is the least, and it has been granted more.
  bool others_wait = false;  ///< A live one has told more than it.
  /// Its newest clock, and a count of everything else that it has told: they change with each sign
  /// of progress.
  std::pair<std::int64_t, std::uint64_t> told;
};

/// Progress, not life, is what the world's time needs. A simulator that was granted time, is the
/// last one, and tells nothing new stands, whatever its network threads say: it sleeps in its own
/// loop, hangs, or waits in a debugger. Pure bookkeeping: times are nanoseconds of the monotonic
/// clock, and it reads none. One thread.
class Progress {
 public:
  /// `named_after_ns`: how long a simulator stands before it is named.
  explicit Progress(std::int64_t named_after_ns) : named_after_ns_(named_after_ns) {}

  /// Takes note of all simulators that hold time. Call it once a step, after the inputs.
  void Update(const std::vector<TimeHolder>& holders, std::int64_t now_ns);

  /// Since when the world has waited for it; nullopt: it does not.
  std::optional<std::int64_t> StandsSince(std::uint64_t id) const;

  /// Likewise, and others wait for it.
  std::optional<std::int64_t> HoldsUpSince(std::uint64_t id) const;

  /// Whether it has stood long enough to be named.
  bool IsNamed(std::uint64_t id, std::int64_t now_ns) const;

  /// When the next one will be named; nullopt: none stands unnamed.
  std::optional<std::int64_t> NextDue(std::int64_t now_ns) const;

 private:
  struct Standing {
    std::pair<std::int64_t, std::uint64_t> told;
    std::int64_t since_ns = 0;
    std::optional<std::int64_t> holds_up_since_ns;
  };

  const std::int64_t named_after_ns_;
  std::map<std::uint64_t, Standing> standing_;  ///< By simulator: the last ones.
};

}  // namespace collision::server
