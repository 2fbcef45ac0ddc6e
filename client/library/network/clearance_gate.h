// Clearances that wait for the events that they imply.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "client/library/network/contact_sequence.h"
#include "client/library/network/current_service.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Holds clearances, and with them grants, until the contacts that the service published before
/// them have come, and in lock-step the forecasts and the events of its hypothetical agents: a
/// simulator that is granted time has heard whom it has met and may meet. They pass in the order in
/// which they came. One thread; depends on nothing but the calls.
class ClearanceGate {
 public:
  using Time = CurrentService::Time;

  /// Events that have not come for so long are given up: the service sends them again within
  /// milliseconds, so they were overwritten.
  static constexpr std::chrono::nanoseconds kPatience = kServiceSilence;

  /// In lock-step, where the world's time stands meanwhile: a service that gets no processor may
  /// take that long, and which step hears of an event must not depend on it.
  static constexpr std::chrono::nanoseconds kPatienceInLockStep = std::chrono::seconds(30);

  /// Clearances that wait (6 kB each at most); beyond, the events that the oldest one waits for are
  /// given up.
  static constexpr std::size_t kWaitingMax = 1024;

  explicit ClearanceGate(std::chrono::nanoseconds patience) : patience_(patience) {}

  void Add(const v1::Clearance& clearance, Time now);

  static constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();

  /// The highest stamp.sequence of a forecast, and of a ScreeningEvent, that has come; kAll: they
  /// are not waited for.
  struct Newest {
    std::uint64_t forecast = kAll;
    std::uint64_t screening = kAll;
  };

  /// The clearances that wait for nothing any more.
  std::vector<v1::Clearance> Take(ContactSequence* contacts, const Newest& newest, Time now);

  /// The time until Take() gives up events; nullopt: none waits.
  std::optional<std::chrono::nanoseconds> Remaining(Time now) const;

  /// Another service is in force: what the former one promised does not count.
  void Clear() { waiting_.clear(); }

 private:
  struct Waiting {
    v1::Clearance clearance;
    Time since;
  };

  std::chrono::nanoseconds patience_;
  std::deque<Waiting> waiting_;
};

}  // namespace collision::client
