// The identity of a simulator, computed from its name.
#pragma once

#include <cstdint>
#include <string_view>

namespace collision {

/// FNV-1a, 64 bits. Source: Fowler, Noll, Vo and Eastlake, "The FNV Non-Cryptographic Hash
/// Algorithm", RFC 9923.
inline std::uint64_t Fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char byte : bytes) {
    hash ^= byte;
    hash *= 0x100000001b3;
  }
  return hash;
}

/// The id of the simulator called `name`, the same in every program, without communication. Should
/// two names collide, the service refuses the later simulator (REJECTED_ID_OWNED).
inline std::uint64_t SimulatorId(std::string_view name) { return Fnv1a(name); }

}  // namespace collision
