// One scene, run in the ways that must not matter.
#pragma once

#include <cstdint>
#include <string>

#include "tests/same_bits/scene.h"

namespace collision::server {

/// Hashes of what a run published.
struct RunHashes {
  std::uint64_t events = 0;  ///< How many.
  std::uint64_t log = 0;     ///< The hash of the event log.
  /// A hash of every output but the status: clearances, grants, earliest intersections, rejections.
  std::uint64_t outputs = 0;

  friend bool operator==(const RunHashes&, const RunHashes&) = default;
};

/// The builder of the shapes.
enum class Builders {
  kOwn,      ///< The daemon, in its own thread.
  kThreads,  ///< Three threads, waited for in the step where the daemon itself would build.
  kChance    ///< Three threads; a tree counts when it happens to be there.
};

/// `recording`: a file to be written; empty: none. Throws std::runtime_error if time stands still
/// before the scene's end.
RunHashes RunScene(const Scene& scene, Builders builders, const std::string& recording = {});

/// Throws std::runtime_error if the recording is damaged.
RunHashes Replay(const std::string& recording);

}  // namespace collision::server
