// ./run stress: stiff and extreme scenes, each with what is promised and what was measured.
#include "tests/stress/case.h"
#include "tests/support/suite/suite.h"
#include "tests/support/truth/exact_dyadic.h"

namespace collision::stress {

std::vector<Case> AllCases() {
  std::vector<Case> all;
  for (const auto& part :
       {PairCases(), ContractCases(), ShapeCases(), BracketCases(), SceneCases(), RestingCases(),
        ViolentCases(), CrowdCases(), EdgeCases(), LongCases()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace collision::stress

int main(int argc, char** argv) {
  collision::DyadicPool::Install();
  return collision::suite::RunSuite(
      {"stress", "Stiff and extreme scenes: what is promised of each, and what was measured.",
       collision::stress::AllCases()},
      argc, argv);
}
