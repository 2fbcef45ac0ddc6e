#include "client/programs/scene/scene.h"

#include <algorithm>

#include "client/programs/tools/collisionctl/status/status_fields.h"
#include "idl/identity.h"

namespace collision::client {

namespace {

/// All of a status on which it depends how an agent is present.
std::string PresenceIn(const v1::ServiceStatus& status) {
  std::string presence;
  for (const v1::SimulatorStatus& one : status.simulators()) {
    presence += IdText(one.simulator_id()) + " " + std::to_string(one.run()) +
                (one.alive() ? " alive\n" : " silent\n");
  }
  for (const char* key : {"waiting_for", "evicted", "removed_silent"}) {
    presence += ExtensionOf(status, key) + "\n";
  }
  return presence;
}

}  // namespace

MessageMonitor::Callbacks Scene::Callbacks() {
  MessageMonitor::Callbacks all = view_.Callbacks();
  const auto also = [](auto* callback, auto more) {
    *callback = [first = *callback, more](const auto& message) {
      if (first) first(message);
      more(message);
    };
  };
  also(&all.status, [this](const v1::ServiceStatus& status) {
    changes_.status = true;
    events_.ForgetEpochsBefore(status.stamp(), status.service_id());
    now_ns_ = status.now_ns();
    if (std::string presence = PresenceIn(status); presence != presence_) {
      presence_ = std::move(presence);
      changes_.agents.insert(known_.begin(), known_.end());
    }
  });
  also(&all.earliest, [this](const v1::EarliestIntersection&) { changes_.earliest = true; });
  also(&all.event, [this](const v1::CollisionEvent& event) { events_.Take(event); });
  also(&all.description, [this](const v1::AgentDescription& description) {
    known_.insert({description.simulator_id(), description.slot()});
    changes_.agents.insert({description.simulator_id(), description.slot()});
  });
  also(&all.removal, [this](const v1::AgentRemoval& removal) {
    const SceneChanges::Slot slot{removal.simulator_id(), removal.slot()};
    changes_.agents.insert(slot);
    // That of an earlier program removes nothing.
    if (view_.Newest(slot.first, slot.second)) return;
    states_.Clear(slot.first, slot.second);
    known_.erase(slot);
  });
  also(&all.breach, [this](const v1::AgentBreach& breach) {
    changes_.agents.insert({breach.simulator_id(), breach.slot()});
  });
  also(&all.states, [this](const v1::AgentStates& states) { states_.Take(states); });
  also(&all.clearance, [this](const v1::Clearance& clearance) {
    states_.Take(clearance);
    now_ns_ = std::max(now_ns_, clearance.now_ns());
  });
  also(&all.shape_part, [this](const v1::ShapePart& part) {
    if (shapes_.Take(part)) changes_.shapes.push_back(part.content_hash());
  });
  return all;
}

SceneChanges Scene::TakeChanges() {
  static_cast<void>(view_.TakeEvents());
  SceneChanges changes = std::exchange(changes_, {});
  for (const SceneChanges::Slot& slot : changes.agents) states_.NumberOf(slot.first, slot.second);
  changes.chunks = states_.TakeChanged();
  changes.events = events_.TakeChanges();
  changes.now = now_ns_ != std::exchange(taken_ns_, now_ns_);
  return changes;
}

}  // namespace collision::client
