// A hash of answers: two runs that say the same have the same.
#pragma once

#include <cstdint>
#include <string>

namespace collision::bench {

/// FNV-1a over the bits of numbers.
class NumberHash {
 public:
  void Add(double value);
  std::string text() const;

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace collision::bench
