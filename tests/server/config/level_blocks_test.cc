#include "server/config/level_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "server/config/config.h"
#include "server/config/config_digest.h"

namespace collision::server {
namespace {

std::vector<std::string> ErrorsOf(const std::string& text) { return ParseConfig(text, "F").errors; }

constexpr const char* kClasses =
    "classes { name: \"a\" meets: \"b\" } classes { name: \"b\" } classes { name: \"c\" }\n";

// Goal:   an error names block, field, value and what is allowed, at the line of the field.
TEST(LevelBlocks, ErrorsNameBlockFieldValueAndRange) {
  const std::string names =
      " is not allowed; allowed: 1 to 32 of A-Z a-z 0-9 _ -, each once; not contact, which names "
      "contact itself";
  const std::string pairs =
      " is not allowed; allowed: CLASS/CLASS, two of classes that meet each other";
  const std::pair<std::string, std::string> cases[] = {
      {"levels { margin_m: 1 }", "F:1: levels[0].name: \"\"" + names},
      {"levels {\n name: \"contact\" margin_m: 1 }", "F:2: levels[0].name: \"contact\"" + names},
      {"levels { name: \"x\" margin_m: 1 }\nlevels { name: \"x\" margin_m: 2 }",
       "F:2: levels[1].name: \"x\"" + names},
      {"levels { name: \"x\" }",
       "F:1: levels[0].margin_m: 0 is not allowed; allowed: 2e-06 to 1000000000000 [m]"},
      {"levels { name: \"x\"\n margin_m: nan }",
       "F:2: levels[0].margin_m: nan is not allowed; allowed: 2e-06 to 1000000000000 [m]"},
      {"levels { name: \"x\" margin_m: 1\n hysteresis_m: -1 }",
       "F:2: levels[0].hysteresis_m: -1 is not allowed; allowed: 0 to 1000000000000 [m]"},
      {"temporal_resolution_s: 0.5 levels { name: \"x\" margin_m: 1\n look_ahead_s: 0.1 }",
       "F:2: levels[0].look_ahead_s: 0.1 is not allowed; allowed: temporal_resolution_s (0.5) to "
       "86400 [s]"},
      {"levels { name: \"x\" margin_m: 1 basis: LIKELY }",
       "F:1: levels[0].basis: Unknown enumeration value of \"LIKELY\" for field \"basis\"; "
       "allowed: "
       "POSSIBLE, EXPECTED"},
      {"levels { name: \"x\" margin: 1 }",
       "F:1: levels[0].margin: Message type \"collision.v1.Level\" has no field named \"margin\"; "
       "allowed: name, margin_m, look_ahead_s, basis, hysteresis_m, between"},
      {std::string(kClasses) + "levels { name: \"x\" margin_m: 1\n between: \"a/d\" }",
       "F:3: levels[0].between: \"a/d\"" + pairs},
      {std::string(kClasses) + "levels { name: \"x\" margin_m: 1\n between: \"a\" }",
       "F:3: levels[0].between: \"a\"" + pairs},
      {std::string(kClasses) + "levels { name: \"x\" margin_m: 1\n between: \"a/c\" }",
       "F:3: levels[0].between: \"a/c\"" + pairs}};
  for (const auto& [text, error] : cases) {
    const std::vector<std::string> errors = ErrorsOf(text);
    EXPECT_EQ(std::ranges::count(errors, error), 1) << error << "\n"
                                                    << testing::PrintToString(errors);
  }
}

// Goal:   valid blocks are accepted, what is printed loads again, and services that differ in them
//         do not count as configured alike.
TEST(LevelBlocks, ValidBlocksArePrintedReadAgainAndCountForTheDigest) {
  const std::string text =
      std::string(kClasses) +
      "levels { name: \"near\" margin_m: 0.5 look_ahead_s: 5 basis: EXPECTED hysteresis_m: 0.1 "
      "between: \"a/b\" between: \"b/a\" } levels { name: \"far\" margin_m: 2e-6 }";
  const ConfigResult result = ParseConfig(text, "F");
  ASSERT_TRUE(result.ok()) << result.errors[0];
  const ConfigResult again = ParseConfig(PrintConfig(result.config), "F");
  EXPECT_EQ(again.config.SerializeAsString(), result.config.SerializeAsString());
  v1::Config other = result.config;
  other.mutable_levels(0)->set_hysteresis_m(0.2);
  EXPECT_NE(ConfigurationDigest(result.config), ConfigurationDigest(other));
}

TEST(LevelBlocks, ThereAreAtMostEight) {
  std::string many;
  for (int i = 0; i < 8; ++i) many += "levels { margin_m: 1 name: \"" + std::to_string(i) + "\" }";
  EXPECT_TRUE(ErrorsOf(many).empty());
  EXPECT_EQ(
      ErrorsOf(many + "\nlevels { name: \"8\" margin_m: 1 }"),
      std::vector<std::string>{"F:2: levels[8]: 9 blocks are not allowed; allowed: at most 8"});
}

}  // namespace
}  // namespace collision::server
