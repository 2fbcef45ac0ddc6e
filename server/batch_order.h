// One order for whatever arrived together.
#pragma once

#include <vector>

#include "idl/messages.pb.h"

namespace collision::server {

/// Sorts a batch by simulator; within one: descriptions and removals by slot, shapes, states by
/// chunk, clocks, liveliness. What is equal in all of that keeps its order of arrival, which the
/// network keeps per writer: a slot's removal stays before the description that reuses it. Sorting
/// twice changes nothing.
///
/// A clock follows what it vouches for, and a simulator's end follows everything it wrote.
void SortBatch(std::vector<v1::Input>* batch);

}  // namespace collision::server
