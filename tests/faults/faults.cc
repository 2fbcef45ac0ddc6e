// ./run faults: what the service promises, over a network and beside programs that fail.
#include <spdlog/spdlog.h>

#include "tests/faults/cases/cases.h"
#include "tests/support/suite/suite.h"

namespace collision::faults {
namespace {

std::vector<Case> AllCases() {
  std::vector<Case> all;
  for (const auto& part : {NetworkCases(), ProgramCases(), StandbyCases(), ClockCases(),
                           HostileCases(), AgentCases(), MemoryCases()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace
}  // namespace collision::faults

int main(int argc, char** argv) {
  spdlog::set_level(spdlog::level::off);
  return collision::suite::RunSuite(
      {"faults", "Faults of the network and of programs: what is promised, and what was measured.",
       collision::faults::AllCases()},
      argc, argv);
}
