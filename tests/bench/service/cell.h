// One measurement of a service: update to event, and updates per second.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/service/parts.h"
#include "tests/bench/service/process.h"

namespace collision::bench {

/// Of the service, and of the simulator beside it.
struct CellFolders {
  ServiceFolders service = {};
  std::string simulator_credentials = {};  ///< Of ServiceDriver::kSimulator; empty: none.
};

struct Cell {
  std::vector<double> latencies;  ///< [s]
  std::vector<double> rounds;     ///< [s]
  double cpu = 0;                 ///< Of the service, during the rounds [s].
  std::uint32_t lost = 0;         ///< Events that did not come.
};

/// nullopt: no answer in time. `world`: of this cell alone.
std::optional<Cell> MeasureCell(const ServiceSettings& settings, const std::string& contestant,
                                const std::string& world, std::uint32_t agents,
                                const CellFolders& folders = {});

double UpdatesPerSecond(const Cell& cell, std::uint32_t agents);

}  // namespace collision::bench
