#include "client/programs/gateway/gateway.h"
#include "client/programs/shared/command_line.h"

namespace collision::gateway {

void AddGatewayOptions(CLI::App* app, GatewayOptions* options) {
  constexpr int kPortMax = 65535, kConnectionsMax = 65536;
  client::AddWorldOptions(app, "The world to show", &options->monitor.world,
                          &options->monitor.domain, &options->monitor.credentials);
  app->add_option("--address", options->web.address,
                  "Address to listen on; beyond this machine only with --token-file")
      ->capture_default_str()
      ->check(CLI::ValidIPV4 | client::OneOf({"::1", "::"}));
  app->add_option("--port", options->web.port, "Port, 0 to 65535; 0: any that is free")
      ->capture_default_str()
      ->check(client::WholeBetween(0, kPortMax));
  app->add_option("--token-file", options->token_file,
                  "File whose first line viewers must bring: /?token=..., or as a bearer token");
  app->add_option("--host", options->web.hosts,
                  "Further name by which browsers call the gateway, without the port");
  app->add_option("--origin", options->web.origins,
                  "Page from elsewhere that may connect, such as https://app.foxglove.dev");
  app->add_option("--connections", options->web.connections_max,
                  "Most connections at a time, 1 to 65536")
      ->capture_default_str()
      ->check(client::WholeBetween(1, kConnectionsMax));
  app->add_option("--rate", options->rate_hz, "Updates of a viewer per second, at most, 1 to 50")
      ->capture_default_str()
      ->check(client::Between(1, 50));
  app->add_flag("!--no-watch", options->watch,
                "Do not ask simulators for fresh states while somebody looks");
  app->add_option("--page", options->page, "Folder of the page, instead of the installed one");
}

}  // namespace collision::gateway
