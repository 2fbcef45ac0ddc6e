// Whether the service of a world is well, for probes: one sentence and an exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "client/programs/shared/world_view.h"

namespace collision::client {

struct HealthOptions {
  std::string world;
  std::uint32_t domain = 0;
  double max_age_s = 3;                 ///< A status must come within it.
  std::size_t simulators_required = 0;  ///< Alive.
  bool json = false;
  std::string credentials = {};  ///< Folder; empty: none.
};

/// As monitoring systems expect: the values are exit codes.
enum class HealthLevel {
  kWell = 0,
  kTrouble = 1,  ///< It serves, and an operator should see to something.
  kCritical = 2  ///< It does not serve, or simulators that are required are missing.
};

struct Health {
  HealthLevel level = HealthLevel::kCritical;
  std::string text;  ///< One sentence, without a newline.
};

/// Of a service of which two statuses have come, `before` and the one in `view`, since nobody asks
/// for a status that is kept for those who come late.
Health HealthOf(const v1::ServiceStatus& before, const WorldView& view,
                std::size_t simulators_required);

/// A document of kind "health", one line without a newline.
std::string HealthJson(const Health& health);

CLI::App* AddHealthCommand(CLI::App* app, HealthOptions* options);

/// Reads the status alone, waits for a fresh one, prints the sentence to standard output, and
/// returns the exit code; that DDS is not available is critical.
int RunHealth(const HealthOptions& options);

}  // namespace collision::client
