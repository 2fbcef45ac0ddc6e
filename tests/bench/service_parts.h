// ./run bench service: what the service adds to what the network takes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/json.h"

namespace collision::bench {

struct ServiceSettings {
  bool quick = false;
  std::string only;
  std::uint32_t domain = 77;

  bool Wants(const std::string& name) const { return name.find(only) != std::string::npos; }
};

/// Rows for people, measurements for programs, and the figures of all.
class ServiceReport {
 public:
  ServiceReport();

  void AddRow(const std::string& row) { rows_.push_back(row); }
  void AddMeasurement(const std::vector<Field>& fields) { objects_.push_back(Object(fields)); }
  void Set(const std::string& figure, std::optional<double> value) { figures_.Set(figure, value); }

  std::string Table() const;
  std::string Json() const { return figures_.Json(objects_); }

 private:
  Figures figures_;
  std::vector<std::string> rows_;
  std::vector<std::string> objects_;
};

/// Update to event, and updates per second, of the service and of a program of the same bus code that
/// answers at once without a thought.
void LatencyPart(const ServiceSettings& settings, ServiceReport* report);

/// How many states a simulator sends on demand, of those that a stream would send.
void MessagesPart(const ServiceSettings& settings, ServiceReport* report);

}  // namespace collision::bench
