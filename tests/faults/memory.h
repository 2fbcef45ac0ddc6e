// What the programs of a run may take: their tables by number, their heap in bytes.
#pragma once

#include <cstdint>

#include "tests/faults/scene.h"
#include "tests/support/suite/case.h"

namespace collision::faults {

/// Holds every status that was published, and the greatest heap of the run, against what follows
/// from the number of programs and agents. `strangers`: agents that are not of the scene.
void ExpectBoundedMemory(const Scene& scene, std::uint64_t seed, std::size_t strangers,
                         suite::Outcome* outcome);

}  // namespace collision::faults
