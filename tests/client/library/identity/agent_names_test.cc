// Goal:   names stay known after their agents have left, and an unknown agent has a substitute.
#include "client/library/identity/agent_names.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

TEST(AgentNames, AreRememberedOrReplaced) {
  AgentNames names;
  const AgentId id{.simulator = 1, .run = 2, .slot = 3, .generation = 4};
  EXPECT_EQ(names.Of(id), "0000000000000001:3");
  names.Hear(id, "bob");
  names.Hear(id, "");
  EXPECT_EQ(names.Of(id), "bob");
  for (std::uint32_t slot = 10; slot < 10 + 3 * AgentNames::kNamesMax; ++slot) {
    names.Hear({.simulator = 1, .run = 2, .slot = slot, .generation = 1}, "x");
  }
  EXPECT_EQ(names.Of(id), "0000000000000001:3") << "the bound";
}

}  // namespace
}  // namespace collision::client
