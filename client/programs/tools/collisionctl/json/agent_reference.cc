#include "client/programs/tools/collisionctl/json/agent_reference.h"

#include <optional>

#include "idl/identity.h"

namespace collision::client {

void AddIdentity(const AgentId& id, const WorldView& view, JsonObject* object) {
  const std::string simulator = view.SimulatorName(id.simulator);
  const bool is_known = simulator != IdText(id.simulator);
  object->TextOrNull("name", view.IsNamed(id) ? view.Name(id) : "")
      .TextOrNull("simulator", is_known ? simulator : "")
      .Id("simulator_id", id.simulator)
      .Count("run", id.run)
      .Count("slot", id.slot)
      .Count("generation", id.generation);
}

std::string TagsJson(const google::protobuf::RepeatedPtrField<v1::Tag>& tags) {
  JsonObject object;
  for (const v1::Tag& tag : tags) object.Text(tag.key(), tag.value());
  return object.Json();
}

std::string AgentReference(const AgentId& id, const v1::AgentLabel& label, const WorldView& view) {
  JsonObject object;
  AddIdentity(id, view, &object);
  const std::optional<AgentView> agent = view.Agent(id);
  if (label.simulator_name().empty() && agent) {
    const v1::AgentDescription& description = agent->description;
    object.TextOrNull("assembly", description.assembly()).Add("tags", TagsJson(description.tags()));
  } else {
    object.TextOrNull("assembly", label.assembly()).Add("tags", TagsJson(label.tags()));
  }
  return object.Json();
}

std::string Word(const std::string& enumerator, const std::string& prefix) {
  std::string word = enumerator.starts_with(prefix) ? enumerator.substr(prefix.size()) : enumerator;
  for (char& c : word) {
    if (c == '_') c = '-';
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return word;
}

}  // namespace collision::client
