// The daemon's configuration: read, completed, checked and printed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "idl/config.pb.h"
#include "server/config/config_error.h"

namespace collision::server {

struct ConfigResult {
  v1::Config config;                ///< Complete; valid only if ok().
  std::vector<std::string> errors;  ///< "file:line: field: what is wrong; allowed: range", by line.

  bool ok() const { return errors.empty(); }
};

/// Reads protobuf text and fills in the defaults. `name` stands for the file in errors. Reading
/// goes on after an error where it can, so that all errors are reported, one per field.
ConfigResult ParseConfig(const std::string& text, const std::string& name);

/// ParseConfig of a file's content; a file that cannot be read is an error too.
ConfigResult LoadConfig(const std::string& path);

/// Fills every field that is not set with its default.
v1::Config CompleteConfig(v1::Config config);

/// Checks a complete configuration: every field, then fields against each other.
std::vector<ConfigError> CheckConfig(const v1::Config& complete);

/// What the narrow phase may spend on one pair in one evaluation: `time_budget_us` ·
/// `work_units_per_us`. A budget in work units and not a deadline, so that it ends at the same
/// place on every machine; `--calibrate` measures the rate.
std::uint64_t WorkUnitsPerEvaluation(const v1::Config& complete);

/// What it may spend on all pairs in one step, from `step_budget_us`; 0: no limit. The detector
/// shares it among the pairs, and `evaluations_cut_short` in the status counts those that had too
/// little.
std::uint64_t WorkUnitsPerStep(const v1::Config& complete);

/// A complete configuration as protobuf text that explains itself; ParseConfig() reads back the
/// same values.
std::string PrintConfig(const v1::Config& complete);

}  // namespace collision::server
