// collision-gateway: a world in the browser.
#include "client/programs/gateway/gateway.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/stop_signal.h"

int main(int argc, char** argv) {
  using namespace collision;
  CLI::App app("Shows a world to browsers: a page in 3D, Foxglove, metrics");
  client::NameAsCalled(&app, argv[0]);
  gateway::GatewayOptions options;
  gateway::AddGatewayOptions(&app, &options);
  if (const auto code = client::ParseCommandLine(&app, argc, argv)) return *code;
  return client::RunProgram("collision-gateway", [&options] {
    client::CatchStopSignals();
    return gateway::RunGateway(options, client::StopRequested);
  });
}
