// Goal:   a service that runs takes what can change of a new configuration, names the rest, and
//         keeps the old one where the new one is wrong.
#include "server/service/requests/reload.h"

#include <gtest/gtest.h>

#include "server/config/config_options.h"

namespace collision::server {
namespace {

TEST(Reload, TakesWhatCanChangeAndNamesTheRest) {
  std::string text = "log_level: \"info\" agents_max: 10";
  Reloader reloader(ParseConfig(text, "f").config, [&text] { return ParseConfig(text, "f"); });
  Reloaded reloaded = reloader.Read();
  EXPECT_TRUE(reloaded.accepted);
  EXPECT_TRUE(reloaded.changed.empty() && reloaded.unchanged.empty());

  text = "log_level: \"debug\" agents_max: 20 pairs_max: 70";
  reloaded = reloader.Read();
  EXPECT_TRUE(reloaded.accepted);
  EXPECT_EQ(reloaded.changed, std::vector<std::string>{"log_level: \"info\" -> \"debug\""});
  EXPECT_EQ(reloaded.unchanged, (std::vector<std::string>{"agents_max", "pairs_max"}));
  EXPECT_EQ(reloader.in_force().log_level(), "info") << "not before it has been done";
  reloader.Commit(reloaded.config);
  EXPECT_EQ(reloader.in_force().log_level(), "debug");
  EXPECT_EQ(reloader.in_force().agents_max(), 10u);
  EXPECT_TRUE(reloader.Read().changed.empty()) << "nothing is told twice";

  text = "log_level: \"loud\"";
  reloaded = reloader.Read();
  EXPECT_FALSE(reloaded.accepted);
  ASSERT_EQ(reloaded.errors.size(), 1u);
  EXPECT_NE(reloaded.errors[0].find("f:1: log_level"), std::string::npos) << reloaded.errors[0];
  EXPECT_EQ(reloader.in_force().log_level(), "debug");
}

TEST(Reload, WithoutAFileNothingChanges) {
  Reloader reloader(ParseConfig("", "").config, nullptr);
  const Reloaded reloaded = reloader.Read();
  EXPECT_TRUE(reloaded.accepted);
  EXPECT_TRUE(reloaded.changed.empty() && reloaded.unchanged.empty());
}

TEST(Reload, HowMuchIsKeptCanChangeAndWhetherAnyIsTakesANewStart) {
  std::string text;
  const Reloader reloader(ParseConfig("contacts_mb_max: 0", "f").config,
                          [&text] { return ParseConfig(text, "f"); });
  text = "contacts_mb_max: 7 recorder_mb_max: 0";
  EXPECT_TRUE(reloader.Read().changed.empty());
  EXPECT_EQ(reloader.Read().unchanged,
            (std::vector<std::string>{"recorder_mb_max", "contacts_mb_max"}));
  text = "contacts_mb_max: 0 recorder_mb_max: 100 recorder_keep_s: 60";
  EXPECT_EQ(reloader.Read().config.recorder_mb_max(), 100u);
  EXPECT_EQ(reloader.Read().config.recorder_keep_s(), 60);
  EXPECT_TRUE(reloader.Read().unchanged.empty());
}

TEST(Reload, BlocksThatDifferAreNamed) {
  std::string text = "classes { name: \"robot\" meets: \"robot\" }";
  const Reloader reloader(ParseConfig(text, "f").config,
                          [&text] { return ParseConfig(text, "f"); });
  EXPECT_TRUE(reloader.Read().unchanged.empty());
  text += "limits { name: \"drone-*\" agents_max: 100 }";
  EXPECT_EQ(reloader.Read().unchanged, std::vector<std::string>{"limits"});
  text = "";
  EXPECT_EQ(reloader.Read().unchanged, std::vector<std::string>{"classes"});
}

TEST(Reload, FieldsThatCanChangeAreInTheTable) {
  for (const char* field : {"log_level", "log_file", "recorder_mb_max", "recorder_segment_mb",
                            "recorder_segment_s", "recorder_keep_s", "contacts_mb_max"}) {
    EXPECT_TRUE(CanChange(field, "1", "2"));
    EXPECT_NE(FindConfigOption(field), nullptr);
  }
  EXPECT_FALSE(CanChange("agents_max", "1", "2"));
}

}  // namespace
}  // namespace collision::server
