#include "client/tools/collisionctl_json.h"

#include <google/protobuf/util/json_util.h>

#include <utility>

namespace collision::client {

std::string Json(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  return status.ok() ? text : "{}";
}

std::string AgentsJson(const WorldView& view) {
  std::string json = "{\"agents\":[";
  const char* separator = "";
  for (const AgentView& agent : view.Agents()) {
    json += std::exchange(separator, ",") + ("{\"description\":" + Json(agent.description));
    if (agent.state) json += ",\"state\":" + Json(*agent.state);
    if (agent.clearance) json += ",\"clearance\":" + Json(*agent.clearance);
    json += "}";
  }
  return json + "]}";
}

}  // namespace collision::client
