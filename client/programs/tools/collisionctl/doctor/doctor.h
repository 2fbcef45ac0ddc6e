// collisionctl doctor: why a world is silent, and what to type next.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace collision::client {

struct DoctorOptions {
  std::string world;
  std::uint32_t domain = 0;
  double timeout_s = 3;
  bool json = false;
  std::string credentials = {};  ///< A folder; empty: none.
  std::string host = {};  ///< IPv4 address of a host that is asked by unicast, too; empty: none.
};

CLI::App* AddDoctorCommand(CLI::App* app, DoctorOptions* options);

/// Looks at the network and the world for the timeout, prints what it finds to standard output,
/// and returns kExitOk where nothing is wrong, kExitRefused where something is, and
/// kExitUnavailable where DDS is not available.
int RunDoctor(const DoctorOptions& options);

}  // namespace collision::client
