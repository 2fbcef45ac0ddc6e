// The client library's network: DDS.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "client/library/network/transport.h"
#include "collision/monitor.h"

namespace collision::client {

/// Where a program joins, and as whom.
struct Place {
  std::string world;
  std::uint32_t domain = 0;
  std::string credentials = {};  ///< A folder; empty: none.
};

/// Writes in partition "<world>.<simulator>", reads the service in "<world>".
/// Throws std::runtime_error if DDS is not available or refuses the credentials.
std::unique_ptr<Transport> ConnectSimulator(const Place& place, const std::string& simulator);

/// Writes the commands of an operator, reads the service. Throws as above.
std::unique_ptr<Transport> ConnectOperator(const Place& place);

/// Writes what is watched, reads nothing. Throws as above.
std::unique_ptr<Transport> ConnectWatcher(const Place& place);

/// Reads the service's hello and status, and nothing else: little for the network, and no work for
/// the service. Throws as above.
std::unique_ptr<Receiver> ConnectStatusReader(const Place& place);

/// Creates readers only, of the topics that the options select. Throws as above.
std::unique_ptr<Receiver> ConnectMonitor(const MonitorOptions& options);

}  // namespace collision::client
