#include "client/programs/tools/collisionctl/json_pages.h"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <utility>

#include "client/api/shape.h"
#include "client/library/network/conversion.h"

namespace collision::client {
namespace {

const char* NameOf(AgentPresence presence) {
  switch (presence) {
    case AgentPresence::kHeld:
      return "held";
    case AgentPresence::kSilent:
      return "silent";
    case AgentPresence::kWaitedFor:
      return "waited_for";
    case AgentPresence::kNotHeld:
      return "not_held";
    case AgentPresence::kEvicted:
      return "evicted";
    case AgentPresence::kRemovedSilent:
      return "removed_silent";
  }
  return "held";
}

}  // namespace

std::string Json(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  return status.ok() ? text : "{}";
}

std::string StatusJson(const WorldView& view) {
  std::string lines = Json(*view.status()) + "\n";
  for (const v1::ServiceStatus& standby : view.Standbys()) lines += Json(standby) + "\n";
  return lines;
}

std::string MissedJson(std::uint64_t more, std::uint64_t so_far) {
  return "{\"contacts_missed\":\"" + std::to_string(more) + "\",\"contacts_missed_so_far\":\"" +
         std::to_string(so_far) + "\"}";
}

std::string EarliestJson(const WorldView& view) {
  if (!view.earliest()) return "{}";
  std::string json = Json(*view.earliest());
  if (!view.earliest()->found()) return json;
  google::protobuf::Value lower, higher;  // Adds quotes and escapes.
  lower.set_string_value(view.Name(FromMessage(view.earliest()->lower())));
  higher.set_string_value(view.Name(FromMessage(view.earliest()->higher())));
  json.pop_back();
  return json + ",\"lower_name\":" + Json(lower) + ",\"higher_name\":" + Json(higher) + "}";
}

std::string AgentsJson(const WorldView& view) {
  std::string json = "{\"agents\":[";
  const char* separator = "";
  for (const AgentView& agent : view.Agents()) {
    json += std::exchange(separator, ",") + ("{\"description\":" + Json(agent.description));
    if (agent.state) json += ",\"state\":" + Json(*agent.state);
    if (agent.clearance) json += ",\"clearance\":" + Json(*agent.clearance);
    if (agent.presence != AgentPresence::kHeld) {
      json += ",\"presence\":\"" + std::string(NameOf(agent.presence)) + "\"";
    }
    json += "}";
  }
  json += "]";
  const std::vector<UnknownAgents> all_unknown = view.Unknown();
  separator = ",\"unknown\":[";
  for (const UnknownAgents& unknown : all_unknown) {
    google::protobuf::Value name;  // Adds quotes and escapes.
    name.set_string_value(unknown.simulator);
    json += std::exchange(separator, ",");
    json += "{\"simulator\":" + Json(name) + ",\"agents\":" + std::to_string(unknown.agents) + "}";
  }
  return json + (all_unknown.empty() ? "}" : "]}");
}

std::string ShapesJson(const WorldView& view) {
  std::string json = "{\"shapes\":[";
  const char* separator = "";
  for (const ShapeView& shape : view.Shapes()) {
    google::protobuf::Value name;  // Adds quotes and escapes.
    name.set_string_value(shape.simulator);
    json += std::exchange(separator, ",");
    json += "{\"hash\":\"" + HexText(shape.hash) + "\",\"simulator\":" + Json(name) +
            ",\"agents\":" + std::to_string(shape.agents) +
            ",\"triangles\":" + (shape.triangles ? std::to_string(*shape.triangles) : "null") +
            ",\"solids\":" + (shape.solids ? std::to_string(*shape.solids) : "null") +
            ",\"bytes\":" + std::to_string(shape.bytes) +
            ",\"parts\":" + std::to_string(shape.parts) +
            ",\"parts_seen\":" + std::to_string(shape.parts_seen.size()) + "}";
  }
  return json + "]}";
}

}  // namespace collision::client
