// ./run network: what the service promises, among real programs on hosts of their own.
#include "tests/network/cases/cases.h"
#include "tests/support/suite/suite.h"

namespace collision::network {
namespace {

std::vector<Case> AllCases() {
  std::vector<Case> all;
  for (const auto& part : {ConditionCases(), LinkCases(), ProgramCases(), TakeOverCases()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace
}  // namespace collision::network

int main(int argc, char** argv) {
  return collision::suite::RunSuite(
      {"network", "Real programs on a faulty network: what is promised, and what was measured.",
       collision::network::AllCases(), collision::network::WhyNoLan},
      argc, argv);
}
