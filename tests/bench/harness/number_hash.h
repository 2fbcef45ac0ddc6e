// A hash of answers: runs with equal answers have equal hashes.
#pragma once

#include <bit>
#include <cstdint>
#include <string>

namespace collision::bench {

/// FNV-1a over the bits of numbers.
class NumberHash {
 public:
  void Add(double value) { AddBits(std::bit_cast<std::uint64_t>(value)); }
  void AddBits(std::uint64_t bits);
  std::string text() const;

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace collision::bench
