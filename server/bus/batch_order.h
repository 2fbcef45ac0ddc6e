// One order for the messages that arrive together.
#pragma once

#include <vector>

#include "idl/messages.pb.h"

namespace collision::server {

/// Sorts a batch: first shapes that are ready, then by simulator; within one simulator descriptions
/// by slot, parts of shapes, states by chunk, clocks, removals by slot, removals of shapes,
/// liveliness. Messages that are equal in all of that keep their order of arrival, which the
/// network keeps per writer. Sorting twice changes nothing. O(n log n).
///
/// So a clock follows the states that were written before it, the last state of an agent counts
/// although its removal came with it, and the end of a simulator follows everything it wrote.
/// Exception: a removal whose slot a later message of the batch describes anew goes with the
/// descriptions, before that one, so that late states of the agent that it ends are dropped as
/// older. The removal of a part of a shape that is written anew likewise goes with the parts.
void SortBatch(std::vector<v1::Input>* batch);

}  // namespace collision::server
