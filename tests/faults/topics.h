// The topics of a world as the faulty network carries them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "idl/limits.h"
#include "idl/messages.pb.h"

namespace collision::faults {

/// In the order in which a reader drains them (idl/dds/topics.cc).
enum class Topic {
  kClock,
  kDescription,
  kShape,
  kStates,
  kClearance,
  kEarliest,
  kContact,
  kForecast,
  kRejection,
  kStatus,
  kReport,
  kBreach,
  kCommand,
  kServiceHello,
  kSimulatorHello,
  kScreening,
};
inline constexpr std::size_t kTopics = 16;

/// Keep-last depths per instance, as in idl/dds/topics.cc and idl/PROTOCOL.md.
struct TopicDepths {
  std::size_t late_joiners = 1;  ///< Newest samples for a reader that joins; 0: volatile.
  std::size_t writer = 1;        ///< Samples that wait for a reader that does not acknowledge.
  std::size_t reader = 1;        ///< Samples that wait for a program that does not read.
};

using Depths = std::array<TopicDepths, kTopics>;

inline Depths DepthsOfProtocol() {
  Depths depths;
  const auto at = [&depths](Topic topic) -> TopicDepths& {
    return depths[static_cast<std::size_t>(topic)];
  };
  at(Topic::kClock).reader = 8;
  at(Topic::kStates).reader = 32;
  at(Topic::kEarliest).reader = 64;
  at(Topic::kContact) = {wire::kContactsForLateJoiners, wire::kContactsKept, wire::kContactsKept};
  at(Topic::kRejection) = {0, 64, 64};
  return depths;
}

/// Where a sample belongs. All writers of a topic share its instances.
struct Address {
  Topic topic = Topic::kClock;
  std::string instance;
};

Address AddressOf(const v1::Input& message);
Address AddressOf(const v1::Output& message);

}  // namespace collision::faults
