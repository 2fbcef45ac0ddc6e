// Goal:   names become numbers that are equal exactly where simulator and name are, stay while a
//         description needs them and for a while after, and are never given twice.
// Method: filters of descriptions, asked whether they can meet.
#include "server/intake/partner_names.h"

#include <gtest/gtest.h>

#include "tests/server/messages.h"

namespace collision::server {
namespace {

class PartnerNamesTest : public testing::Test {
 protected:
  struct Named {
    broad_phase::CollisionFilter filter;
    std::shared_ptr<const void> names;
  };

  static v1::AgentDescription Part(const std::string& simulator, const std::string& name,
                                   const std::string& assembly = "") {
    v1::AgentDescription wire = Description(simulator, 0);
    wire.set_agent_name(name);
    wire.set_assembly(assembly);
    return wire;
  }
  Named Complete(const v1::AgentDescription& wire) {
    Named named;
    named.names = names.Complete(wire, &named.filter);
    return named;
  }

  PartnerNames names{v1::Config()};
};

TEST_F(PartnerNamesTest, AnAssemblyBelongsToItsSimulator) {
  const Named a = Complete(Part("x", "1", "arm")), b = Complete(Part("x", "2", "arm"));
  const Named other = Complete(Part("y", "2", "arm")), none = Complete(Part("x", "3"));
  EXPECT_FALSE(CanMeet(a.filter, b.filter));
  EXPECT_TRUE(CanMeet(a.filter, other.filter));
  EXPECT_TRUE(CanMeet(a.filter, none.filter));
  EXPECT_TRUE(CanMeet(none.filter, Complete(Part("x", "4")).filter));
}

TEST_F(PartnerNamesTest, ListsNameAgentsOfTheSameSimulatorThatNeedNotBeThere) {
  v1::AgentDescription wire = Part("x", "1", "arm");
  wire.add_meets_in_assembly("2");
  wire.add_never_meets("table");
  const Named a = Complete(wire);
  EXPECT_TRUE(CanMeet(a.filter, Complete(Part("x", "2", "arm")).filter));
  EXPECT_FALSE(CanMeet(a.filter, Complete(Part("x", "3", "arm")).filter));
  EXPECT_FALSE(CanMeet(a.filter, Complete(Part("x", "table")).filter));
  EXPECT_TRUE(CanMeet(a.filter, Complete(Part("y", "table")).filter));
}

TEST_F(PartnerNamesTest, TheConfigurationExcludesPairsOfTwoSimulators) {
  v1::Config config;
  v1::ExcludedPair* pair = config.add_excluded();
  pair->set_first("x/gripper");
  pair->set_second("y/part/7");  // only the first slash separates
  names = PartnerNames(config);
  const Named gripper = Complete(Part("x", "gripper"));
  EXPECT_FALSE(CanMeet(Complete(Part("y", "part/7")).filter, gripper.filter));
  EXPECT_TRUE(CanMeet(Complete(Part("x", "part/7")).filter, gripper.filter));
  EXPECT_TRUE(CanMeet(Complete(Part("y", "gripper")).filter, gripper.filter));
}

TEST_F(PartnerNamesTest, ADescriptionWithoutListsHasNone) {
  EXPECT_EQ(Complete(Part("x", "1", "arm")).filter.partners, nullptr);
}

TEST_F(PartnerNamesTest, ANameThatIsGivenUpKeepsItsNumberForAWhileAndItIsNeverGivenAgain) {
  Named arm = Complete(Part("x", "1", "arm"));
  const broad_phase::CollisionFilter before = arm.filter;
  arm = {};
  EXPECT_EQ(Complete(Part("x", "1", "arm")).filter, before) << "it came back at once";
  for (std::size_t i = 0; i < 2 * PartnerNames::kUnusedMax; ++i) {
    Complete(Part("x", "other" + std::to_string(i)));
    ASSERT_LE(names.size(), PartnerNames::kUnusedMax + 2);
  }
  const Named later = Complete(Part("x", "1", "arm"));
  EXPECT_GT(later.filter.assembly, before.assembly);
  EXPECT_GT(later.filter.name, before.name);
  const Named kept = Complete(Part("x", "2", "arm"));
  for (std::size_t i = 0; i < 2 * PartnerNames::kUnusedMax; ++i) {
    Complete(Part("x", "more" + std::to_string(i)));
  }
  EXPECT_EQ(Complete(Part("x", "3", "arm")).filter.assembly, kept.filter.assembly)
      << "a description needs it";
}

TEST_F(PartnerNamesTest, WhatItReturnsMayOutliveIt) {
  Named named;
  {
    PartnerNames others{v1::Config()};
    named.names = others.Complete(Part("x", "1", "arm"), &named.filter);
  }
  named = {};
}

}  // namespace
}  // namespace collision::server
