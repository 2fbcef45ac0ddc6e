#include "server/config/partner_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "server/config/config.h"
#include "server/config/config_digest.h"

namespace collision::server {
namespace {

std::vector<std::string> ErrorsOf(const std::string& text) { return ParseConfig(text, "F").errors; }

// Goal:   an error names block, field, value and what is allowed, at the line of the field.
TEST(PartnerBlocks, ErrorsNameBlockFieldValueAndRange) {
  const std::pair<const char*, const char*> cases[] = {
      {"classes { }",
       "F:1: classes[0].name: \"\" is not allowed; allowed: 1 to 32 of A-Z a-z 0-9 _ -, each once"},
      {"classes { name: \"a\" }\nclasses {\n name: \"a\" }",
       "F:3: classes[1].name: \"a\" is not allowed; allowed: 1 to 32 of A-Z a-z 0-9 _ -, each "
       "once"},
      {"classes { name: \"a\"\n meets: \"a\"\n meets: \"b\" } classes { name: \"c\" }",
       "F:2: classes[0].meets: \"b\" is not allowed; allowed: the names of classes: a, c"},
      {"classes { name: \"a\" kind: 1 }",
       "F:1: classes[0].kind: Message type \"collision.v1.AgentClass\" has no field named "
       "\"kind\"; "
       "allowed: name, meets"},
      {"excluded {\n first: \"x\"\n second: \"y/1\" }",
       "F:2: excluded[0].first: \"x\" is not allowed; allowed: simulator/agent, two different "
       "ones"},
      {"excluded { first: \"x/1\"\n second: \"x/1\" }",
       "F:2: excluded[0].second: \"x/1\" is not allowed; allowed: simulator/agent, two different "
       "ones"},
      {"excluded { first: 7 second: \"x/1\" }",
       "F:1: excluded[0].first: Expected string, got: 7; allowed: simulator/agent, two different "
       "ones"}};
  for (const auto& [text, error] : cases) {
    const std::vector<std::string> errors = ErrorsOf(text);
    EXPECT_EQ(std::ranges::count(errors, error), 1) << testing::PrintToString(errors);
  }
}

// Goal:   blocks that are valid are accepted, what is printed loads again, and services that differ
//         in them do not count as configured alike.
TEST(PartnerBlocks, ValidBlocksArePrintedReadAgainAndCountForTheDigest) {
  const v1::Config none = CompleteConfig({});
  for (const char* text : {"classes { name: \"robot\" meets: \"robot\" meets: \"person\" } classes "
                           "{ name: \"person\" }",
                           "excluded { first: \"cell/table\" second: \"arm/base/2\" }"}) {
    const ConfigResult result = ParseConfig(text, "F");
    ASSERT_TRUE(result.ok()) << text << result.errors[0];
    const ConfigResult again = ParseConfig(PrintConfig(result.config), "F");
    EXPECT_EQ(again.config.SerializeAsString(), result.config.SerializeAsString());
    EXPECT_NE(ConfigurationDigest(result.config), ConfigurationDigest(none));
  }
}

TEST(PartnerBlocks, ThereAreAtMostThirtyOneClasses) {
  std::string many;
  for (int i = 0; i < 31; ++i) many += "classes { name: \"c" + std::to_string(i) + "\" }";
  EXPECT_TRUE(ErrorsOf(many).empty());
  EXPECT_EQ(
      ErrorsOf(many + "\nclasses { name: \"d\" }"),
      std::vector<std::string>{"F:2: classes[31]: 32 blocks are not allowed; allowed: at most 31"});
}

}  // namespace
}  // namespace collision::server
