// What is remembered of one simulator through a restart of the service.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "collision_core/base/instant.h"

namespace collision::server {

/// A simulator of the roster: who it was, and how far it may have gone.
struct JournalledSimulator {
  std::uint64_t id = 0;
  std::uint32_t run = 0;
  std::string name;                ///< At most 64 bytes.
  std::optional<Instant> granted;  ///< At most this was granted to it; nullopt: nothing.

  bool operator==(const JournalledSimulator&) const = default;
};

}  // namespace collision::server
