// Goal:   every test is built: each *_test.cc belongs to a program.
// Method: CMake writes down which *_test.cc its programs are built from, and which it leaves out
//         for want of what condition; both together must be the files that there are. The
//         comparison is first tried on a list that lacks a file.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/source/source_tree.h"

namespace collision::source {
namespace {

const std::string kEnding = "_test.cc";

/// What CMake wrote: lines "program NAME FILE" and "without CONDITION FILE".
struct Built {
  std::multiset<std::string> in_programs;
  std::set<std::string> left_out;    ///< Because their condition does not hold in this build.
  std::set<std::string> conditions;  ///< Those conditions.
};

Built Parse(const std::string& text) {
  Built built;
  std::istringstream lines(text);
  std::string kind, name, file;
  while (lines >> kind >> name >> file) {
    if (kind == "program") {
      built.in_programs.insert(file);
    } else {
      EXPECT_EQ(kind, "without") << file;
      built.left_out.insert(file);
      built.conditions.insert(name);
    }
  }
  return built;
}

/// The files that no program contains, and that no condition excuses.
std::vector<std::string> Unbuilt(const std::vector<std::string>& files, const Built& built) {
  std::vector<std::string> unbuilt;
  std::copy_if(files.begin(), files.end(), std::back_inserter(unbuilt), [&](const auto& file) {
    return built.in_programs.count(file) == 0 && built.left_out.count(file) == 0;
  });
  return unbuilt;
}

std::vector<std::string> TestFiles() {
  std::vector<std::string> files;
  for (const SourceFile& file : SourceFiles({".cc"})) {
    const bool is_test =
        file.path.size() > kEnding.size() &&
        file.path.compare(file.path.size() - kEnding.size(), kEnding.size(), kEnding) == 0;
    if (is_test) files.push_back(file.path);
  }
  return files;
}

const Built& ThisBuild() {
  static const Built built = Parse(ReadFile(COLLISION_TEST_SOURCES));
  return built;
}

TEST(Programs, AFileInNoProgramIsFound) {
  const Built built = Parse("program a_test a/x_test.cc\nwithout DATA a/data_test.cc\n");
  const std::vector<std::string> files = {"a/data_test.cc", "a/x_test.cc", "a/y_test.cc"};
  EXPECT_EQ(Unbuilt(files, built), std::vector<std::string>{"a/y_test.cc"});
  EXPECT_EQ(built.conditions, std::set<std::string>{"DATA"});
}

TEST(Programs, ContainEveryTest) {
  const std::vector<std::string> files = TestFiles();
  ASSERT_GT(files.size(), 200u) << "the project's tests were not found";
  for (const std::string& file : Unbuilt(files, ThisBuild())) {
    ADD_FAILURE() << file << " belongs to no program";
  }
}

TEST(Programs, ContainNoTestTwice) {
  for (const std::string& file : ThisBuild().in_programs) {
    EXPECT_EQ(ThisBuild().in_programs.count(file), 1u) << file;
  }
}

TEST(Programs, LeaveTestsOutOnlyForWantOfDataAssimpOrFastDds) {
  for (const std::string& condition : ThisBuild().conditions) {
    EXPECT_TRUE(condition == "COLLISION_DATA_DIR" || condition == "collision_reads_mesh_files" ||
                condition == "collision_builds_fast_dds")
        << condition;
  }
  for (const std::string& file : ThisBuild().left_out) {
    EXPECT_EQ(ThisBuild().in_programs.count(file), 0u) << file;
  }
}

}  // namespace
}  // namespace collision::source
