// SHA-256, a piece at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace collision {

/// Source: FIPS 180-4, "Secure Hash Standard", sections 5 and 6.2. Add() in any pieces, then
/// Digest() once.
class Sha256Hasher {
 public:
  void Add(std::string_view bytes);

  /// 32 bytes. Nothing may be added afterwards.
  std::string Digest();

 private:
  static constexpr std::size_t kBlock = 64;

  void AddBlock(const unsigned char* block);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, kBlock> pending_{};  // less than a block
  std::uint64_t length_ = 0;                     // of everything so far, in bytes
};

/// The digest of all bytes at once.
std::string Sha256(const std::string& bytes);

}  // namespace collision
