// The classes of the histograms of a status (Histogram in collision.idl).
#pragma once

#include <cstddef>
#include <cstdint>

#include "idl/limits.h"

namespace collision::wire {

/// The greatest value of a class: 1, 2, 5, 10, 20, 50, ... The last class holds all that is greater
/// too. Requires that index < kHistogramCountsMax.
constexpr std::uint64_t ClassEnd(std::size_t index) {
  constexpr std::uint64_t kMantissas[] = {1, 2, 5};
  std::uint64_t end = kMantissas[index % 3];
  for (std::size_t decade = index / 3; decade > 0; --decade) end *= 10;
  return end;
}

/// The class of a value; of a negative one the first.
constexpr std::size_t ClassOf(std::int64_t value) {
  std::size_t index = 0;
  while (index + 1 < kHistogramCountsMax && value > static_cast<std::int64_t>(ClassEnd(index)))
    ++index;
  return index;
}

/// The end of the class that holds the quantile `share` (0 to 1) of the values counted: that many
/// of them, rounded up, are at most so great. 0 where nothing has been counted. `Counts` is a list
/// of numbers.
template <class Counts>
std::uint64_t QuantileAtMost(const Counts& counts, double share) {
  std::uint64_t all = 0;
  for (const std::uint64_t count : counts) all += count;
  const double wanted = share * static_cast<double>(all);
  std::uint64_t so_far = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(counts.size()); ++i) {
    so_far += counts[static_cast<int>(i)];
    if (so_far > 0 && static_cast<double>(so_far) >= wanted) return ClassEnd(i);
  }
  return 0;
}

}  // namespace collision::wire
