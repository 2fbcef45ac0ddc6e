#include "client/programs/tools/collisionctl/json/world_json.h"

#include <limits>
#include <vector>

#include "client/library/network/conversion.h"
#include "client/programs/tools/collisionctl/json/agent_reference.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"
#include "collision/shape.h"

namespace collision::client {
namespace {

const char* NameOf(AgentPresence presence) {
  switch (presence) {
    case AgentPresence::kHeld:
      return "held";
    case AgentPresence::kSilent:
      return "silent";
    case AgentPresence::kWaitedFor:
      return "waited-for";
    case AgentPresence::kNotHeld:
      return "not-held";
    case AgentPresence::kEvicted:
      return "evicted";
    case AgentPresence::kRemovedSilent:
      return "removed-silent";
  }
  return "held";
}

std::string VectorJson(const v1::Vector3& v) { return JsonVector({v.x(), v.y(), v.z()}); }

std::string HalfSpaceJson(const v1::AgentDescription& description) {
  if (!description.has_half_space()) return "null";
  return JsonObject()
      .Add("normal", VectorJson(description.half_space().normal()))
      .Number("offset_m", description.half_space().offset_m())
      .Json();
}

/// What was not declared, which the wire has as no value above 0 (or from 0 on), is null.
void AddDeclared(const char* key, double value, bool is_declared, JsonObject* object) {
  is_declared ? object->Number(key, value) : object->Null(key);
}

std::string DeclarationJson(const v1::AgentDescription& description) {
  JsonObject object;
  object.Count("revision", description.revision())
      .Number("radius_m", description.radius_m())
      .Number("margin_m", description.margin_m())
      .Number("acceleration_max_m_s2", description.acceleration_max_m_s2())
      .Number("jerk_max_m_s3", description.jerk_max_m_s3());
  AddDeclared("angular_acceleration_max_rad_s2", description.angular_acceleration_max_rad_s2(),
              description.angular_acceleration_max_rad_s2() >= 0, &object);
  AddDeclared("speed_max_m_s", description.speed_max_m_s(), description.speed_max_m_s() > 0,
              &object);
  AddDeclared("time_step_s", description.time_step_s(), description.time_step_s() > 0, &object);
  const std::string& hash = description.shape_hash();
  return object.TextOrNull("class", description.class_name())
      .TextOrNull("shape_hash", hash.empty() ? "" : HexText(hash))
      .Add("half_space", HalfSpaceJson(description))
      .Add("meets_in_assembly", JsonTexts({description.meets_in_assembly().begin(),
                                           description.meets_in_assembly().end()}))
      .Add("never_meets",
           JsonTexts({description.never_meets().begin(), description.never_meets().end()}))
      .Flag("hypothetical", description.hypothetical())
      .Json();
}

std::string StateJson(const v1::AgentState& state) {
  const v1::Quaternion& q = state.orientation();
  const v1::Vector3& thrust = state.thrust_direction();
  JsonObject object;
  object.Instant("stamp", state.stamp_ns())
      .Count("sequence", state.sequence())
      .Add("position_m", VectorJson(state.position_m()))
      .Add("velocity_m_s", VectorJson(state.velocity_m_s()))
      .Add("acceleration_m_s2", VectorJson(state.acceleration_m_s2()))
      .Add("orientation_wxyz", JsonVector({q.w(), q.x(), q.y(), q.z()}))
      .Add("angular_velocity_rad_s", VectorJson(state.angular_velocity_rad_s()))
      .Number("position_error_m", state.position_error_m())
      .Number("velocity_error_m_s", state.velocity_error_m_s())
      .Number("rotation_error_rad", state.rotation_error_rad());
  const bool has_direction = thrust.x() != 0 || thrust.y() != 0 || thrust.z() != 0;
  object.Add("thrust_direction", has_direction ? VectorJson(thrust) : "null");
  return object.Instant("direction_until", has_direction ? state.direction_until_ns() : kNever)
      .Instant("expiry", state.expiry_ns())
      .Flag("discontinuity", state.discontinuity())
      .Json();
}

std::string ClearanceJson(const v1::AgentClearance& clearance, const WorldView& view) {
  const bool has_cause = clearance.cause() != v1::CAUSE_NONE;
  JsonObject object;
  object.Flag("promised", clearance.clear_until_ns() != std::numeric_limits<std::int64_t>::min())
      .Instant("clear_until", clearance.clear_until_ns())
      .Flag("not_clear", clearance.not_clear())
      .Flag("saturated", clearance.saturated())
      .Count("lowerings", clearance.lowerings())
      .TextOrNull("cause",
                  has_cause ? Word(v1::ClearanceCause_Name(clearance.cause()), "CAUSE_") : "");
  object.Add("cause_agent",
             has_cause ? AgentReference(FromMessage(clearance.cause_agent()), {}, view) : "null");
  return object.Instant("effective_from", clearance.effective_from_ns())
      .Instant("void_from", clearance.void_from_ns())
      .Instant("state_wanted", clearance.state_wanted_ns())
      .Count("acknowledged_sequence", clearance.acknowledged_sequence())
      .Count("acknowledged_revision", clearance.acknowledged_revision())
      .Json();
}

/// A value that no number explains is null.
std::string BreachJson(const v1::AgentBreach& breach) {
  return JsonObject()
      .Count("count", breach.count())
      .Text("field", breach.field())
      .Number("declared", breach.declared())
      .Number("seen", breach.seen())
      .Instant("from", breach.from_ns())
      .Instant("at", breach.at_ns())
      .Json();
}

}  // namespace

std::string AgentJson(const AgentView& agent, const WorldView& view) {
  const v1::AgentDescription& description = agent.description;
  JsonObject object;
  AddIdentity(
      {description.simulator_id(), description.run(), description.slot(), description.generation()},
      view, &object);
  const bool is_described = IsDescribed(description);
  return object.TextOrNull("assembly", description.assembly())
      .Add("tags", TagsJson(description.tags()))
      .Text("presence", NameOf(agent.presence))
      .Add("declaration", is_described ? DeclarationJson(description) : "null")
      .Add("state", agent.state ? StateJson(*agent.state) : "null")
      .Add("clearance", agent.clearance ? ClearanceJson(*agent.clearance, view) : "null")
      .Add("breach", agent.breach ? BreachJson(*agent.breach) : "null")
      .Json();
}

std::string AgentsJson(const WorldView& view) {
  std::vector<std::string> agents, all_unknown;
  for (const AgentView& agent : view.Agents()) agents.push_back(AgentJson(agent, view));
  for (const UnknownAgents& unknown : view.Unknown()) {
    all_unknown.push_back(
        JsonObject().Text("simulator", unknown.simulator).Count("agents", unknown.agents).Json());
  }
  return JsonDocument("agents")
      .Instant("now", view.status() ? view.status()->now_ns() : kNever)
      .Add("agents", JsonArray(agents))
      .Add("unknown", JsonArray(all_unknown))
      .Json();
}

std::string ShapesJson(const WorldView& view) {
  std::vector<std::string> shapes;
  for (const ShapeView& shape : view.Shapes()) {
    JsonObject object;
    object.Text("hash", HexText(shape.hash))
        .Text("simulator", shape.simulator)
        .Count("agents", shape.agents)
        .Add("triangles", shape.triangles ? std::to_string(*shape.triangles) : "null")
        .Add("solids", shape.solids ? std::to_string(*shape.solids) : "null")
        .Count("bytes", shape.bytes)
        .Count("parts", shape.parts)
        .Count("parts_seen", shape.parts_seen.size());
    shapes.push_back(object.Json());
  }
  return JsonDocument("shapes").Add("shapes", JsonArray(shapes)).Json();
}

std::string EarliestJson(const WorldView& view) {
  JsonObject document = JsonDocument("earliest");
  const auto& earliest = view.earliest();
  const bool found = earliest && earliest->found();
  document.Flag("published", earliest.has_value())
      .Instant("now", earliest ? earliest->now_ns() : kNever)
      .Flag("found", found)
      .Instant("earliest", found ? earliest->earliest_ns() : kNever);
  if (!found) return document.Null("lower").Null("higher").Json();
  return document.Add("lower", AgentReference(FromMessage(earliest->lower()), {}, view))
      .Add("higher", AgentReference(FromMessage(earliest->higher()), {}, view))
      .Json();
}

}  // namespace collision::client
