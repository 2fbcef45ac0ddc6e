// What holds for the free indices of a table that reuses them.
#pragma once

#include <cstddef>
#include <vector>

#include "collision_core/base/check.h"

namespace collision {

/// Walks the free indices of a table of `size` indices: each index is held (`is_held(k)`) or stands
/// once in `free`, so that none is lost and none is given away twice. `place(f)` is the index that
/// the entry f means. Throws CheckFailure.
template <typename Free, typename Place, typename IsHeld>
void ValidateFreeList(const Free& free, std::size_t size, const Place& place,
                      const IsHeld& is_held) {
  std::vector<bool> listed(size);
  for (const auto& entry : free) {
    const std::size_t k = place(entry);
    CORE_CHECK(k < size && !listed[k], "a free index is one of the table's, and is listed once", k,
               size);
    listed[k] = true;
  }
  for (std::size_t k = 0; k < size; ++k) {
    CORE_CHECK(is_held(k) != listed[k], "each index is either held or free", k);
  }
}

}  // namespace collision
