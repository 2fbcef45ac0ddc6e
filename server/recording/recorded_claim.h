// The claim of a service, as its recordings hold it.
#pragma once

#include <cstdint>

#include "idl/recording.pb.h"
#include "server/claim/service_claim.h"

namespace collision::server {

v1::ServiceClaim ToMessage(const ClaimOptions& claim);
ClaimOptions FromMessage(const v1::ServiceClaim& message);

/// The first entry of a recording. `config`: complete. `segment`: as in the message.
v1::RecordingEntry HeaderOf(const v1::Config& config, const ClaimOptions& claim,
                            std::uint32_t segment);

}  // namespace collision::server
