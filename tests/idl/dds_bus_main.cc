// The test program, which is its own child process when called with a domain, a world and a count.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/idl/dds_bus_support.h"

int main(int argc, char** argv) {
  // A participant's own lease (10 s by default) must not be what notices a death: only a writer's
  // may.
  const std::string never =
      ",<CycloneDDS><Domain><Discovery><LeaseDuration>1 hr</LeaseDuration></Discovery>"
      "</Domain></CycloneDDS>";
  setenv("CYCLONEDDS_URI", (COLLISION_DDS_LOOPBACK + never).c_str(), 1);
  if (argc == 4) {
    const auto domain = static_cast<std::uint32_t>(std::stoul(argv[1]));
    return collision::server::RunChildSimulator(domain, argv[2], std::stoul(argv[3]));
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
