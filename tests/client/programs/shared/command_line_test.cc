// Goal:   an option that is refused says "OPTION: VALUE, allowed: RANGE", whatever its kind.
// Method: one option at a time, parsed as programs do.
#include "client/programs/shared/command_line.h"

#include <gtest/gtest.h>

#include <limits>

namespace collision::client {
namespace {

enum class Kind { kFirst, kSecond };

/// What is said when the program is called with these arguments; empty: nothing.
std::string Refusal(CLI::App* app, const std::string& arguments) {
  try {
    app->parse(arguments);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "";
}

std::string Refused(const CLI::Validator& check, const std::string& value) {
  CLI::App app;
  std::string text;
  app.add_option("--x", text)->check(check);
  return Refusal(&app, "--x=" + value);
}

TEST(CommandLine, RefusalsHaveOneStyle) {
  EXPECT_EQ(Refused(Finite(5, false), "0"), "--x: 0, allowed: 0 < x <= 5");
  EXPECT_EQ(Refused(Finite(5, false), "1e-300"), "");
  EXPECT_EQ(Refused(Finite(5, true), "0"), "");
  EXPECT_EQ(Refused(Finite(5, true), "nan"), "--x: nan, allowed: 0 <= x <= 5");
  EXPECT_EQ(Refused(Between(0.02, 3600), "0.01"), "--x: 0.01, allowed: 0.02 to 3600");
  EXPECT_EQ(Refused(Between(-1, 1), "nan"), "--x: nan, allowed: -1 to 1");
  EXPECT_EQ(Refused(Between(-1, 1), "-1"), "");
  EXPECT_EQ(Refused(WholeBetween(1, 10), "11"), "--x: 11, allowed: 1 to 10");
  EXPECT_EQ(Refused(WholeBetween(1, 10), "2.5"), "--x: 2.5, allowed: 1 to 10");
  EXPECT_EQ(Refused(WholeBetween(1, 10), "10"), "");
  EXPECT_EQ(Refused(OneOf({"text", "json"}), "xml"), "--x: xml, allowed: text, json");
  EXPECT_EQ(Refused(OneOf({"text", "json"}), "json"), "");
  EXPECT_EQ(Refused(DomainRange(), "231"), "--x: 231, allowed: 0 to 230");
}

TEST(CommandLine, AWordStandsForItsValue) {
  const std::map<std::string, Kind> kinds = {{"first", Kind::kFirst}, {"second", Kind::kSecond}};
  Kind kind = Kind::kFirst;
  CLI::App app;
  app.add_option("--kind", kind)->transform(ValueOf(kinds));
  EXPECT_EQ(Refusal(&app, "--kind second"), "");
  EXPECT_EQ(kind, Kind::kSecond);
  EXPECT_EQ(Refusal(&app, "--kind third"), "--kind: third, allowed: first, second");
}

// Goal:   a name that no world can have is refused with the options, not when the network is asked.
TEST(CommandLine, NamesOfWorldsAndSimulatorsAreChecked) {
  const auto refusal = [](const std::string& arguments) {
    CLI::App app;
    SimulatorOptions options;
    AddSimulatorOptions(&app, &options);
    return Refusal(&app, arguments);
  };
  const std::string allowed = ", allowed: 1 to 64 of A-Z a-z 0-9 _ -";
  EXPECT_EQ(refusal("--simulator s --world a-B_9"), "");
  EXPECT_EQ(refusal("--simulator s --world a/b"), "--world: \"a/b\"" + allowed);
  EXPECT_EQ(refusal("--simulator s.t"), "--simulator: \"s.t\"" + allowed);
  EXPECT_EQ(refusal("--simulator " + std::string(65, 'a')),
            "--simulator: \"" + std::string(65, 'a') + "\"" + allowed);
  EXPECT_EQ(
      refusal("--simulator s --start-ns=-1"),
      "--start-ns: -1, allowed: 0 to " + std::to_string(std::numeric_limits<std::int64_t>::max()));
}

}  // namespace
}  // namespace collision::client
