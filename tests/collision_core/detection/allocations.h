// Counts what the program allocates.
#pragma once

#include <cstddef>

namespace collision {

/// Calls of operator new in the whole program so far.
std::size_t Allocations();

}  // namespace collision
