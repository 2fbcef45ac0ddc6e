// Goal:   a program that names no world joins that of its shell.
// Method: the two variables set, empty, unset, and with values that are no domain.
#include "collision/environment.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "collision/monitor.h"
#include "collision/world.h"

namespace collision::client {
namespace {

class EnvironmentTest : public testing::Test {
 protected:
  ~EnvironmentTest() override {
    unsetenv("COLLISION_WORLD");
    unsetenv("COLLISION_DOMAIN");
  }

  static void Set(const char* world, const char* domain) {
    setenv("COLLISION_WORLD", world, 1);
    setenv("COLLISION_DOMAIN", domain, 1);
  }
};

TEST_F(EnvironmentTest, OptionsThatAreLeftOutFollowIt) {
  Set("lab", "7");
  const WorldOptions simulator{.simulator = "sim"};
  EXPECT_EQ(simulator.world, "lab");
  EXPECT_EQ(simulator.domain, 7u);
  EXPECT_EQ(MonitorOptions().world, "lab");
  EXPECT_EQ(MonitorOptions().domain, 7u);
  const WorldOptions named{.world = "default", .simulator = "sim", .domain = 0};
  EXPECT_EQ(named.world, "default");
  EXPECT_EQ(named.domain, 0u);
}

TEST_F(EnvironmentTest, WithoutItTheWorldIsDefaultOnDomain0) {
  Set("", "");
  EXPECT_EQ(DefaultWorld(), "default");
  EXPECT_EQ(DefaultDomain(), 0u);
  unsetenv("COLLISION_WORLD");
  unsetenv("COLLISION_DOMAIN");
  EXPECT_EQ(DefaultWorld(), "default");
  EXPECT_EQ(DefaultDomain(), 0u);
}

TEST_F(EnvironmentTest, WhatIsNoDomainIsRefusedWithItsRange) {
  for (const char* domain : {"231", "999999999999", "-1", "7x", "x"}) {
    Set("lab", domain);
    try {
      DefaultDomain();
      ADD_FAILURE() << domain;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()),
                "COLLISION_DOMAIN: " + std::string(domain) + ", allowed: 0 to 230");
    }
  }
}

}  // namespace
}  // namespace collision::client
