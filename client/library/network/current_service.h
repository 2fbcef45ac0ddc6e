// Which of several services a client believes, and what it keeps of the others.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "idl/limits.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// A service that was silent for so long has ended, or cannot be heard: another one counts, and
/// what it promised has expired.
inline constexpr std::chrono::nanoseconds kServiceSilence(wire::kServiceLease);

/// How long a service without followers waits for the one in force to fall silent, where the
/// network does not say that it has ended: longer than the period of any status.
inline constexpr std::chrono::nanoseconds kServiceLoss = 6 * kServiceSilence;

/// The service in force: of those that speak one that simulators follow, of several the one with
/// the highest term, of equal terms the one with the lower id. Such a service takes over at once,
/// unless its term is lower: then when the one in force has been silent for kServiceSilence. So a
/// term that was only a test, or a forged one, is in force no longer than it is repeated. One
/// that nobody follows, such as a standby that has taken over, waits for the network to say that
/// the one in force has ended: it may have lost sight of it alone.
///
/// It judges each sample by its stamp, and its answers depend on nothing but the calls. One thread.
class CurrentService {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Whether the sample that carries this stamp comes from the service in force, which it may
  /// become by it. `followed`: its status names followers; what else it says it says to them.
  bool Accept(const v1::ServiceStamp& stamp, Time now, bool followed = true);

  /// The network says that this service has ended, or has not kept its lease; or is back. True: it
  /// is the one in force that has ended, and others that were not accepted may be now.
  bool Hear(const v1::ServiceHeard& heard);

  /// Whether the sample comes from an earlier epoch of the service in force: an event is history,
  /// everything else means nothing any more.
  bool IsPast(const v1::ServiceStamp& stamp) const {
    return stamp.service_id() == id_ && stamp.term() == term_ && stamp.epoch() < epoch_;
  }

  /// One was heard, and has been silent for too long.
  bool IsLost(Time now) const { return id_ != 0 && now - heard_ >= kServiceSilence; }

  /// 0: none was heard yet.
  std::uint64_t id() const { return id_; }
  std::uint32_t term() const { return term_; }
  /// The epoch of its newest sample. What it said in an earlier epoch is not accepted any more.
  std::uint32_t epoch() const { return epoch_; }

 private:
  /// Ended services that are remembered; beyond, any is forgotten.
  static constexpr std::size_t kEndedMax = 16;

  bool GoesFirst(const v1::ServiceStamp& stamp, bool followed) const;

  std::uint64_t id_ = 0;
  std::uint32_t term_ = 0;
  std::uint32_t epoch_ = 0;
  bool followed_ = false;  ///< As a sample has said; samples of different topics overtake.
  std::set<std::uint64_t> ended_;
  Time heard_{};
};

/// Of any output.
const v1::ServiceStamp& StampOf(const v1::Output& output);

/// Keeps what the network would hand to a reader that joined now: the newest sample of each
/// instance, and the newest contacts. A service publishes most things once. One that is not in
/// force yet, because the one before it has not been silent for long enough, may come into force,
/// and then all of it counts. What one said before a long silence is forgotten. One thread;
/// depends on nothing but the calls.
class OtherServices {
 public:
  using Time = CurrentService::Time;

  static constexpr auto kForgottenAfter = 2 * kServiceSilence;
  static constexpr std::size_t kServicesMax = 4;  ///< Beyond, the one heard longest ago is dropped.
  /// Of one service, of 0.5 kB mostly; further ones are dropped.
  static constexpr std::size_t kInstancesMax = 16384;
  static constexpr std::size_t kContactsMax = wire::kContactsForLateJoiners;

  void Keep(const v1::Output& output, Time now);

  /// All that is kept of this service, in the order of its publication, and no longer kept.
  std::vector<v1::Output> Take(std::uint64_t service_id, Time now);

  /// The newest status of each that was heard lately.
  std::vector<v1::Output> Statuses(Time now) const;

  /// One of them was heard lately: samples of services are of the same keys, so those of the one in
  /// force may be overwritten unread.
  bool IsHeard(Time now) const;

 private:
  using Instance = std::pair<v1::Output::MessageCase, std::pair<std::uint64_t, std::uint64_t>>;
  struct Said {
    std::map<Instance, v1::Output> newest;
    std::deque<v1::Output> contacts;
    Time heard{};
  };

  static Instance InstanceOf(const v1::Output& output);

  std::map<std::uint64_t, Said> services_;
};

}  // namespace collision::client
