#include "client/library/world/revision_filter.h"

namespace collision::client {
namespace {

bool SameAgent(const v1::AgentId& a, const v1::AgentId& b) {
  return a.simulator_id() == b.simulator_id() && a.run() == b.run() && a.slot() == b.slot() &&
         a.generation() == b.generation();
}

bool SameContact(const v1::CollisionEvent& a, const v1::CollisionEvent& b) {
  return a.contact() == b.contact() && SameAgent(a.lower(), b.lower()) &&
         SameAgent(a.higher(), b.higher());
}

}  // namespace

bool RevisionFilter::IsNew(const v1::CollisionEvent& event) {
  const auto [entry, first] = seen_.try_emplace(event.pair_slot(), event);
  if (first) return true;
  const v1::CollisionEvent& known = entry->second;
  if (SameContact(known, event)) {
    const bool outdated =
        known.stamp().service_id() == event.stamp().service_id()
            ? event.revision() <= known.revision()
            : event.revision() == known.revision() && event.status() == known.status();
    if (outdated) return false;
  }
  entry->second = event;
  return true;
}

}  // namespace collision::client
