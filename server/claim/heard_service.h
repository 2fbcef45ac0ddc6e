// What the network says of another service, as the claim takes it.
#pragma once

#include "idl/messages.pb.h"
#include "server/claim/service_claim.h"

namespace collision::server {

inline HeardService HeardOf(const v1::ServiceHeard& heard) {
  std::string process = heard.process();
  if (!heard.version().empty()) {
    process += (process.empty() ? "version " : ", version ") + heard.version();
  }
  const OtherPhase phase = heard.phase() == v1::PHASE_CLAIMING  ? OtherPhase::kClaiming
                           : heard.phase() == v1::PHASE_STANDBY ? OtherPhase::kStandby
                                                                : OtherPhase::kServing;
  return {.instance = heard.service_id(),
          .term = heard.term(),
          .phase = phase,
          .sequence = heard.sequence(),
          .followed = heard.followed(),
          .process = process};
}

}  // namespace collision::server
