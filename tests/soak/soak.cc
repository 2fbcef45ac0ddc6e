// ./run soak: a service for long, with simulators that come and go, and beside bad ones.
#include <cstdlib>

#include "tests/soak/cases.h"
#include "tests/support/suite/suite.h"
#include "tests/system/test_world.h"

namespace collision::soak {
namespace {

std::vector<Case> AllCases() {
  std::vector<Case> all = WeekCases();
  for (const Case& one : BesideCases()) all.push_back(one);
  return all;
}

}  // namespace
}  // namespace collision::soak

int main(int argc, char** argv) {
  using namespace collision;
  // For the readers in this process, too.
  const std::string profile = "file://" + system_test::ConfigFile("cyclonedds-loopback.xml");
  setenv("CYCLONEDDS_URI", profile.c_str(), 1);
  return suite::RunSuite(
      {"soak", "A service for long: what is promised, and what was measured.", soak::AllCases()},
      argc, argv);
}
