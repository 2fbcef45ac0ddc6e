// Every operator new of this program is counted.
#pragma once

#include <cstddef>
#include <cstdint>

namespace collision::bench {

/// Calls of operator new since the start, in any thread.
std::uint64_t Allocations();
/// Bytes that are allocated and not freed, as malloc counts them.
std::int64_t LiveBytes();

}  // namespace collision::bench
