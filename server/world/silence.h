// What happens with simulators that are not heard of, or that do not move.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "idl/config.pb.h"
#include "server/world/silence/progress.h"
#include "server/world/silence/roster.h"
#include "server/world/simulator.h"

namespace collision::server {

enum class WaitReason {
  kEnded,       ///< It is not heard: its process has ended, or stands still; its agents are there.
  kStands,      ///< It was granted time, lives, and tells nothing new.
  kHasNoClock,  ///< It has started again, lives, and has told no clock yet.
  kDoesNotFollowYet,  ///< A service before this one served it; it lives.
  kMissing,           ///< Likewise, but it is not heard.
};

/// A simulator that the world's time waits for.
struct Awaited {
  std::string name;
  WaitReason reason = WaitReason::kEnded;

  auto operator<=>(const Awaited&) const = default;
};

/// The policy of silence: who is waited for, for how long, and who is removed when.
///
/// **Simulated clock.** A simulator whose process has ended, or that stands (Progress), holds time
/// for ever (WAIT), or until `release_after_s` is over (RELEASE): it is released, its agents stay,
/// and it holds time again once it goes on. One that lives is released only while others wait for
/// it. Likewise the service waits for the roster of the one before it.
///
/// **Removal.** A simulator that has been silent for `remove_silent_after_s` is to be removed with
/// its agents: with a wall clock since its process ended, with a simulated one since it was
/// released, or, if it never had a clock, since its process ended. One that the world waits for is
/// never removed.
///
/// It changes nothing but Simulator::Release(). Times are nanoseconds of the monotonic clock. One
/// thread.
class Silence {
 public:
  using Simulators = std::map<std::uint64_t, Simulator>;

  Silence(const v1::Config& config, const std::vector<JournalledSimulator>& roster);

  Roster& roster() { return roster_; }
  const Roster& roster() const { return roster_; }

  /// Another service has ended, and this one goes on with those that it served. The waiting for
  /// them begins now.
  void AwaitRoster(const std::vector<JournalledSimulator>& roster, std::int64_t now_ns) {
    roster_ = Roster(roster);
    begun_ns_ = now_ns;
  }

  /// Takes note of who has moved and who is back. Call it once a step, after the inputs.
  void Update(const Simulators& simulators, std::int64_t now_ns);

  /// Releases those whose time is over, and gives up the roster. Returns their names.
  std::vector<std::string> Release(Simulators* simulators, std::int64_t now_ns);

  /// The ids of those that are to be removed.
  std::vector<std::uint64_t> Overdue(const Simulators& simulators, std::int64_t now_ns) const;

  /// Whom the world's time waits for, by name.
  std::vector<Awaited> Waited(const Simulators& simulators, std::int64_t now_ns) const;

  /// When one of the answers may change without any input; nullopt: never. `removes`: that of
  /// Overdue() is asked for, too.
  std::optional<std::int64_t> NextDue(const Simulators& simulators, bool removes,
                                      std::int64_t now_ns) const;

 private:
  std::optional<std::int64_t> ReleaseDue(const Simulator& simulator) const;
  std::optional<std::int64_t> RemovalDue(const Simulator& simulator) const;
  std::optional<std::int64_t> RosterDue() const;

  const bool simulated_;
  const bool releases_;
  const std::int64_t release_after_ns_;
  const std::int64_t remove_after_ns_;  ///< 0: never.
  Progress progress_;
  Roster roster_;
  std::optional<std::int64_t> begun_ns_;  ///< The first Update().
};

}  // namespace collision::server
