#include "client/programs/gateway/scene/scene.h"

#include <algorithm>
#include <chrono>

#include "client/programs/gateway/scene/item.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"
#include "client/programs/tools/collisionctl/json/status_json.h"
#include "client/programs/tools/collisionctl/json/world_json.h"
#include "client/programs/tools/collisionctl/status/status_fields.h"
#include "collision/shape.h"
#include "idl/identity.h"

namespace collision::gateway {

using client::JsonObject;

namespace {

/// All of a status on which it depends how an agent is present.
std::string PresenceIn(const v1::ServiceStatus& status) {
  std::string presence;
  for (const v1::SimulatorStatus& one : status.simulators()) {
    presence += IdText(one.simulator_id()) + " " + std::to_string(one.run()) +
                (one.alive() ? " alive\n" : " silent\n");
  }
  for (const char* key : {"waiting_for", "evicted", "removed_silent"}) {
    presence += client::ExtensionOf(status, key) + "\n";
  }
  return presence;
}

}  // namespace

client::MessageMonitor::Callbacks Scene::Callbacks() {
  client::MessageMonitor::Callbacks all = view_.Callbacks();
  const auto also = [](auto* callback, auto more) {
    *callback = [first = *callback, more](const auto& message) {
      if (first) first(message);
      more(message);
    };
  };
  also(&all.status, [this](const v1::ServiceStatus& status) {
    has_status_ = true;
    events_.ForgetEpochsBefore(status.stamp(), status.service_id());
    now_ns_ = status.now_ns();
    if (std::string presence = PresenceIn(status); presence != presence_) {
      presence_ = std::move(presence);
      described_.insert(known_.begin(), known_.end());
    }
  });
  also(&all.earliest, [this](const v1::EarliestIntersection&) { has_earliest_ = true; });
  also(&all.event, [this](const v1::CollisionEvent& event) { events_.Take(event); });
  also(&all.description, [this](const v1::AgentDescription& description) {
    known_.insert({description.simulator_id(), description.slot()});
    described_.insert({description.simulator_id(), description.slot()});
  });
  also(&all.removal, [this](const v1::AgentRemoval& removal) {
    const Slot slot{removal.simulator_id(), removal.slot()};
    described_.insert(slot);
    // That of an earlier program removes nothing.
    if (view_.Newest(slot.first, slot.second)) return;
    states_.Clear(slot.first, slot.second);
    known_.erase(slot);
  });
  also(&all.breach, [this](const v1::AgentBreach& breach) {
    described_.insert({breach.simulator_id(), breach.slot()});
  });
  also(&all.states, [this](const v1::AgentStates& states) { states_.Take(states); });
  also(&all.clearance, [this](const v1::Clearance& clearance) {
    states_.Take(clearance);
    now_ns_ = std::max(now_ns_, clearance.now_ns());
  });
  also(&all.shape_part, [this](const v1::ShapePart& part) {
    if (!shapes_.Take(part)) return;
    const std::string hash = client::HexText(part.content_hash());
    Put("shape/" + hash, JsonObject().Text("item", "shape").Text("hash", hash).Json());
  });
  return all;
}

bool Scene::Publish(const Connection& connection) {
  changed_ = false;
  if (connection_ != connection) {
    connection_ = connection;
    Put("connection", JsonObject()
                          .Text("item", "connection")
                          .Flag("service_alive", connection.service_alive)
                          .Count("contacts_missed", connection.contacts_missed)
                          .TextOrNull("unreadable", connection.unreadable)
                          .Json());
  }
  if (std::exchange(has_status_, false) && view_.status()) {
    Put("status", JsonObject()
                      .Text("item", "status")
                      .Number("skew_max_s", 1e-9 * static_cast<double>(view_.skew_max_ns()))
                      .Add("status", client::StatusJson(view_))
                      .Json());
  }
  if (std::exchange(has_earliest_, false)) {
    Put("earliest",
        JsonObject().Text("item", "earliest").Add("earliest", client::EarliestJson(view_)).Json());
  }
  for (const Slot& slot : std::exchange(described_, {})) PutAgent(slot);
  for (StateTable::Chunk& chunk : states_.TakeChanged()) {
    board_.Put("states/" + std::to_string(chunk.number),
               MakeItem(ItemKind::kStates, std::move(chunk.bytes)));
    changed_ = true;
  }
  static_cast<void>(view_.TakeEvents());
  for (const EventBook::Shown& page : events_.TakeChanged(view_)) {
    if (!page.json.empty()) {
      Put(page.key, page.json);
    } else {
      board_.Remove(page.key);
      PutGone(page.key);
    }
  }
  if (now_ns_ != shown_ns_) PutNow();
  return changed_;
}

void Scene::Put(const std::string& name, std::string json) {
  board_.Put(name, MakeItem(ItemKind::kJson, std::move(json)));
  changed_ = true;
}

void Scene::PutAgent(const Slot& slot) {
  const auto number = states_.NumberOf(slot.first, slot.second);
  if (!number) return;
  JsonObject item;
  item.Text("item", "agent").Count("number", *number);
  auto agent = view_.Newest(slot.first, slot.second);
  if (agent) {
    agent->state.reset();  // in the chunks of states
    agent->clearance.reset();
    item.Add("agent", client::AgentJson(*agent, view_));
  } else {
    item.Null("agent");
  }
  Put("agent/" + std::to_string(*number), item.Json());
}

/// Those who have it hear that it is gone; so many are told of it as may be kept.
void Scene::PutGone(const std::string& key) {
  Put("gone/" + std::to_string(gone_++ % EventBook::kEventsMax),
      JsonObject().Text("item", "event").Text("key", key).Null("event").Json());
}

void Scene::Beat() { Put("beat", JsonObject().Text("item", "beat").Json()); }

void Scene::PutNow() {
  shown_ns_ = now_ns_;
  Put("now", JsonObject().Text("item", "now").Instant("now", now_ns_).Json());
}

}  // namespace collision::gateway
