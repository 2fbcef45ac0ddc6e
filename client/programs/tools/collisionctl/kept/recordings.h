// The segments of the flight recorder, as `collisionctl recordings` shows them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/programs/tools/collisionctl/kept/kept_options.h"
#include "idl/recording/kept_files.h"

namespace collision::client {

/// What is in a segment.
struct SegmentFacts {
  wire::KeptFile file;
  std::uint32_t number = 0;   ///< Within one start of the service, from 1.
  std::int64_t end_ns = 0;    ///< Wall time of its last batch.
  std::uint64_t batches = 0;  ///< Of the service's steps, without the opening.
  std::size_t simulators = 0;
  /// In the journal of contacts, between its begin and its end; nullopt: there is none.
  std::optional<std::size_t> contacts = {};
  bool is_written = false;  ///< A service is writing to it.
  std::string damage = {};  ///< One line with the byte; empty: it is whole.
};

/// Of all segments of a folder, or of one that holds such a folder. Reads each to its end.
std::vector<SegmentFacts> SegmentsIn(const std::string& folder);

std::string RecordingsPage(const std::vector<SegmentFacts>& segments);
std::string RecordingsJson(const std::string& folder, const std::vector<SegmentFacts>& segments);

/// Prints them. Returns the exit code.
int PrintRecordings(const KeptOptions& options, const std::string& world, bool json);

}  // namespace collision::client
