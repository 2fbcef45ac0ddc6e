// One order for whatever arrived together.
#pragma once

#include <vector>

#include "idl/messages.pb.h"

namespace collision::server {

/// Sorts a batch: what the service tells itself (shapes that are ready), then by simulator; within
/// one: descriptions by slot, shapes, states by chunk, clocks, removals by slot, removals of shapes,
/// liveliness. What is equal in all of that keeps its order of arrival, which the network keeps per
/// writer. A removal whose slot a later message of the batch describes anew goes with the
/// descriptions, and so stays before that one; a part of a shape that is written anew likewise goes
/// with the shapes. Sorting twice changes nothing.
///
/// A clock follows what it vouches for, an agent's end follows its last state, and a simulator's end
/// follows everything it wrote.
void SortBatch(std::vector<v1::Input>* batch);

}  // namespace collision::server
