#include "client/programs/tools/collisionctl/json/event_json.h"

#include "client/library/network/conversion.h"
#include "client/programs/tools/collisionctl/json/agent_reference.h"

namespace collision::client {
namespace {

std::string BracketJson(const TimeBracket& bracket) {
  return JsonObject()
      .Instant("earliest", bracket.earliest_ns)
      .Instant("latest", bracket.latest_ns)
      .Json();
}

std::string PointJson(const Vector3& vector) {
  return JsonVector({vector[0], vector[1], vector[2]});
}

std::string RangeJson(double lower, double upper) {
  return JsonObject().Number("lower", lower).Number("upper", upper).Json();
}

std::string PartJson(const std::optional<std::uint32_t>& part) {
  return part ? std::to_string(*part) : "null";
}

std::string VelocityJson(const std::optional<RelativeVelocity>& relative) {
  if (!relative) return "null";
  return JsonObject()
      .Add("velocity_m_s", PointJson(relative->velocity_m_s))
      .Number("error_m_s", relative->error_m_s)
      .Json();
}

std::string NormalJson(const std::optional<Normal>& normal) {
  if (!normal) return "null";
  return JsonObject()
      .Add("direction", PointJson(normal->direction))
      .Number("error_rad", normal->error_rad)
      .Json();
}

std::string ProximityJson(const std::optional<Proximity>& proximity) {
  if (!proximity) return "null";
  return JsonObject()
      .Instant("at", proximity->at_ns)
      .Add("separation_m", RangeJson(proximity->separation_lower_m, proximity->separation_upper_m))
      .Number("depth_lower_m", proximity->depth_lower_m)
      .Add("point_m", PointJson(proximity->point_m))
      .Number("point_error_m", proximity->point_error_m)
      .Add("normal", NormalJson(proximity->normal))
      .Add("lower_part", PartJson(proximity->lower_part))
      .Add("higher_part", PartJson(proximity->higher_part))
      .Add("relative_velocity", VelocityJson(proximity->relative_velocity))
      .Json();
}

std::string StateJson(const std::optional<StateUsed>& state) {
  if (!state) return "null";
  return JsonObject()
      .Instant("stamp", state->stamp_ns)
      .Add("position_m", PointJson(state->position_m))
      .Add("velocity_m_s", PointJson(state->velocity_m_s))
      .Add("acceleration_m_s2", PointJson(state->acceleration_m_s2))
      .Json();
}

std::string ClosestJson(const std::optional<ClosestApproach>& closest) {
  if (!closest) return "null";
  return JsonObject()
      .Instant("from", closest->from_ns)
      .Instant("until", closest->until_ns)
      .Add("at", BracketJson(closest->at))
      .Add("distance_m", RangeJson(closest->distance_lower_m, closest->distance_upper_m))
      .Json();
}

std::string ExpectedJson(const std::optional<Expectation>& expected) {
  if (!expected) return "null";
  return JsonObject()
      .Text("outcome", Name(expected->outcome))
      .Add("begin", BracketJson(expected->begin))
      .Add("closest", ClosestJson(expected->closest))
      .Instant("until", expected->until_ns)
      .Json();
}

}  // namespace

void AddEvent(const v1::CollisionEvent& message, const WorldView& view, JsonObject* object) {
  const Event event = FromMessage(message);
  object->Instant("now", event.now_ns)
      .Text("status", Name(event.status))
      .Add("lower", AgentReference(event.lower, message.lower_label(), view))
      .Add("higher", AgentReference(event.higher, message.higher_label(), view))
      .TextOrNull("level", event.level)
      .Count("contact", event.contact)
      .Count("revision", event.revision);
  if (event.contacts_sequence > 0) {
    object->Count("contacts_sequence", event.contacts_sequence);
  } else {
    object->Null("contacts_sequence");
  }
  object->Add("begin", BracketJson(event.begin))
      .Add("end", BracketJson(event.end))
      .Flag("continuous", event.continuous)
      .Flag("began_before", event.began_before)
      .Number("margin_m", event.margin_m)
      .Add("proximity", ProximityJson(event.proximity))
      .Add("lower_state", StateJson(event.lower_state))
      .Add("higher_state", StateJson(event.higher_state))
      .Add("expected", ExpectedJson(event.expected))
      .Add("closest", ClosestJson(event.closest))
      .Count("tree_level", event.tree_level)
      .Count("work_units", event.work_units)
      .Text("limited_by", Name(event.limited_by))
      .TextOrNull("because", event.because)
      .Id("service_id", message.stamp().service_id())
      .Count("term", message.stamp().term())
      .Count("epoch", message.stamp().epoch())
      .Count("sequence", message.stamp().sequence());
}

std::string EventJson(const v1::CollisionEvent& event, const WorldView& view,
                      const std::string& sentence, const std::string& told) {
  JsonObject document = JsonDocument("event");
  AddEvent(event, view, &document);
  if (!sentence.empty()) document.Text("explanation", sentence);
  if (!told.empty()) document.Text("told_utc", told);
  return document.Json();
}

std::string GapJson(std::uint64_t more, std::uint64_t so_far) {
  return JsonDocument("gap")
      .Count("contacts_missed", more)
      .Count("contacts_missed_so_far", so_far)
      .Json();
}

}  // namespace collision::client
