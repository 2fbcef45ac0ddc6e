#include "server/config/config.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "idl/limits.h"
#include "server/config/config_options.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

std::string ReadFile(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Without comments' "# " and line breaks, so that a sentence can be found however it is wrapped.
std::string Unwrapped(const std::string& text) {
  std::istringstream words(text);
  std::string all;
  for (std::string word; words >> word;) {
    if (word != "#") all += word + " ";
  }
  return all;
}

std::string LeafOf(const ConfigOption& option) {
  return std::string(option.path.substr(option.path.rfind('.') + 1));
}

/// A text that sets one field.
std::string TextWith(const ConfigOption& option, const std::string& value) {
  const std::string field = LeafOf(option) + ": " + value;
  return option.path.starts_with("clock.") ? "clock {\n" + field + "\n}\n" : "\n" + field + "\n";
}

/// The errors that are about the field's own value.
int ErrorsOf(const ConfigOption& option, const std::string& value) {
  int count = 0;
  for (const std::string& error : ParseConfig(TextWith(option, value), "F").errors) {
    const bool about_value = error.find("allowed: " + AllowedRange(option)) != error.npos;
    count += error.starts_with("F:2: " + std::string(option.path) + ": ") && about_value;
  }
  return count;
}

std::string Exact(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string Just(const ConfigOption& option, std::string_view limit, double direction) {
  const bool whole = option.path.find("_s") != option.path.size() - 2;
  const double value = std::stod(std::string(limit));
  if (!whole) return Exact(std::nextafter(value, direction));
  if (value > 1e18) return "18446744073709551616";
  return std::to_string(static_cast<long long>(value) + (direction > 0 ? 1 : -1));
}

// Goal:   the table knows every field of the configuration, once and in order.
// Method: against the protobuf descriptor.
TEST(ConfigOptions, CoverEveryField) {
  std::vector<std::string> fields;
  const auto* config = v1::Config::descriptor();
  for (int i = 0; i < config->field_count(); ++i) {
    if (config->field(i)->is_repeated()) continue;  // Blocks, which have no default.
    const auto* nested = config->field(i)->message_type();
    if (!nested) fields.push_back(config->field(i)->name());
    for (int j = 0; nested && j < nested->field_count(); ++j) {
      fields.push_back(config->field(i)->name() + "." + nested->field(j)->name());
    }
  }
  std::vector<std::string> paths;
  std::set<std::string> leaves;
  for (const ConfigOption& option : ConfigOptions()) {
    paths.emplace_back(option.path);
    leaves.insert(LeafOf(option));
  }
  EXPECT_EQ(paths, fields);
  EXPECT_EQ(leaves.size(), paths.size()) << "errors find an option by its last name";
}

// Goal:   the documented file tells the truth: every field with its unit, range and default, and
//         it loads to exactly the defaults.
// Method: against the table, and as a whole against --print-config.
TEST(Config, ExampleFileDocumentsEveryField) {
  const std::string path = COLLISION_CONFIG_DIR "/collisiond.textproto";
  const std::string text = ReadFile(path);
  for (const ConfigOption& option : ConfigOptions()) {
    const std::string facts = "Unit: " + std::string(option.unit) +
                              ". Range: " + AllowedRange(option) +
                              ". Default: " + std::string(option.value);
    const std::string value = LeafOf(option) + ": " + std::string(option.value) + " ";
    const std::size_t place = Unwrapped(text).find(facts);
    EXPECT_NE(place, std::string::npos) << facts;
    EXPECT_NE(Unwrapped(text).find(value, place), std::string::npos) << value;
  }
  const ConfigResult loaded = LoadConfig(path);
  EXPECT_TRUE(loaded.ok());
  EXPECT_EQ(loaded.config.SerializeAsString(), CompleteConfig({}).SerializeAsString());
  EXPECT_EQ(text, PrintConfig(CompleteConfig({}))) << "renew it with collisiond --print-config";
}

// Goal:   the defaults are those that the design states, and valid.
TEST(Config, DefaultsAreAsDesignedAndValid) {
  for (const ConfigResult& result :
       {ParseConfig("", "F"), ParseConfig("clock { kind: REAL_TIME }", "F")}) {
    EXPECT_TRUE(result.ok());
    EXPECT_EQ(result.config.world(), "default");
    EXPECT_EQ(result.config.domain(), 0u);
    EXPECT_EQ(result.config.log_file(), "");
    EXPECT_EQ(result.config.temporal_resolution_s(), 1.0 / 60);
    EXPECT_EQ(result.config.announce_within_s(), 2);
    EXPECT_EQ(result.config.agents_max(), 1000u);
    EXPECT_EQ(result.config.clock().grant_ahead_max_s(), 10);
    EXPECT_EQ(result.config.clock().on_silent_simulator(), v1::Clock::WAIT);
    const bool wall = result.config.clock().kind() == v1::Clock::REAL_TIME;
    EXPECT_EQ(result.config.clock().skew_max_s(), wall ? 0.002 : 0);
  }
}

// Goal:   each number's range is closed: its limits are accepted, what is just beyond is refused,
//         with the field's line and range; what is not a number is refused too.
TEST(Config, RangesAreClosedOnBothSides) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const ConfigOption& option : ConfigOptions()) {
    if (option.least.empty()) continue;
    EXPECT_EQ(ErrorsOf(option, std::string(option.least)), 0) << option.path;
    EXPECT_EQ(ErrorsOf(option, std::string(option.most)), 0) << option.path;
    EXPECT_EQ(ErrorsOf(option, Just(option, option.least, -infinity)), 1) << option.path;
    EXPECT_EQ(ErrorsOf(option, Just(option, option.most, infinity)), 1) << option.path;
    for (const char* bad : {"nan", "inf", "-1", "\"5\"", "WAIT", ""}) {
      EXPECT_EQ(ErrorsOf(option, bad), 1) << option.path << ": " << bad;
    }
  }
}

// Goal:   names and choices are checked too.
TEST(Config, WordsAreChecked) {
  const std::string longest(64, 'w');
  const ConfigOption& world = *FindConfigOption("world");
  for (const std::string& good : {std::string("a"), std::string("Az09_-"), longest}) {
    EXPECT_EQ(ErrorsOf(world, '"' + good + '"'), 0) << good;
  }
  for (const std::string& bad :
       {std::string(), longest + "w", std::string("a.b"), std::string("a*"), std::string("a b"),
        std::string("a\\000b"), std::string("\\303\\244")}) {
    EXPECT_EQ(ErrorsOf(world, '"' + bad + '"'), 1) << bad;
  }
  const ConfigOption& file = *FindConfigOption("log_file");
  EXPECT_EQ(ErrorsOf(file, '"' + std::string(4096, '/') + '"'), 0);
  EXPECT_EQ(ErrorsOf(file, '"' + std::string(4097, '/') + '"'), 1);
  EXPECT_EQ(ErrorsOf(file, "\"\\377\""), 1) << "a recording could not carry it";
  EXPECT_EQ(ErrorsOf(*FindConfigOption("log_level"), "\"warn\""), 0);
  EXPECT_EQ(ErrorsOf(*FindConfigOption("log_level"), "\"warning\""), 1);
  EXPECT_EQ(ErrorsOf(*FindConfigOption("kind"), "REAL_TIME"), 0);
  for (const char* bad : {"UNSET", "MONOTONIC", "7"}) {
    EXPECT_EQ(ErrorsOf(*FindConfigOption("kind"), bad), 1) << bad;
  }
  const ConfigOption& method = *FindConfigOption("broad_phase");
  for (const char* good : {"AUTO", "ALL_PAIRS", "SPATIAL_INDEX"}) {
    EXPECT_EQ(ErrorsOf(method, good), 0) << good;
  }
  for (const char* bad : {"BROAD_PHASE_UNSET", "FACE_SWEEP", "OCTREE", "0", "\"AUTO\""}) {
    EXPECT_EQ(ErrorsOf(method, bad), 1) << bad;
  }
}

// Goal:   all errors of a file are reported, each with its line, of whatever kind.
TEST(Config, TellsAllErrorsWithTheirLines) {
  const std::string text =
      "world: \"bad world\"\n"
      "nosuch { kind: 5 }\n"
      "clock {\n"
      "  kind: FOO\n"
      "  bogus: 7\n"
      "  simulators_awaited: -2\n"
      "}\n"
      "agents_max:\n"
      "pairs_max: 1.5  # not whole\n"
      "domain: 3\n"
      "domain: 4\n"
      "log_file: \"abc\n"
      "status_period_s: inf\n";
  const std::vector<std::string> expected = {
      "1: world: ",           "2: nosuch: ",          "4: clock.kind: ", "5: clock.bogus: ",
      "6: clock.simulators_", "8: agents_max: ",      "9: pairs_max: ",  "11: domain: ",
      "12: log_file: ",       "13: status_period_s: "};
  const std::vector<std::string> errors = ParseConfig(text, "a/F.textproto").errors;
  ASSERT_EQ(errors.size(), expected.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_TRUE(errors[i].starts_with("a/F.textproto:" + expected[i])) << errors[i];
    EXPECT_EQ(errors[i].find(".;"), std::string::npos) << errors[i];
  }
}

// Goal:   within `clock` errors are as good as outside, and none hides another: each names the
//         path of its field, the line, and what is allowed, however the text is broken into lines.
TEST(Config, TellsAllErrorsWithinClock) {
  const std::vector<std::string> fields = {"on_silent_simulator: NONE",
                                           "skew_max_s: \"wide\"",
                                           "waiting_after_s: 1",
                                           "bogus: 7",
                                           "waiting_after_s: 2",
                                           "simulators_awaited:",
                                           "log_level: 3",
                                           "grant_ahead_max_s: 0",
                                           "first_clock_max_s { }",
                                           "kind: 7"};
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"clock.on_silent_simulator: ", "; allowed: WAIT or RELEASE"},
      {"clock.skew_max_s: ", "; allowed: 0 to 60"},
      {"clock.bogus: ", "no field named \"bogus\""},
      {"clock.waiting_after_s: ", "; allowed: 0.1 to 86400"},
      {"clock.simulators_awaited: ", "; allowed: 1 to 1024"},
      {"clock.log_level: ", "; meant is log_level?"},
      {"clock.grant_ahead_max_s: ", "; allowed: 0.000001 to 86400 [s]"},
      {"clock.first_clock_max_s: ", "; allowed: 0 to 4000000000"},
      {"clock.kind: ", "; allowed: LOCK_STEP or REAL_TIME"},
      {"domain: ", "; allowed: 0 to 230"}};
  const std::vector<int> lines = {1, 2, 4, 5, 6, 7, 8, 9, 10, 11};
  for (const char* separator : {" ", "\n", "\n\t", " # what for\n"}) {
    std::string text = "clock { ";
    for (const std::string& field : fields) text += field + separator;
    text += "} domain: 231";
    const std::vector<std::string> errors = ParseConfig(text, "F").errors;
    ASSERT_EQ(errors.size(), expected.size()) << text;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const int line = separator[0] == ' ' && separator[1] == 0 ? 1 : lines[i];
      EXPECT_TRUE(errors[i].starts_with("F:" + std::to_string(line) + ": " + expected[i].first))
          << errors[i];
      EXPECT_TRUE(errors[i].ends_with(expected[i].second)) << errors[i];
    }
  }
}

// Goal:   a field outside its place is told where it belongs; a second block is told, too.
TEST(Config, MisplacedAndDoubledBlocksAreNamed) {
  const auto first = [](const std::string& text) {
    const ConfigResult result = ParseConfig(text, "F");
    return result.errors.size() == 1 ? result.errors[0] : "not one error";
  };
  EXPECT_TRUE(first("kind: REAL_TIME").ends_with("; meant is clock.kind?"))
      << first("kind: REAL_TIME");
  EXPECT_TRUE(first("clock { }\nclock { kind: 7 }").starts_with("F:2: clock: "));
  EXPECT_TRUE(first("clock: 5\ndomain: 3").starts_with("F:1: clock: "));
  EXPECT_TRUE(first("clock { kind:\n}").starts_with("F:1: clock.kind: "));
}

// Goal:   a configuration with the words of an earlier version is refused with those of now.
TEST(Config, TheFormerKindsOfClockAreNamedAnew) {
  const std::pair<const char*, const char*> words[] = {{"SIMULATED", "LOCK_STEP"},
                                                       {"WALL", "REAL_TIME"}};
  for (const auto& [former, now] : words) {
    const ConfigResult result =
        ParseConfig("world: \"a\"\nclock { kind: " + std::string(former) + " }", "F");
    ASSERT_EQ(result.errors.size(), 1u) << former;
    EXPECT_EQ(result.errors[0], "F:2: clock.kind: " + std::string(former) + " is called " + now +
                                    " now; allowed: LOCK_STEP or REAL_TIME");
  }
}

// Goal:   fields that contradict each other are refused at the line of the one that is set, and
//         at equality, or when they agree, they are not.
TEST(Config, ContradictingFieldsAreRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"announce_within_s: 0.016", "F:1: announce_within_s: "},
      {"\ntemporal_resolution_s: 3", "F:2: announce_within_s: "},
      {"temporal_resolution_s: 0.5 announce_within_s: 0.5", ""},
      {"clock { grant_ahead_max_s: 0.01 }", "F:1: clock.grant_ahead_max_s: "},
      {"temporal_resolution_s: 0.5\nclock { grant_ahead_max_s: 0.5 }", ""},
      {"clock { simulators_awaited: 65 }", "F:1: clock.simulators_awaited: "},
      {"clock {\n simulators_awaited: 2 }\nsimulators_max: 1", "F:2: clock.simulators_awaited: "},
      {"clock { simulators_awaited: 64 }", ""},
      {"clock { kind: REAL_TIME skew_max_s: 0 }", "F:1: clock.skew_max_s: "},
      {"clock { kind: REAL_TIME skew_max_s: 1e-6 }", ""},
      {"clock { release_after_s: 6 }", "F:1: clock.release_after_s: "},
      {"clock { release_after_s: 5 }", ""},
      {"clock { release_after_s: 6 on_silent_simulator: RELEASE }", ""},
      {"clock { kind: REAL_TIME on_silent_simulator: RELEASE }",
       "F:1: clock.on_silent_simulator: "},
      {"clock { kind: REAL_TIME first_clock_max_s: 1 }", "F:1: clock.first_clock_max_s: "},
      {"clock { kind: REAL_TIME shape_wait_max_s: 1 }", "F:1: clock.shape_wait_max_s: "},
      {"clock {\n kind: REAL_TIME\n waiting_after_s: 1 }", "F:3: clock.waiting_after_s: "},
      {"clock { kind: REAL_TIME waiting_after_s: 5 on_silent_simulator: WAIT }", ""},
      {"clock { wait_for_synchronisation_s: 1 }", "F:1: clock.wait_for_synchronisation_s: "},
      {"clock { wait_for_synchronisation_s: 0 }", ""},
      {"clock { kind: REAL_TIME wait_for_synchronisation_s: 1 }", ""}};
  for (const auto& [text, error] : cases) {
    const ConfigResult result = ParseConfig(text, "F");
    const std::string first = result.ok() ? "" : result.errors[0];
    EXPECT_EQ(result.errors.size(), *error ? 1u : 0u) << text << first;
    EXPECT_TRUE(first.starts_with(error)) << first;
  }
}

std::string RandomValue(const ConfigOption& option, Random& random) {
  const bool seconds = option.unit == "s";
  if (option.path == "world") return "\"w" + std::to_string(random.Below(1000)) + "\"";
  if (option.path == "log_level") return "\"debug\"";
  if (option.path == "log_format") return "JSON";
  if (option.path == "frame" || option.path == "epoch_utc") return "\"ENU 47.4 8.5\"";
  if (option.path == "log_file" || option.path.ends_with("_dir")) return "\"/a b\\\"\\\\\"";
  if (option.path == "clock.kind") return random.Chance(0.5) ? "REAL_TIME" : "LOCK_STEP";
  if (option.path == "broad_phase") return random.Chance(0.5) ? "AUTO" : "ALL_PAIRS";
  if (option.path == "tree_builder") return random.Chance(0.5) ? "MEDIAN_SPLIT" : "FITTED";
  const bool needs_others = !option.only_with.empty() || option.path == "clock.release_after_s";
  if (needs_others && random.Chance(0.9)) return std::string(option.value);
  if (option.path.ends_with("_failure")) return random.Chance(0.5) ? "GO_ON" : "END";
  if (option.path == "on_occupied") return random.Chance(0.5) ? "LEAVE" : "STAND_BY";
  if (option.least.empty()) return "RELEASE";
  const double least = std::max(std::stod(std::string(option.least)), 1e-6);
  const double most = std::min(std::stod(std::string(option.most)), 1e15);
  const double value = random.LogUniform(least, most);
  return seconds ? Exact(value) : std::to_string(static_cast<long long>(std::ceil(value)));
}

// Goal:   what --print-config prints loads again to the same values, to the last bit.
// Method: 200 random configurations.
TEST(Config, PrintedConfigurationLoadsAgain) {
  Random random(1);
  int valid = 0;
  for (int i = 0; i < 200; ++i) {
    v1::Config config;
    for (const ConfigOption& option : ConfigOptions()) {
      ASSERT_TRUE(SetValue(&config, option, RandomValue(option, random))) << option.path;
    }
    const ConfigResult result = ParseConfig(PrintConfig(config), "F");
    EXPECT_EQ(result.config.SerializeAsString(), config.SerializeAsString());
    EXPECT_EQ(result.ok(), CheckConfig(config).empty());
    valid += result.ok();
  }
  EXPECT_GT(valid, 10);
}

// Goal:   any text at all gives either a valid configuration or errors that are single legible
// lines. Method: 500 damaged copies of the printed configuration.
TEST(Config, DamagedTextIsNeverMoreThanErrors) {
  Random random(2);
  const std::string whole = PrintConfig(CompleteConfig({}));
  for (int i = 0; i < 500; ++i) {
    std::string text = whole;
    for (std::uint64_t n = 1 + random.Below(4); n > 0; --n) {
      const std::size_t at = random.Below(text.size());
      if (random.Chance(0.5))
        text[at] = static_cast<char>(random.Below(256));
      else
        text.erase(at, random.Below(40));
    }
    const ConfigResult result = ParseConfig(text, "F");
    EXPECT_EQ(result.ok(), result.ok() && CheckConfig(result.config).empty());
    for (const std::string& error : result.errors) {
      EXPECT_TRUE(error.starts_with("F:"));
      for (const char c : error) EXPECT_TRUE(c >= ' ' && c <= '~') << error;
    }
  }
}

// Goal:   a file that cannot be read is one clear error; an empty one is all defaults.
TEST(Config, AnUnreadableFileIsOneClearError) {
  const std::string missing = testing::TempDir() + "no-such-config";
  EXPECT_EQ(LoadConfig(missing).errors,
            std::vector<std::string>{missing + ": cannot be read: No such file or directory"});
  EXPECT_EQ(LoadConfig("/").errors, std::vector<std::string>{"/: cannot be read: Is a directory"});
  EXPECT_TRUE(LoadConfig("/dev/null").ok());
}

// Goal:   the table allows what the wire carries.
TEST(ConfigOptions, RangesAreTheLimitsOfTheWire) {
  EXPECT_EQ(FindConfigOption("domain")->most, std::to_string(wire::kDomainMax));
  EXPECT_EQ(FindConfigOption("shape_triangles_max")->most,
            std::to_string(wire::kShapeTrianglesMax));
}

}  // namespace
}  // namespace collision::server
