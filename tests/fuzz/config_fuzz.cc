#include <cmath>

#include "server/config/config.h"
#include "tests/fuzz/targets.h"

namespace collision::fuzz {

// What is accepted is printed, and read back as the same: a configuration that cannot be told again
// would be another one after a restart.
void FuzzConfig(Bytes bytes) {
  const std::string text(bytes.begin(), bytes.end());
  const server::ConfigResult read = server::ParseConfig(text, "fuzzed");
  for (const std::string& error : read.errors) {
    Require(error.starts_with("fuzzed"), "an error that does not name its file: ", error);
  }
  if (!read.ok()) return;
  Require(server::CheckConfig(read.config).empty(), "accepted, and not valid");
  Require(server::WorkUnitsPerEvaluation(read.config) <= std::uint64_t{1} << 60,
          "work per evaluation");
  Require(server::WorkUnitsPerStep(read.config) <= std::uint64_t{1} << 60, "work per step");
  const std::string printed = server::PrintConfig(read.config);
  const server::ConfigResult again = server::ParseConfig(printed, "printed");
  Require(again.ok(), "what was printed is refused: ", again.ok() ? "" : again.errors.front());
  Require(again.config.SerializeAsString() == read.config.SerializeAsString(),
          "read back as another configuration:\n", printed);
}

}  // namespace collision::fuzz
