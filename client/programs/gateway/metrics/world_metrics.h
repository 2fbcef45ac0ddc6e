// A world in numbers, for those who watch many.
#pragma once

#include <cstdint>
#include <string>

#include "client/programs/shared/world_view.h"

namespace collision::gateway {

/// What the gateway knows beside the world.
struct GatewayMeasures {
  std::string world;
  std::string version;
  bool service_up = false;  ///< Heard, with a fresh status.
  int viewers = 0;
  std::uint64_t contacts_missed = 0;
};

/// The text of /metrics: seconds and bytes, names from collision_ on; of a world without a service
/// only what the gateway knows.
std::string WorldMetrics(const client::WorldView& view, const GatewayMeasures& measures);

}  // namespace collision::gateway
