// The readers and writers of one program.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>

#include "idl/dds/entity.h"
#include "idl/dds/inbox/inbox.h"
#include "idl/dds/topics.h"

namespace collision::dds {

/// Which sides of the topics a program reads and writes, and in which partition; none: not at all.
struct Partitions {
  std::optional<std::string> read_of_simulators, read_of_service;
  bool read_status_alone = false;  ///< Of the service, and its hello.
  bool read_earliest = false;      ///< Of the service: it is computed for its readers only.
  bool read_screening = false;     ///< Of the service: what only the owners of agents are told.
  std::optional<std::string> read_of_other_services;  ///< Their status.
  bool read_events_of_other_services = false;         ///< And what they publish of contacts.
  std::optional<std::string> write_as_simulator, write_as_service;
  std::optional<std::string> read_of_operators, write_as_operator;
  std::optional<std::string> read_of_watchers, write_as_watcher;
};

/// The longest lease of a service [s]: what its readers ask for.
inline constexpr std::chrono::nanoseconds kServiceLeaseMax = std::chrono::seconds(2);

/// All live inside the participant and end with it. 0: the program does not have it.
struct Endpoints {
  std::array<dds_entity_t, kTopics> readers{};
  std::array<dds_entity_t, kTopics> writers{};
};

/// Makes them; `lease` is that of leased writers (topics.h). What simulators write arrives in
/// `inbox`, and `listener` is that of its readers and of the status of other services. Throws
/// std::runtime_error.
Endpoints MakeEndpoints(dds_entity_t participant, const Partitions& partitions,
                        dds_duration_t lease, const dds_listener_t* listener, Inbox* inbox);

}  // namespace collision::dds
