// The heap of a run, told apart by the program that asked for it.
//
// All programs of a run are in one process. So each call into the daemon or the client library is
// made on behalf of an owner; what is allocated meanwhile counts as the owner's until it is freed,
// by whichever side. Counted are the bytes asked for by operator new, of any library, which knows
// no table by name and so forgets none. Memory from malloc() is not counted.
#pragma once

#include <cstdint>

#include "tests/support/sanitized.h"

namespace collision::faults {

enum class Owner : std::uint32_t { kTest, kServices, kClients };
inline constexpr int kOwners = 3;

/// Sanitizers have an operator new of their own, which finds other mistakes: all figures are 0.
inline constexpr bool kHeapIsCounted = !kSanitized;

struct HeapUse {
  std::int64_t live = 0;  ///< Now [bytes].
  std::int64_t peak = 0;  ///< The most since ForgetHeapPeaks().
};

HeapUse HeapOf(Owner owner);
void ForgetHeapPeaks();

/// What this thread allocates counts as the owner's while this lives.
class OnBehalfOf {
 public:
  explicit OnBehalfOf(Owner owner);
  ~OnBehalfOf();
  OnBehalfOf(const OnBehalfOf&) = delete;
  OnBehalfOf& operator=(const OnBehalfOf&) = delete;

 private:
  const Owner before_;
};

}  // namespace collision::faults
