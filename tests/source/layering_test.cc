// Goal:   the layers of the code stay as they are drawn: nothing includes what it must not know.
// Method: the rules read every file of the project, and are first tried on includes planted to
// break them.
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "tests/source/include_rules.h"
#include "tests/source/source_tree.h"

namespace collision::source {
namespace {

struct Planted {
  std::string path;
  std::string include;
};

std::vector<std::string> ViolationsOf(const Planted& planted) {
  return Violations(planted.path, "// A file.\n#pragma once\n\n#include " + planted.include + "\n");
}

TEST(Layering, BadIncludesAreFoundWithTheirLine) {
  const Planted bad[] = {
      {"collision_core/numeric/a.h", "\"collision_core/motion/motion_state.h\""},
      {"collision_core/motion/a.h", "\"collision_core/intersection/earliest_intersection.h\""},
      {"collision_core/shape/a.h", "\"collision_core/motion/motion_state.h\""},
      {"collision_core/shape/a.cc", "\"collision_core/narrow_phase/pose/verdict.h\""},
      {"collision_core/broad_phase/a.cc", "\"collision_core/narrow_phase/a.h\""},
      {"collision_core/narrow_phase/a.cc", "\"collision_core/detection/a.h\""},
      {"collision_core/detection/a.h", "\"collision_core/sphere_tree/a.h\""},
      {"collision_core/detection/a.h", "\"idl/messages.pb.h\""},
      {"collision_core/detection/a.h", "\"server/clock.h\""},
      {"collision_core/detection/a.cc", "<thread>"},
      {"collision_core/detection/a.cc", "<spdlog/spdlog.h>"},
      {"collision_core/detection/a.cc", "<unistd.h>"},
      {"collision_core/detection/a.cc", "<dds/dds.h>"},
      {"collision_core/motion/a.cc", "\"../detection/detector.h\""},
      {"idl/dds/a.h", "\"collision_core/base/instant.h\""},
      {"server/service/daemon.cc", "<dds/dds.h>"},
      {"server/service/daemon.cc", "\"collision.h\""},
      {"server/service/daemon.cc", "\"collision/world.h\""},
      {"server/process/logging.cc", "\"server/config/config.h\""},
      {"server/config/config.cc", "\"server/recording/recording.h\""},
      {"server/codec/codec.cc", "\"server/shapes/shape_store.h\""},
      {"server/shapes/shape_store.cc", "\"server/world/world.h\""},
      {"server/world/world.cc", "\"server/intake/intake.h\""},
      {"server/intake/intake.cc", "\"server/publish/publisher.h\""},
      {"server/publish/publisher.cc", "\"server/service/daemon.h\""},
      {"server/main.cc", "\"server/bus/dds_bus.h\""},
      {"server/daemon.cc", "\"server/bus/bus.h\""},
      {"client/include/collision/world.h", "<google/protobuf/message.h>"},
      {"client/include/collision/world.h", "\"idl/messages.pb.h\""},
      {"client/include/collision/world.h", "\"client/library/network/transport.h\""},
      {"client/examples/cpp/ten_lines.cc", "\"client/library/deadline.h\""},
      {"client/examples/fast_dds/bus.cc", "\"idl/limits.h\""},
      {"client/examples/fast_dds/bus.cc", "\"collision/world.h\""},
      {"client/library/world/world.cc", "  \"server/clock.h\""},
      {"client/library/world/world.cc", "<dds/dds.h>"},
      {"client/library/world/world.cc", "\"client/programs/shared/pace.h\""},
      {"client/library/network/conversion.cc", "\"client/library/world/contract.h\""},
      {"client/library/shape/shape.cc", "\"collision_core/base/instant.h\""},
      {"client/checker/check.h", "\"collision/types.h\""},
      {"client/checker/shape/mesh.h", "\"client/checker/motion/motion.h\""},
      {"client/programs/simulators/terrain/terrain.h", "\"client/checker/check.h\""},
      {"client/programs/tools/motion_checker_main.cc", "\"collision_core/base/instant.h\""},
      {"client/programs/tools/motion_checker_main.cc", "\"server/event_log.h\""},
      {"client/programs/tools/sphere_tree/report.h", "\"collision_core/base/instant.h\""},
      {"client/programs/tools/collisionctl/pages/text_pages.cc",
       "\"collision_core/shape/shape.h\""},
      {"idl/tree_message.cc", "\"collision_core/base/instant.h\""},
      {"idl/shape_bytes.cc", "\"collision_core/shape/shape.h\""},
      {"elsewhere/a.h", "\"collision/types.h\""},
  };
  for (const Planted& planted : bad) {
    const auto violations = ViolationsOf(planted);
    ASSERT_EQ(violations.size(), 1u) << planted.path << " may include " << planted.include;
    EXPECT_EQ(violations[0].rfind(planted.path + ":4: ", 0), 0u) << violations[0];
  }
}

TEST(Layering, ARoomWithoutAnEntryIsRefusedByName) {
  for (const char* include : {"\"collision_core/base/instant.h\"", "<vector>"}) {
    const auto violations = ViolationsOf({"collision_core/zzz/a.h", include});
    ASSERT_EQ(violations.size(), 1u) << include;
    EXPECT_NE(violations[0].find("no entry for collision_core/zzz/"), std::string::npos)
        << violations[0];
  }
}

TEST(Layering, GoodIncludesAreLeftAlone) {
  const Planted good[] = {
      {"collision_core/motion/a.h", "\"collision_core/numeric/interval.h\""},
      {"collision_core/shape/a.cc", "\"collision_core/numeric/interval.h\""},
      {"collision_core/narrow_phase/a.h", "\"collision_core/sphere_tree/sphere_tree.h\""},
      {"collision_core/detection/a.h", "\"collision_core/broad_phase/a.h\""},
      {"collision_core/numeric/a.h", "<Eigen/Core>"},
      {"collision_core/numeric/a.h", "<cmath>"},
      {"idl/dds/a.cc", "<dds/dds.h>"},
      {"server/codec/codec.cc", "\"collision_core/base/instant.h\""},
      {"server/service/daemon.cc", "\"server/intake/intake.h\""},
      {"server/intake/intake.cc", "\"server/world/world.h\""},
      {"client/library/world/world.cc", "\"idl/messages.pb.h\""},
      {"client/library/world/world.cc", "\"client/library/network/transport.h\""},
      {"client/programs/tools/sphere_tree/report.h", "\"collision_core/shape/shape.h\""},
      {"idl/tree_message.h", "\"collision_core/sphere_tree/sphere_tree.h\""},
      {"client/include/collision/world.h", "\"collision/types.h\""},
  };
  for (const Planted& planted : good) EXPECT_EQ(ViolationsOf(planted), std::vector<std::string>{});
}

TEST(Includes, AreReadWithSpacesAndNotFromComments) {
  const auto includes =
      Includes("// #include <a>\n  #  include   <b/c.h>  // why\nint include;\n#include \"d.h\"");
  ASSERT_EQ(includes.size(), 2u);
  EXPECT_EQ(includes[0].name, "b/c.h");
  EXPECT_FALSE(includes[0].quoted);
  EXPECT_EQ(includes[1].line, 4);
  EXPECT_TRUE(includes[1].quoted);
}

TEST(Layering, NothingIncludesWhatItMustNotKnow) {
  const auto files = SourceFiles({".h", ".cc"});
  ASSERT_GT(files.size(), 40u) << "the project's files were not found";
  for (const SourceFile& file : files) {
    for (const std::string& violation : Violations(file.path, file.text))
      ADD_FAILURE() << violation;
  }
}

/// Every header that `path` includes, directly or through another header of the project.
std::map<std::string, std::string> IncludedBy(const std::string& path) {
  std::map<std::string, std::string> includers;
  std::vector<std::string> unread = {path};
  while (!unread.empty()) {
    const std::string header = unread.back();
    unread.pop_back();
    for (const Include& include : Includes(ReadFile(header))) {
      const bool is_new = includers.try_emplace(include.name, header).second;
      if (!is_new || !include.quoted) continue;
      const bool is_public = include.name.rfind("collision/", 0) == 0;
      unread.push_back((is_public ? "client/include/" : "") + include.name);
    }
  }
  return includers;
}

// A program that links the client library compiles without protobuf and without DDS.
TEST(Layering, PublicClientHeadersLeadToNothingButTheStandardLibrary) {
  int headers = 0;
  for (const SourceFile& file : SourceFiles({".h"})) {
    if (file.path.rfind("client/include/collision/", 0) != 0) continue;
    ++headers;
    for (const auto& [name, includer] : IncludedBy(file.path)) {
      const bool is_of_c = name == "stddef.h" || name == "stdint.h";
      const bool is_standard = is_of_c || name.find_first_of("/.") == std::string::npos;
      EXPECT_TRUE(is_standard || name.rfind("collision/", 0) == 0)
          << file.path << " leads to " << name << " through " << includer;
    }
  }
  EXPECT_GE(headers, 8);
}

/// Headers and sources together.
constexpr int kFilesMax = 21;

// A folder is read at a glance.
TEST(Layering, FoldersOfTheProductHaveFewFiles) {
  std::map<std::string, int> files;
  for (const SourceFile& file : SourceFiles({".h", ".cc"})) {
    if (file.path.rfind("tests/", 0) != 0) ++files[file.path.substr(0, file.path.rfind('/'))];
  }
  EXPECT_GE(files.size(), 40u);
  for (const auto& [folder, count] : files) EXPECT_LE(count, kFilesMax) << folder;
}

// Pair rules have one door in the detector beside the neighbour index (pair_queries.h).
TEST(Layering, OnlyPairQueriesDecideAboutPairsInTheDetector) {
  const std::regex decides("\\b(EarliestIntersection|EarliestIntersectionOf|CanMeet)\\(");
  int deciding = 0;
  for (const SourceFile& file : SourceFiles({".h", ".cc"})) {
    if (file.path.rfind("collision_core/detection/", 0) != 0) continue;
    const bool is_door = file.path.find("/pair_queries.") != std::string::npos;
    const bool found = std::regex_search(file.text, decides);
    EXPECT_TRUE(is_door || !found) << file.path;
    deciding += found;
  }
  EXPECT_EQ(deciding, 1);
}

TEST(Layering, MainOnlyParsesLoadsAndRuns) {
  EXPECT_LT(CountLines(ReadFile("server/main.cc")), 60);
}

}  // namespace
}  // namespace collision::source
