// What one service hears of another one.
#pragma once

#include "idl/limits.h"
#include "idl/messages.pb.h"

namespace collision {

/// The part of a service's status that other services take note of.
inline v1::ServiceHeard HeardOf(const v1::ServiceStatus& status) {
  v1::ServiceHeard heard;
  heard.set_service_id(status.service_id());
  heard.set_term(status.stamp().term());
  heard.set_epoch(status.stamp().epoch());
  heard.set_sequence(status.stamp().sequence());
  heard.set_phase(status.phase());
  heard.set_granted_until_ns(status.granted_until_ns());
  heard.set_followed(status.followers() > 0);
  heard.set_now_ns(status.now_ns());
  heard.set_agents(status.agents());
  heard.set_configuration(status.configuration());
  heard.set_version(status.version());
  heard.set_simulated_clock(status.simulated_clock());
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() == wire::kProcessExtension) heard.set_process(extension.value());
    if (extension.key() == wire::kEndedRunsExtension) heard.set_ended_runs(extension.value());
  }
  return heard;
}

}  // namespace collision
