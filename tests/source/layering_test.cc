// Goal:   the layers of the code stay as they are drawn: nothing includes what it must not know.
// Method: the rules read every file of the project, and are first tried on includes planted to
// break them.
#include <gtest/gtest.h>

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
      {"collision_core/numeric/a.h", "\"collision_core/base/instant.h\""},
      {"collision_core/motion/a.h", "\"collision_core/intersection/earliest_intersection.h\""},
      {"collision_core/shape/a.h", "\"collision_core/base/instant.h\""},
      {"collision_core/shape/a.cc", "\"collision_core/geometry/triangle/triangle_pair.h\""},
      {"collision_core/broad_phase/a.cc", "\"collision_core/narrow_phase/a.h\""},
      {"collision_core/narrow_phase/a.cc", "\"collision_core/detection/a.h\""},
      {"collision_core/detection/a.h", "\"idl/messages.pb.h\""},
      {"collision_core/detection/a.h", "\"server/clock.h\""},
      {"collision_core/detection/a.cc", "<thread>"},
      {"collision_core/detection/a.cc", "<spdlog/spdlog.h>"},
      {"collision_core/detection/a.cc", "<unistd.h>"},
      {"collision_core/detection/a.cc", "<dds/dds.h>"},
      {"collision_core/motion/a.cc", "\"../detection/detector.h\""},
      {"idl/dds/a.h", "\"collision_core/base/instant.h\""},
      {"server/daemon.cc", "<dds/dds.h>"},
      {"server/daemon.cc", "\"collision.h\""},
      {"server/daemon.cc", "\"client/world.h\""},
      {"client/world.h", "<google/protobuf/message.h>"},
      {"client/world.h", "\"idl/messages.pb.h\""},
      {"client/world.cc", "  \"server/clock.h\""},
      {"client/world.cc", "<dds/dds.h>"},
      {"client/tools/motion_checker.cc", "\"collision_core/base/instant.h\""},
      {"client/tools/motion_checker.cc", "\"server/event_log.h\""},
      {"client/tools/sphere_tree_report.h", "\"collision_core/base/instant.h\""},
      {"client/tools/collisionctl_text.cc", "\"collision_core/shape/shape.h\""},
      {"idl/tree_message.cc", "\"collision_core/base/instant.h\""},
      {"idl/shape_bytes.cc", "\"collision_core/shape/shape.h\""},
      {"elsewhere/a.h", "\"client/types.h\""},
  };
  for (const Planted& planted : bad) {
    const auto violations = ViolationsOf(planted);
    ASSERT_EQ(violations.size(), 1u) << planted.path << " may include " << planted.include;
    EXPECT_EQ(violations[0].rfind(planted.path + ":4: ", 0), 0u) << violations[0];
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
      {"server/codec.cc", "\"collision_core/base/instant.h\""},
      {"client/world.cc", "\"idl/messages.pb.h\""},
      {"client/tools/sphere_tree_report.h", "\"collision_core/shape/shape.h\""},
      {"idl/tree_message.h", "\"collision_core/sphere_tree/sphere_tree.h\""},
      {"client/world.h", "\"client/types.h\""},
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

TEST(Layering, MainOnlyParsesLoadsAndRuns) {
  EXPECT_LT(CountLines(ReadFile("server/main.cc")), 60);
}

}  // namespace
}  // namespace collision::source
