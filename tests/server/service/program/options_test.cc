#include "server/service/program/options.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <initializer_list>
#include <vector>

namespace collision::server {
namespace {

OptionsResult Parse(std::initializer_list<const char*> arguments) {
  std::vector<const char*> argv = {"collisiond"};
  argv.insert(argv.end(), arguments);
  return ParseOptions(static_cast<int>(argv.size()), argv.data());
}

// Goal:   every option arrives where the program looks for it.
TEST(Options, AreTaken) {
  const OptionsResult nothing = Parse({});
  ASSERT_TRUE(nothing.options);
  EXPECT_TRUE(nothing.options->config_file.empty());
  EXPECT_FALSE(nothing.options->domain);
  EXPECT_FALSE(nothing.options->log_level);

  const OptionsResult serve =
      Parse({"--config", "F", "--domain", "230", "--log-level", "warn", "--record", "R"});
  ASSERT_TRUE(serve.options);
  EXPECT_EQ(serve.options->config_file, "F");
  EXPECT_EQ(serve.options->domain, 230u);
  EXPECT_EQ(serve.options->log_level, "warn");
  EXPECT_EQ(serve.options->record_file, "R");

  EXPECT_TRUE(Parse({"--config", "F", "--check-config"}).options->check_config);
  EXPECT_TRUE(Parse({"--print-config"}).options->print_config);
  EXPECT_TRUE(Parse({"--calibrate"}).options->calibrate);
  EXPECT_EQ(Parse({"--replay", "R", "--log-level", "off"}).options->replay_file, "R");
}

// Goal:   world and domain of the environment count where the command line has none, and a bad one
//         is refused like a bad option.
TEST(Options, TheEnvironmentTellsWorldAndDomain) {
  setenv("COLLISION_WORLD", "lab", 1);
  setenv("COLLISION_DOMAIN", "7", 1);
  const OptionsResult said = Parse({});
  const OptionsResult over = Parse({"--world", "hall", "--domain", "8"});
  const OptionsResult replay = Parse({"--replay", "R"});
  setenv("COLLISION_WORLD", "", 1);
  setenv("COLLISION_DOMAIN", "231", 1);
  const OptionsResult bad = Parse({});
  unsetenv("COLLISION_WORLD");
  unsetenv("COLLISION_DOMAIN");
  ASSERT_TRUE(said.options && over.options && replay.options);
  EXPECT_EQ(said.options->world, "lab");
  EXPECT_EQ(said.options->domain, 7u);
  EXPECT_EQ(over.options->world, "hall");
  EXPECT_EQ(over.options->domain, 8u);
  EXPECT_FALSE(replay.options->world) << "a recording has its own";
  EXPECT_FALSE(bad.options);
  EXPECT_EQ(bad.exit_code, kExitUsage);
  EXPECT_NE(bad.error.find("COLLISION_DOMAIN"), std::string::npos) << bad.error;
}

// Goal:   whatever is wrong on the command line ends with code 2 and a line that says what.
TEST(Options, WrongOnesAreUsageErrors) {
  const std::initializer_list<const char*> cases[] = {
      {"--frobnicate"},
      {"stray"},
      {"--config"},
      {"--config", ""},
      {"--record", ""},
      {"--domain", "231"},
      {"--domain", "-1"},
      {"--domain", "x"},
      {"--world", "two words"},
      {"--log-level", "loud"},
      {"--log-level", "info\""},
      {"--check-config"},
      {"--check-config", "--config", "F", "--record", "R"},
      {"--replay", "R", "--config", "F"},
      {"--replay", "R", "--record", "S"},
      {"--replay", "R", "--domain", "1"},
      {"--calibrate", "--config", "F"},
      {"--calibrate", "--replay", "R"},
      {"--config", "F", "--config", "G"}};
  for (const auto& arguments : cases) {
    const OptionsResult result = Parse(arguments);
    EXPECT_FALSE(result.options) << *arguments.begin();
    EXPECT_EQ(result.exit_code, kExitUsage);
    EXPECT_FALSE(result.error.empty());
    EXPECT_TRUE(result.output.empty());
  }
}

// Goal:   help explains every option, gives examples and the exit codes; both it and the version
// end with 0.
TEST(Options, HelpExplainsOptionsAndExitCodes) {
  const OptionsResult help = Parse({"--help"});
  EXPECT_FALSE(help.options);
  EXPECT_EQ(help.exit_code, kExitOk);
  for (const char* part :
       {"--config FILE", "--check-config", "--print-config", "--calibrate", "--version", "--domain",
        "--log-level", "--record FILE", "--replay FILE", "Examples:", "\n   0  ", "\n   2  ",
        "\n  69  ", "\n  70  ", "\n  71  ", "\n  74  ", "\n  75  ", "\n  78  "}) {
    EXPECT_NE(help.output.find(part), std::string::npos) << part;
  }
  const OptionsResult version = Parse({"--version"});
  EXPECT_EQ(version.exit_code, kExitOk);
  EXPECT_TRUE(version.output.starts_with("collisiond "));
  EXPECT_FALSE(version.options);
}

}  // namespace
}  // namespace collision::server
