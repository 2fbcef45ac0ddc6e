// Goal:   what Cyclone DDS says of itself is handed on, as lines that a log can hold.
#include "idl/dds/network_log.h"

#include <dds/ddsrt/log.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace collision::dds {
namespace {

TEST(NetworkLog, HandsOnEachLineAndWhetherItIsAnError) {
  std::vector<std::pair<bool, std::string>> lines;
  SetNetworkLog(
      [&](bool is_error, const std::string& line) { lines.emplace_back(is_error, line); });
  dds_log(DDS_LC_ERROR, __FILE__, __LINE__, __func__, "cannot send to %d\n", 7);
  dds_log(DDS_LC_WARNING, __FILE__, __LINE__, __func__, "late\x1b[31m\n");
  SetNetworkLog([](bool, const std::string&) {});
  dds_log(DDS_LC_ERROR, __FILE__, __LINE__, __func__, "not for the first one\n");
  const std::vector<std::pair<bool, std::string>> expected = {{true, "cannot send to 7"},
                                                              {false, "late?[31m"}};
  EXPECT_EQ(lines, expected);
}

}  // namespace
}  // namespace collision::dds
