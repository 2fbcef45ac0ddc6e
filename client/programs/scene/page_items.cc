#include "client/programs/scene/page_items.h"

#include <utility>
#include <vector>

#include "client/library/network/conversion.h"
#include "client/programs/scene/item.h"
#include "client/programs/tools/collisionctl/events/event_filter.h"
#include "client/programs/tools/collisionctl/json/event_json.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"
#include "client/programs/tools/collisionctl/json/status_json.h"
#include "client/programs/tools/collisionctl/json/world_json.h"
#include "collision/event_text.h"
#include "collision/shape.h"

namespace collision::client {
namespace {

std::string BracketJson(const v1::TimeBracket& bracket) {
  return JsonObject()
      .Instant("earliest", bracket.earliest_ns())
      .Instant("latest", bracket.latest_ns())
      .Json();
}

std::string KeyText(std::uint64_t number) { return "event/" + std::to_string(number); }

std::string EventItem(const EventBook::Entry& entry, const WorldView& view) {
  const auto full_name = [&view](const AgentId& id) { return view.FullName(id); };
  const std::string sentence =
      EventSentence(FromMessage(entry.newest), full_name, NowOf(entry.newest, view), 0);
  std::vector<std::string> revisions;
  for (const EventBook::Revision& revision : entry.revisions) {
    JsonObject one;
    one.Instant("now", revision.now_ns)
        .Add("begin", BracketJson(revision.begin))
        .Add("end", BracketJson(revision.end))
        .Text("status", Name(static_cast<EventStatus>(revision.status)));
    revisions.push_back(one.Json());
  }
  return JsonObject()
      .Text("item", "event")
      .Text("key", KeyText(entry.number))
      .Flag("superseded", entry.is_superseded)
      .Add("event", EventJson(entry.newest, view, sentence))
      .Add("revisions", JsonArray(revisions))
      .Json();
}

std::string StatusItem(const WorldView& view) {
  return JsonObject()
      .Text("item", "status")
      .Number("skew_max_s", 1e-9 * static_cast<double>(view.skew_max_ns()))
      .Add("status", StatusJson(view))
      .Json();
}

}  // namespace

bool PageItems::Put(const Scene& scene, const SceneChanges& changes, const Connection& connection) {
  changed_ = false;
  if (connection_ != connection) PutConnection(connection);
  const WorldView& view = scene.view();
  if (changes.status && view.status()) PutJson("status", StatusItem(view));
  if (changes.earliest) {
    PutJson("earliest",
            JsonObject().Text("item", "earliest").Add("earliest", EarliestJson(view)).Json());
  }
  for (const std::string& shape : changes.shapes) {
    const std::string hash = HexText(shape);
    PutJson("shape/" + hash, JsonObject().Text("item", "shape").Text("hash", hash).Json());
  }
  for (const SceneChanges::Slot& slot : changes.agents) PutAgent(scene, slot);
  for (const std::uint32_t chunk : changes.chunks) {
    if (states_ == StatesOnBoard::kNone) break;
    board_.Put("states/" + std::to_string(chunk),
               MakeItem(ItemKind::kStates, scene.states().Pack(chunk)));
    changed_ = true;
  }
  PutEvents(scene, changes.events);
  if (changes.now) {
    PutJson("now", JsonObject().Text("item", "now").Instant("now", scene.now_ns()).Json());
  }
  return changed_;
}

void PageItems::Beat() { PutJson("beat", JsonObject().Text("item", "beat").Json()); }

void PageItems::PutJson(const std::string& name, std::string json) {
  board_.Put(name, MakeItem(ItemKind::kJson, std::move(json)));
  changed_ = true;
}

void PageItems::PutConnection(const Connection& connection) {
  connection_ = connection;
  PutJson("connection", JsonObject()
                            .Text("item", "connection")
                            .Flag("service_alive", connection.service_alive)
                            .Count("contacts_missed", connection.contacts_missed)
                            .TextOrNull("unreadable", connection.unreadable)
                            .Json());
}

void PageItems::PutAgent(const Scene& scene, const SceneChanges::Slot& slot) {
  const auto number = scene.NumberOf(slot);
  if (!number) return;
  JsonObject item;
  item.Text("item", "agent").Count("number", *number);
  auto agent = scene.view().Newest(slot.first, slot.second);
  if (agent) {
    agent->state.reset();  // in the chunks of states
    agent->clearance.reset();
    item.Add("agent", AgentJson(*agent, scene.view()));
  } else {
    item.Null("agent");
  }
  PutJson("agent/" + std::to_string(*number), item.Json());
}

/// Those who have an event that is dropped hear that it is gone; so many are told of it as may be
/// kept.
void PageItems::PutEvents(const Scene& scene, const EventBook::Changes& changes) {
  for (const std::uint64_t number : changes.dropped) {
    board_.Remove(KeyText(number));
    PutJson("gone/" + std::to_string(gone_++ % EventBook::kEventsMax),
            JsonObject().Text("item", "event").Text("key", KeyText(number)).Null("event").Json());
  }
  for (const std::uint64_t number : changes.changed) {
    PutJson(KeyText(number), EventItem(scene.events().At(number), scene.view()));
  }
}

}  // namespace collision::client
