// ./run bench service: what the service adds to what the network takes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/harness/options.h"
#include "tests/bench/harness/report.h"

namespace collision::bench {

struct ServiceSettings : CommonOptions {
  std::uint32_t domain = 77;
};

/// One measurement: its line of the table, and its fields in the file.
struct ServiceRow {
  std::string line;
  std::vector<Field> fields = {};  ///< Empty: not in the file.

  std::string Line() const { return line; }
  std::string Json() const { return fields.empty() ? "" : Object(fields); }
};

struct ServiceReport : RowReport<ServiceRow> {
  ServiceReport();
};

/// Update to event, and updates per second, of the service and of a program of the same bus code
/// that answers at once without a thought.
void LatencyPart(const ServiceSettings& settings, ServiceReport* report);

/// The protections of a secured world, as collisionctl make-certificates names them.
inline constexpr const char* kProtections[] = {"sign", "sign-for-each-reader", "encrypt"};

/// The same with an option of the service, beside the service without: a secured world, by each
/// protection, and the flight recorder.
void OptionsPart(const ServiceSettings& settings, ServiceReport* report);

/// What a step costs that also asks for the earliest possible intersection, in a lattice of agents
/// at rest and in a jittered one.
void AtRestPart(const ServiceSettings& settings, ServiceReport* report);

/// Update to event beside a simulator whose many meshes overlap, and without it.
void CrowdPart(const ServiceSettings& settings, ServiceReport* report);

/// How many states a simulator sends on demand, of those that a stream would send.
void MessagesPart(const ServiceSettings& settings, ServiceReport* report);

}  // namespace collision::bench
