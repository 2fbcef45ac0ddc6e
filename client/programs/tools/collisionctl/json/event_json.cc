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

/// What holds at the instant of evaluation; null without one.
void AddEvaluation(const Event& event, JsonObject* object) {
  object->Instant("evaluated_at", event.evaluated_at_ns);
  const bool is_evaluated = event.evaluated_at_ns != kNever;
  if (is_evaluated) {
    object->Add("separation_m", JsonObject()
                                    .Number("lower", event.separation_lower_m)
                                    .Number("upper", event.separation_upper_m)
                                    .Json());
  } else {
    object->Null("separation_m");
  }
  if (is_evaluated && event.separation_upper_m <= 0) {
    object->Number("depth_lower_m", event.depth_lower_m)
        .Add("point_m", PointJson(event.point_m))
        .Number("point_error_m", event.point_error_m)
        .Add("normal", PointJson(event.normal))
        .Number("normal_error_rad", event.normal_error_rad);
  } else {
    object->Null("depth_lower_m").Null("point_m").Null("point_error_m").Null("normal");
    object->Null("normal_error_rad");
  }
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
      .Number("margin_m", event.margin_m);
  AddEvaluation(event, object);
  object->Count("tree_level", event.tree_level)
      .Count("work_units", event.work_units)
      .Text("limited_by", Name(event.limited_by))
      .TextOrNull("because", event.because)
      .Id("service_id", message.stamp().service_id())
      .Count("term", message.stamp().term())
      .Count("epoch", message.stamp().epoch())
      .Count("sequence", message.stamp().sequence());
}

std::string EventJson(const v1::CollisionEvent& event, const WorldView& view,
                      const std::string& sentence) {
  JsonObject document = JsonDocument("event");
  AddEvent(event, view, &document);
  if (!sentence.empty()) document.Text("explanation", sentence);
  return document.Json();
}

std::string GapJson(std::uint64_t more, std::uint64_t so_far) {
  return JsonDocument("gap")
      .Count("contacts_missed", more)
      .Count("contacts_missed_so_far", so_far)
      .Json();
}

}  // namespace collision::client
