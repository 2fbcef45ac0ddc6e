// Goal:   two services that find the same have one digest, two that may not have different ones.
// Method: each field of the table by itself is given another value.
#include "server/config/config_digest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "server/config/config.h"
#include "server/config/config_options.h"

namespace collision::server {
namespace {

/// A value that is not the default.
std::string OtherValue(const ConfigOption& option) {
  const auto other = [&](std::string_view one, std::string_view two) {
    return std::string(option.value == one ? two : one);
  };
  if (option.path == "clock.kind") return "REAL_TIME";
  if (option.path == "clock.on_silent_simulator") return "RELEASE";
  if (option.path == "broad_phase") return "ALL_PAIRS";
  if (option.path == "tree_builder") return "OCTREE";
  if (option.path == "on_occupied") return "STAND_BY";
  if (option.path.ends_with("_failure")) return "END";
  if (option.path == "log_level") return "\"debug\"";
  if (option.path == "log_format") return "JSON";
  if (option.least.empty()) return "\"other\"";
  return other(option.least, option.most);
}

TEST(ConfigurationDigest, ChangesExactlyWithTheFieldsThatDecideResults) {
  const std::uint64_t before = ConfigurationDigest(CompleteConfig({}));
  std::set<std::uint64_t> digests = {0, before};
  std::size_t without_results = 0;
  for (const ConfigOption& option : ConfigOptions()) {
    v1::Config config;
    ASSERT_TRUE(SetValue(&config, option, OtherValue(option))) << option.path;
    const std::uint64_t digest = ConfigurationDigest(CompleteConfig(config));
    if (std::ranges::count(FieldsWithoutResults(), option.path) > 0) {
      EXPECT_EQ(digest, before) << option.path;
      ++without_results;
    } else {
      EXPECT_TRUE(digests.insert(digest).second) << option.path;
    }
  }
  EXPECT_EQ(without_results, FieldsWithoutResults().size()) << "each is a field of the table";
}

TEST(ConfigurationDigest, ChangesWithClocksBudgetsLimitsAndBounds) {
  for (const std::string_view path :
       {"clock.kind", "clock.skew_max_s", "clock.on_silent_simulator", "temporal_resolution_s",
        "agents_max", "pairs_max", "history_max", "time_budget_us", "step_budget_us",
        "work_units_per_us", "shape_bytes_max", "tree_builder"}) {
    EXPECT_EQ(std::ranges::count(FieldsWithoutResults(), path), 0) << path;
  }
}

TEST(ConfigurationDigest, ChangesWithTheBlocksOfLimits) {
  const auto digest = [](const std::string& text) {
    return ConfigurationDigest(ParseConfig(text, "F").config);
  };
  const std::string one = "limits { name: \"a\" agents_max: 5 }";
  const std::string two = "limits { name: \"b\" agents_max: 5 }";
  const std::set<std::uint64_t> digests = {digest(""), digest(one), digest(two), digest(one + two),
                                           digest(two + one)};
  EXPECT_EQ(digests.size(), 5u);
  EXPECT_EQ(digest("agents_max: 1000"), digest("")) << "a default that is written out";
}

}  // namespace
}  // namespace collision::server
