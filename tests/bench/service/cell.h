// One measurement of a service: update to event, and updates per second.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/service/parts.h"

namespace collision::bench {

/// Credentials of both ends; empty: the world is not secured.
struct Access {
  std::string service;    ///< A folder.
  std::string simulator;  ///< Likewise, of ServiceDriver::kSimulator.
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
                                const Access& access = {});

double UpdatesPerSecond(const Cell& cell, std::uint32_t agents);

}  // namespace collision::bench
