// The readers and writers of one role.
#pragma once

#include <array>

#include "idl/dds/entity.h"
#include "idl/dds/session.h"
#include "idl/dds/topics.h"

namespace collision::dds {

/// All live inside `participant` and end with it. 0: this role does not have it.
struct Endpoints {
  std::array<dds_entity_t, kTopics> readers{};
  std::array<dds_entity_t, kTopics> writers{};
};

/// Makes what `options.role` reads and writes, in its partitions; `listener` is that of the readers
/// of what simulators write. Throws std::runtime_error.
Endpoints MakeEndpoints(dds_entity_t participant, const DdsSessionOptions& options,
                        const dds_listener_t* listener);

}  // namespace collision::dds
