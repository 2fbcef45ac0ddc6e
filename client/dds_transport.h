// The client library's network: DDS.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "client/monitor.h"
#include "client/transport.h"

namespace collision::client {

/// Writes in the partition "<world>.<simulator>", reads the service in "<world>".
/// Throws std::runtime_error if DDS is not to be had.
std::unique_ptr<Transport> ConnectSimulator(const std::string& world, const std::string& simulator,
                                            std::uint32_t domain);

/// Readers only, of the topics that the options name. Throws as above.
std::unique_ptr<Receiver> ConnectMonitor(const MonitorOptions& options);

}  // namespace collision::client
