// A fingerprint of all collision events.
#pragma once

#include <cstdint>

#include "idl/messages.pb.h"

namespace collision::server {

/// Counts and hashes the collision events in their order, without their stamps and without the
/// numbers of their simulators' runs, which depend on when these were started. Two runs with the
/// same inputs have the same hash, from any instance of the service.
class EventLog {
 public:
  void Add(v1::CollisionEvent event);

  /// FNV-1a, 64 bits, over the events in delimited, deterministic serialisation.
  std::uint64_t hash() const { return hash_; }

  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;  // FNV's offset basis
  std::uint64_t count_ = 0;
};

}  // namespace collision::server
