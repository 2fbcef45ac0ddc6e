// The client library's network: DDS.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "client/library/network/transport.h"
#include "collision/monitor.h"

namespace collision::client {

/// Writes in partition "<world>.<simulator>", reads the service in "<world>".
/// Throws std::runtime_error if DDS is not available.
std::unique_ptr<Transport> ConnectSimulator(const std::string& world, const std::string& simulator,
                                            std::uint32_t domain);

/// Writes the commands of an operator, reads the service. Throws as above.
std::unique_ptr<Transport> ConnectOperator(const std::string& world, std::uint32_t domain);

/// Writes what is watched, reads nothing. Throws as above.
std::unique_ptr<Transport> ConnectWatcher(const std::string& world, std::uint32_t domain);

/// Reads the service's hello and status, and nothing else: little for the network, and no work for
/// the service. Throws as above.
std::unique_ptr<Receiver> ConnectStatusReader(const std::string& world, std::uint32_t domain);

/// Creates readers only, of the topics that the options select. Throws as above.
std::unique_ptr<Receiver> ConnectMonitor(const MonitorOptions& options);

}  // namespace collision::client
