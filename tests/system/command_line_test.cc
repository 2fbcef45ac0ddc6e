// Goal:   collisiond's command line and configuration do what they say, with the exit codes they
// say. Method: run the program; the bad configurations each hold one planted mistake whose line is
// known.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

Outcome Collisiond(std::vector<std::string> options) {
  options.insert(options.begin(), Program("collisiond"));
  return RunToEnd(options);
}

bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CommandLine, TellsItsVersion) {
  const Outcome outcome = Collisiond({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out.rfind("collisiond ", 0), 0u) << outcome.out;
}

TEST(CommandLine, UnknownOptionIsAUsageError) {
  for (const char* option : {"--no-such-option", "stray"}) {
    const Outcome outcome = Collisiond({option});
    EXPECT_EQ(outcome.status, 2) << option;
    EXPECT_TRUE(Contains(outcome.err, option)) << outcome.err;
  }
}

TEST(CommandLine, GoodConfigurationIsFine) {
  const Outcome shipped =
      Collisiond({"--config", ConfigFile("collisiond.textproto"), "--check-config"});
  EXPECT_EQ(shipped.status, 0) << shipped.err;
}

TEST(CommandLine, PrintedConfigurationCanBeReadAgain) {
  const Folder folder;
  const Outcome printed = Collisiond({"--print-config"});
  ASSERT_EQ(printed.status, 0) << printed.err;
  const std::string file = folder.Write("printed.textproto", printed.out);
  EXPECT_EQ(Collisiond({"--config", file, "--check-config"}).status, 0);
  EXPECT_EQ(Collisiond({"--config", file, "--print-config"}).out, printed.out);
}

TEST(CommandLine, BadConfigurationNamesFileLineFieldAndRange) {
  struct Mistake {
    std::string text;
    std::vector<std::string> told;
  };
  const Mistake mistakes[] = {
      {"world: \"a\"\n\nagents_max: 0\n", {":3: agents_max:", "1 to "}},
      {"clock {\n  kind: WALL\n  skew_max_s: -1\n}\n", {":3: clock.skew_max_s:", "0 to 60"}},
      {"temporal_resolution_s: nan\n", {":1: temporal_resolution_s:", " to "}},
      {"# nothing\nno_such_field: 1\n", {":2:", "no_such_field"}},
      {"world: 7\n", {":1:"}},
  };
  for (const Mistake& mistake : mistakes) {
    const Folder folder;
    const std::string file = folder.Write("bad.textproto", mistake.text);
    const Outcome outcome = Collisiond({"--config", file, "--check-config"});
    EXPECT_EQ(outcome.status, 78) << mistake.text;
    for (const std::string& told : mistake.told)
      EXPECT_TRUE(Contains(outcome.err, told)) << outcome.err;
    EXPECT_TRUE(Contains(outcome.err, file)) << outcome.err;
    EXPECT_EQ(Collisiond({"--config", file}).status, 78) << "served with " << mistake.text;
  }
}

TEST(CommandLine, MissingConfigurationIsOneClearLine) {
  const Folder folder;
  const Outcome outcome = Collisiond({"--config", folder.Path("none.textproto")});
  EXPECT_EQ(outcome.status, 78);
  EXPECT_TRUE(Contains(outcome.err, "none.textproto")) << outcome.err;
}

TEST(CommandLine, WithoutDdsItSaysSo) {
  const Outcome outcome = RunToEnd(
      {Program("collisiond")},
      {"CYCLONEDDS_URI=<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface "
       "name=\"no-such-one\"/></Interfaces></General></Domain></CycloneDDS>"});
  EXPECT_EQ(outcome.status, 69);
  EXPECT_TRUE(Contains(outcome.err, "collisiond: ")) << outcome.err;
}

TEST(CommandLine, AskedToStopItEndsCleanly) {
  const TestWorld world(60);
  for (const int signal : {SIGTERM, SIGINT}) {
    const auto daemon = world.StartDaemon();
    daemon->Signal(signal);
    EXPECT_EQ(daemon->WaitForExit(), 0) << daemon->err();
    EXPECT_TRUE(Contains(daemon->err(), "event log: 0 events, hash ")) << daemon->err();
  }
}

}  // namespace
}  // namespace collision::system_test
