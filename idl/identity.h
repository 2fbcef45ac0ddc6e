// The identity of a simulator, computed from its name, and ids as text.
#pragma once

#include <cstdint>
#include <string>
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

/// The id of a simulator or service as logs and pages have it: 16 hexadecimal digits.
inline std::string IdText(std::uint64_t id) {
  std::string text(16, '0');
  for (std::size_t at = text.size(); at > 0; id >>= 4) text[--at] = "0123456789abcdef"[id & 15];
  return text;
}

}  // namespace collision
