// What a world says, before those hear it that show it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "client/library/network/transport.h"

namespace collision::client {

/// Hands on what another receiver hears; `hear` has it first.
class HeardFirst final : public Receiver {
 public:
  using HearFunction = std::function<void(const Arrivals&)>;

  HeardFirst(std::unique_ptr<Receiver> inner, HearFunction hear)
      : inner_(std::move(inner)), hear_(std::move(hear)) {}

  void Receive(std::chrono::nanoseconds timeout, Arrivals* arrivals) override;
  bool service_alive() const override { return inner_->service_alive(); }
  std::optional<std::string> TakeCredentialsWarning() override {
    return inner_->TakeCredentialsWarning();
  }
  std::chrono::steady_clock::time_point Now() const override { return inner_->Now(); }

 private:
  const std::unique_ptr<Receiver> inner_;
  const HearFunction hear_;
};

/// Says when what is new is to be taken: once in a period of the world's time, and states before
/// newer ones replace them, since simulators in lock-step send many while the service's time stands
/// still. One thread.
class TakingTimes {
 public:
  explicit TakingTimes(std::int64_t period_ns) : period_ns_(period_ns) {}

  /// Of what comes next: whether it has a state that is a period later than the newest that was
  /// taken.
  bool AreStatesDue(const Arrivals& arrivals);

  /// Whether the service's time is a period later.
  bool IsDue(std::int64_t now_ns) const { return now_ns >= due_ns_; }

  /// All up to now has been taken.
  void Taken(std::int64_t now_ns);

  /// What comes next may be of earlier times.
  void BeginAnew();

 private:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();
  static constexpr std::int64_t kAheadMaxNs = 1'000'000'000;  ///< A state beyond it delays nothing.

  const std::int64_t period_ns_;
  std::int64_t due_ns_ = kNever, states_due_ns_ = kNever;
  std::int64_t newest_ns_ = kNever;  ///< Stamp of a state.
};

/// Of so many in a second.
inline std::int64_t PeriodNs(double rate_hz) { return static_cast<std::int64_t>(1e9 / rate_hz); }

}  // namespace collision::client
