// Goal:   what Cyclone DDS says of itself is handed on, as lines that a log can hold.
#include "idl/dds/network_log.h"

#include <dds/ddsrt/log.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace collision::dds {
namespace {

void Say(const char* text, int number) {
  dds_log(DDS_LC_ERROR, __FILE__, __LINE__, __func__, text, number);
}

TEST(NetworkLog, HandsOnEachLineUntilAnotherOneDoes) {
  std::vector<std::string> first, second;
  SetNetworkLog([&](const std::string& line) { first.push_back(line); });
  Say("cannot send to %d\n", 7);
  Say("late\x1b[31m %d\n", 8);
  SetNetworkLog([&](const std::string& line) { second.push_back(line); });
  Say("%d bytes\n", 9);
  SetNetworkLog(nullptr);
  EXPECT_EQ(first, (std::vector<std::string>{"cannot send to 7", "late?[31m 8"}));
  EXPECT_EQ(second, std::vector<std::string>{"9 bytes"});
}

}  // namespace
}  // namespace collision::dds
