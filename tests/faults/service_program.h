// A service on the faulty network: the real daemon, started, stopped, killed and suspended.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/bus/clock.h"
#include "server/claim/journal.h"
#include "server/service/daemon.h"
#include "tests/faults/ends.h"

namespace collision::faults {

/// The wall clock of a service when virtual time is 0.
inline constexpr std::int64_t kWallAtStart = 1'700'000'000 * kSecond;

struct ServiceOptions {
  std::string state_dir;  ///< Empty: no journal.
  std::uint64_t instance = 50;
};

/// One that is published, and when.
struct Published {
  std::int64_t at_ns;
  v1::Output output;
};

class ServiceProgram final : private server::Clock {
 public:
  ServiceProgram(const v1::Config& config, const ServiceOptions& options, Network* network);
  ~ServiceProgram() override;

  /// A new process: `instance` of the options, and 1 more each time.
  void Start();
  /// Ends without a word.
  void Kill();
  /// The process stands still, and nobody hears of it; time goes on.
  void Suspend();
  void Resume();
  /// Its wall clock is set.
  void StepWall(std::int64_t by_ns);

  bool runs() const { return daemon_ != nullptr; }
  /// It ended by itself: another service has the world.
  bool yielded() const { return yielded_; }
  Network::Id id() const { return bus_->id(); }
  const server::Daemon& daemon() const { return *daemon_; }
  std::int64_t wall_ns() const { return kWallAtStart + network_.now_ns() + wall_offset_ns_; }

  /// Of all its processes.
  const std::vector<Published>& published() const { return published_; }
  std::uint64_t events_hash() const { return daemon_ ? daemon_->event_log().hash() : hash_; }
  std::uint64_t events_count() const { return daemon_ ? daemon_->event_log().count() : count_; }
  /// The newest status; empty if there was none.
  const v1::ServiceStatus& status() const { return status_; }
  std::uint64_t counter(const std::string& name) const;

 private:
  server::ClockReading Read() override;
  void Wake(std::int64_t at_ns);
  void Step();
  bool StepDaemon();
  void End();

  const v1::Config config_;
  ServiceOptions options_;
  Network& network_;
  std::unique_ptr<server::Journal> journal_;
  std::unique_ptr<ServiceEnd> bus_;
  std::unique_ptr<server::Daemon> daemon_;
  std::int64_t wall_offset_ns_ = 0;
  bool wall_was_set_ = false, suspended_ = false, yielded_ = false;
  std::uint64_t process_ = 0;  ///< What was due for an earlier one is not.
  std::int64_t awake_at_ns_ = 0;
  bool awaits_ = false;
  std::vector<Published> published_;
  v1::ServiceStatus status_;
  std::uint64_t hash_ = 0, count_ = 0;
};

}  // namespace collision::faults
