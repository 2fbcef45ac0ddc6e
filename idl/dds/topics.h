// The one table of topics: names, types and QoS. The reason of each setting: ../PROTOCOL.md.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "collision.h"
#include "dds/dds.h"

namespace collision::dds {

enum class TopicId {
  kSimulatorHello,
  kSimulatorClock,
  kAgentDescription,
  kShapePart,
  kAgentStates,
  kServiceHello,
  kClearance,
  kEarliestIntersection,
  kContact,
  kForecast,
  kRejection,
  kServiceStatus,
  kSimulatorReport,
  kAgentBreach,
  kScreening,
  kOperatorCommand,
  kWatch,
};
inline constexpr std::size_t kTopics = 17;

enum class Source { kSimulators, kService, kOperators, kWatchers };

/// Behind the world's name. No simulator has this partition: none has an empty name.
inline constexpr char kOperatorsPartition[] = "..operators";
inline constexpr char kWatchersPartition[] = "..watchers";

/// A command that a service has not taken by then means nothing any more [ns].
inline constexpr dds_duration_t kCommandLifespan = DDS_SECS(10);

struct TopicRow {
  TopicId id;
  const char* name;
  const dds_topic_descriptor_t* type;
  Source source;
  /// Transient-local: how many newest samples of a key reach readers that join later; 0: volatile.
  int late_joiners_depth;
  int writer_depth;      ///< Keep-last, per key.
  int reader_depth;      ///< Keep-last, per key: how many wait for a reader that is slow.
  bool leased;           ///< Its writer's silence is noticed within the lease.
  std::size_t take_max;  ///< Taken at once; the rest stays in the reader until the next Receive().
};

inline constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
inline constexpr std::size_t kCommandsAtOnce = 8;  ///< As many answers as a status shows.

/// In the order in which readers are drained: clearances before contacts, so that the contacts that
/// a clearance names are there.
const std::array<TopicRow, kTopics>& Topics();

inline const TopicRow& Row(TopicId id) { return Topics()[static_cast<std::size_t>(id)]; }

}  // namespace collision::dds
