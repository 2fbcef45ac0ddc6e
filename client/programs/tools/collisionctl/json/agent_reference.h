// Who an agent is, in every document that names one.
#pragma once

#include <string>

#include "client/programs/shared/world_view.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"

namespace collision::client {

/// Adds the names of agent and simulator, as far as they are known, and the identity.
void AddIdentity(const AgentId& id, const WorldView& view, JsonObject* object);

/// {"key": "value", ...}
std::string TagsJson(const google::protobuf::RepeatedPtrField<v1::Tag>& tags);

/// {"name": ..., "simulator": ..., "assembly": ..., "tags": {...}, and the identity}, as the label
/// says, or where it is empty the newest description.
std::string AgentReference(const AgentId& id, const v1::AgentLabel& label, const WorldView& view);

/// The name of an enumerator as a word: without its prefix, in lower case, with hyphens.
std::string Word(const std::string& enumerator, const std::string& prefix);

}  // namespace collision::client
