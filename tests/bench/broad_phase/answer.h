// What a contestant of the benchmark answers, and how answers are compared.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "tests/bench/harness/number_hash.h"

namespace collision::bench {

/// The earliest meeting of all, if there is one within the horizon.
struct Answer {
  bool found = false;
  std::uint32_t lower = 0, higher = 0;
  std::int64_t time_ns = 0;  ///< After the start, rounded down.

  friend bool operator==(const Answer&, const Answer&) = default;
};

/// The hash stands beside each time, so that a fast wrong answer shows.
inline std::string Hash(const Answer& answer) {
  NumberHash hash;
  hash.AddBits(answer.found);
  if (answer.found) {
    hash.AddBits(answer.lower), hash.AddBits(answer.higher);
    hash.AddBits(static_cast<std::uint64_t>(answer.time_ns));
  }
  return hash.text();
}

/// Peers answer in plain double, ours rounded down to what is certain: of one scene the times agree
/// within this part of the time, and 2 ns for the rounding to nanoseconds.
constexpr double kToleranceRelative = 1e-8;

/// The same time within the tolerance; the pair may differ where another's time is as near.
inline bool Agree(const Answer& a, const Answer& b) {
  if (!a.found || !b.found) return a.found == b.found;
  const double apart = std::abs(static_cast<double>(a.time_ns - b.time_ns));
  return apart <= 2 + kToleranceRelative * static_cast<double>(a.time_ns);
}

}  // namespace collision::bench
