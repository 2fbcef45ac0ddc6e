// Goal:   the help of a command has its own examples, that of the program all of them.
#include "client/programs/tools/collisionctl/examples.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

TEST(Examples, OfACommandAreItsOwn) {
  EXPECT_EQ(ExamplesOf("why"),
            "\nExamples:\n"
            "  collisionctl why ada bob              when the two can meet, why then, what would "
            "narrow it\n");
  EXPECT_NE(ExamplesOf("events").find("--follow"), std::string::npos);
  EXPECT_EQ(ExamplesOf("events").find("why"), std::string::npos);
  EXPECT_EQ(ExamplesOf("nothing"), "");
  for (const char* command : {"status", "agents", "top", "why", "evict", "sphere-tree"}) {
    EXPECT_NE(AllExamples().find("  collisionctl " + std::string(command)), std::string::npos);
  }
  EXPECT_NE(AllExamples().find("Exit codes:"), std::string::npos);
}

}  // namespace
}  // namespace collision::client
