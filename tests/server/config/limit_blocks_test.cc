#include "server/config/limit_blocks.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/config/config.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

std::vector<std::string> ErrorsOf(const std::string& text) { return ParseConfig(text, "F").errors; }

// Goal:   a block of limits allows no more than the world; the error names block, field, value and
//         what is allowed, at the line of the field.
TEST(LimitBlocks, ErrorsNameBlockFieldValueAndRange) {
  const std::pair<const char*, const char*> cases[] = {
      {"limits { agents_max: 1 }",
       "F:1: limits[0].name: \"\" is not allowed; allowed: 1 to 64 of A-Z a-z 0-9 _ - *"},
      {"limits {\n name: \"a.b\" }",
       "F:2: limits[0].name: \"a.b\" is not allowed; allowed: 1 to 64 of A-Z a-z 0-9 _ - *"},
      {"agents_max: 10 limits { name: \"a\" }\nlimits {\n name: \"b\"\n agents_max: 11 }",
       "F:4: limits[1].agents_max: 11 is not allowed; allowed: 1 to 10, which the world has"},
      {"limits { name: \"a\" shapes_max: 0 }",
       "F:1: limits[0].shapes_max: 0 is not allowed; allowed: 1 to 1024, which the world has"},
      {"limits { name: \"a\" guaranteed: 1.5 }",
       "F:1: limits[0].guaranteed: 1.5 is not allowed; allowed: 0 to 1"},
      {"limits { name: \"a\" guaranteed: nan }",
       "F:1: limits[0].guaranteed: nan is not allowed; allowed: 0 to 1"},
      {"limits { name: \"a\" guaranteed: 0.6 }\nlimits { name: \"b\" guaranteed: 0.5 }",
       "F:2: limits[1].guaranteed: 0.5 is not allowed; allowed: 0 to 0.4, which the blocks before "
       "have left of 1"},
      {"simulators_max: 1 limits { name: \"a\" }\nlimits { name: \"b\" }",
       "F:2: limits[1].name: \"b\" is not allowed; allowed: as many names without * as "
       "simulators_max, 1"},
      {"limits { name: \"a\" }\nlimits { name: \"b\"\n agents_max: -1 }",
       "F:3: limits[1].agents_max: Expected integer, got: -; allowed: 1 to agents_max of the "
       "world"},
      {"limits { name: \"a\" agents: 1 }",
       "F:1: limits[0].agents: Message type \"collision.v1.SimulatorLimits\" has no field named "
       "\"agents\"; allowed: name, guaranteed, agents_max, pairs_max, shapes_max, "
       "shape_bytes_max, tree_bytes_max, rejections_per_second_max"}};
  for (const auto& [text, error] : cases) {
    EXPECT_EQ(ErrorsOf(text), std::vector<std::string>{error}) << text;
  }
}

// Goal:   no error hides another one, neither of its block nor of another one.
TEST(LimitBlocks, AllErrorsAreTold) {
  const std::vector<std::string> errors = ErrorsOf(
      "limits {\n name: \"a.b\"\n guaranteed: 2\n agents_max: 0\n pairs_max: x\n bogus: 1\n}\n"
      "limits {\n name: \"c\"\n tree_bytes_max: 0\n}");
  const char* expected[] = {"F:2: limits[0].name: ",       "F:3: limits[0].guaranteed: ",
                            "F:4: limits[0].agents_max: ", "F:5: limits[0].pairs_max: ",
                            "F:6: limits[0].bogus: ",      "F:10: limits[1].tree_bytes_max: "};
  ASSERT_EQ(errors.size(), std::size(expected));
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_TRUE(errors[i].starts_with(expected[i])) << errors[i];
  }
}

// Goal:   blocks that the world allows are accepted, and what is printed loads again.
TEST(LimitBlocks, ValidBlocksArePrintedAndReadAgain) {
  for (const char* text :
       {"limits { name: \"drone-*\" agents_max: 100 guaranteed: 0.5 }",
        "limits { name: \"a\" } limits { name: \"*\" pairs_max: 1 }",
        "limits { name: \"a\" guaranteed: 0.5 } limits { name: \"b\" guaranteed: 0.5 }",
        "limits { name: \"drone-1*\" } limits { name: \"drone-*\" } limits { name: \"dr*e-1\" }"}) {
    const ConfigResult result = ParseConfig(text, "F");
    EXPECT_TRUE(result.ok()) << text << result.errors[0];
    const ConfigResult again = ParseConfig(PrintConfig(result.config), "F");
    EXPECT_EQ(again.config.SerializeAsString(), result.config.SerializeAsString());
  }
}

// Goal:   a block that never counts, because an earlier one fits all its names, is refused; one
//         that is the first for a single name is not.
TEST(LimitBlocks, ABlockThatNeverCountsIsRefused) {
  const auto second = [](const std::string& first, const std::string& name) {
    const std::vector<std::string> errors =
        ErrorsOf("limits { name: \"" + first + "\" }\nlimits { name: \"" + name + "\" }");
    return errors.empty() ? "" : errors[0];
  };
  EXPECT_EQ(second("drone-*", "drone-1"),
            "F:2: limits[1].name: \"drone-1\" is not allowed; allowed: a name that limits[0] "
            "(\"drone-*\") does not fit: the first block that fits counts");
  for (const char* hidden : {"drone-*", "drone-", "drone-*-a", "drone-1*", "drone-**"}) {
    EXPECT_NE(second("drone-*", hidden), "") << hidden;
    EXPECT_NE(second("*", hidden), "") << hidden;
  }
  EXPECT_NE(second("a", "a"), "") << "the same name twice";
  for (const char* counts : {"drone*", "*", "drone", "*drone-*", "d*"}) {
    EXPECT_EQ(second("drone-*", counts), "") << counts;
  }
}

TEST(LimitBlocks, ThereAreAtMostSixtyFour) {
  std::string many;
  for (int i = 0; i < kLimitBlocksMax; ++i) {
    many += "limits { name: \"a" + std::to_string(i) + "-*\" }";
  }
  EXPECT_TRUE(ErrorsOf(many).empty());
  EXPECT_EQ(
      ErrorsOf(many + "\nlimits { name: \"b\" }"),
      std::vector<std::string>{"F:2: limits[64]: 65 blocks are not allowed; allowed: at most 64"});
}

TEST(LimitBlocks, PatternsFitWholeNames) {
  EXPECT_TRUE(FitsPattern("drone-1", "drone-1"));
  EXPECT_FALSE(FitsPattern("drone-1", "drone-"));
  EXPECT_FALSE(FitsPattern("drone-", "drone-1"));
  EXPECT_TRUE(FitsPattern("drone-12", "drone-*"));
  EXPECT_TRUE(FitsPattern("drone-", "drone-*"));
  EXPECT_TRUE(FitsPattern("a-drone-b", "*dr*ne*"));
  EXPECT_FALSE(FitsPattern("a-dron-b", "*dr*ne*"));
  EXPECT_TRUE(FitsPattern("anything", "*"));
  EXPECT_TRUE(FitsPattern("abab", "*ab"));
}

// Goal:   one pattern fits another exactly if each name that fits the latter fits the former.
// Method: random patterns, on all names of up to six of three characters.
TEST(LimitBlocks, APatternFitsAnotherIfItFitsAllOfItsNames) {
  std::vector<std::string> names = {""};
  for (std::size_t i = 0; names[i].size() < 6; ++i) {
    for (const char c : {'a', 'b', 'c'}) names.push_back(names[i] + c);
  }
  Random random(1);
  const auto pattern = [&] {
    std::string text;
    for (std::uint64_t left = 1 + random.Below(3); left > 0; --left) text += "ab*"[random.Below(3)];
    return text;
  };
  int fitting = 0;
  for (int i = 0; i < 300; ++i) {
    const std::string narrow = pattern(), wide = pattern();
    bool all = true;
    for (const std::string& name : names) {
      all = all && (!FitsPattern(name, narrow) || FitsPattern(name, wide));
    }
    EXPECT_EQ(FitsPattern(narrow, wide), all) << narrow << " in " << wide;
    fitting += all;
  }
  EXPECT_GT(fitting, 50);
  EXPECT_LT(fitting, 250);
}

}  // namespace
}  // namespace collision::server
