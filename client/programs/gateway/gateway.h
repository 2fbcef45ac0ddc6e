// The gateway: a monitor of one world, for browsers and other programs that speak HTTP.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "client/programs/gateway/web/web_server.h"
#include "collision/monitor.h"

namespace collision::gateway {

struct GatewayOptions {
  client::MonitorOptions monitor;
  WebOptions web;
  std::string page;        ///< Folder of the page; empty: where it is installed, or was built.
  std::string token_file;  ///< Empty: none.
  double rate_hz = 10;     ///< How often viewers are shown something new, at most.
  bool watch = true;       ///< Simulators are asked for fresh states while somebody looks.
};

/// `options` outlives `app`.
void AddGatewayOptions(CLI::App* app, GatewayOptions* options);

/// Serves until `stopped`. Throws std::runtime_error if DDS, the address, the page or the token
/// file cannot be used, and BadInput if what they say may not be. Returns the exit code.
int RunGateway(const GatewayOptions& options, const std::function<bool()>& stopped);

}  // namespace collision::gateway
