// Tells in the log, and in the status, whom the world waits for and who was let go.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "idl/messages.pb.h"
#include "server/process/names_log.h"
#include "server/world/silence.h"

namespace collision::server {

/// Names each simulator once for each time that it is waited for, released or removed; at most one
/// line a second of each kind. One thread.
class SilenceReport {
 public:
  /// `releases`: clock.on_silent_simulator is RELEASE.
  explicit SilenceReport(bool releases);

  /// Takes note of whom the world waits for now. True: that has changed.
  bool TakeWaited(const std::vector<Awaited>& waited);

  void AddReleased(const std::vector<std::string>& names);

  /// Removed as silent; a name may be empty.
  void AddRemoved(const std::vector<std::string>& names);

  /// Writes what is new.
  void Write(std::int64_t monotonic_ns);

  /// For the status: the simulators that were removed last, newest first.
  void AddExtensions(std::vector<v1::KeyValue>* extensions) const;

 private:
  std::vector<Awaited> waited_;       ///< Logged already.
  std::vector<std::string> removed_;  ///< Newest first; at most kRemovedShownMax.
  NamesLog silent_;
  NamesLog stands_{
      "world time waits for simulator {}: it was granted time and has not made its next step: it "
      "is slow, keeps a pace, or stands still (see clock.waiting_after_s); let it go on, or evict "
      "it with collisionctl evict"};
  NamesLog without_clock_{
      "world time waits for simulator {}: it has started again, and no clock of it has been "
      "accepted "
      "yet; let it go on, or evict it with collisionctl evict"};
  NamesLog not_following_{
      "world time waits for simulator {}: it is there, but has not heard this service yet, which "
      "has just begun to serve; there is nothing to do unless this lasts"};
  NamesLog missing_{
      "world time waits for simulator {}: the service before this one served it, and it is not "
      "back yet; start it again, or evict it with collisionctl evict"};
  NamesLog releases_{
      "world time goes on without simulator {}: it was silent for clock.release_after_s; its "
      "agents stay, and their bounds grow"};
  NamesLog removals_{
      "simulator {} is removed with its agents: it was silent for clock.remove_silent_after_s; it "
      "is welcome again with a higher run"};
};

/// Simulators removed last that the status names.
inline constexpr std::size_t kRemovedShownMax = 8;

}  // namespace collision::server
