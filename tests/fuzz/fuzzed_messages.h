// Messages of simulators, mostly as they should be, with fields that are not.
#pragma once

#include <string>

#include "idl/messages.pb.h"
#include "tests/fuzz/fuzzed_data.h"

namespace collision::fuzz {

/// A message of one of four simulators with few agents, so that messages concern the same agents.
/// `now_ns`: the world's time, near which stamps and clocks lie.
v1::Input FuzzedInput(std::int64_t now_ns, FuzzedData* data);

/// Fields of a description or a state alone, of one of four agents; likewise spoilt.
v1::AgentDescription FuzzedDeclaration(const std::string& simulator, FuzzedData* data);
v1::AgentState FuzzedState(std::int64_t now_ns, FuzzedData* data);

/// What the network makes of it: through the C type of its topic and back. False: the network has
/// no form for it.
bool ThroughNetwork(v1::Input* input);

}  // namespace collision::fuzz
