// Goal:   a project of one's own builds against the installed library, by CMake and by pkg-config,
//         in C++ and in C, and its programs meet; the library shows and needs nothing of ours.
// Method: the build is installed into a folder, and the examples are built there.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

const std::string kExamples = std::string(COLLISION_SOURCE_DIR) + "/client/examples/";

void ExpectSuccess(const Outcome& outcome) {
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

class InstalledTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder;
    for (const char* component : {"library", "dev"}) {
      ExpectSuccess(RunToEnd({COLLISION_CMAKE, "--install", COLLISION_BUILD_DIR, "--prefix",
                              Prefix(), "--component", component}));
    }
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string Prefix() { return folder_->Path("installed"); }
  static std::string Library() { return Prefix() + "/" COLLISION_LIBDIR "/libcollision.so.0"; }

  /// Configures and builds an example; returns its folder.
  static std::string Built(const std::string& example) {
    const std::string build = folder_->Path(example);
    ExpectSuccess(RunToEnd({COLLISION_CMAKE, "-S", kExamples + example, "-B", build,
                            "-DCMAKE_PREFIX_PATH=" + Prefix()}));
    ExpectSuccess(RunToEnd({COLLISION_CMAKE, "--build", build}));
    return build;
  }

  /// Runs a program beside a service, in its world.
  static std::string OutputOf(const std::string& program, const TestWorld& world) {
    const Outcome outcome =
        RunToEnd({program}, {"COLLISION_WORLD=" + world.name(),
                             "COLLISION_DOMAIN=" + std::to_string(world.domain()),
                             "CYCLONEDDS_URI=file://" + ConfigFile("cyclonedds-loopback.xml"),
                             "LD_LIBRARY_PATH=" + Prefix() + "/" COLLISION_LIBDIR});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  }

 private:
  static Folder* folder_;
};

Folder* InstalledTest::folder_ = nullptr;

TEST_F(InstalledTest, ExamplesBuildAndMeet) {
  const TestWorld world(93, "simulators_awaited: 1");
  const auto daemon = world.StartDaemon();
  const std::string in_c = OutputOf(Built("c") + "/two-balls", world);
  EXPECT_TRUE(Contains(in_c, "parted between 5.249 s and 5.251 s")) << in_c;
  const std::string in_cpp = OutputOf(Built("cpp") + "/ten_lines", world);
  EXPECT_TRUE(Contains(in_cpp, "ended      ada × bob")) << in_cpp;

  // The same by pkg-config.
  const std::string program = Prefix() + "/by-pkg-config";
  ExpectSuccess(RunToEnd({"/bin/sh", "-c",
                          "cc -o " + program + " " + kExamples +
                              "c/two_balls.c $(pkg-config --cflags --libs collision)"},
                         {"PKG_CONFIG_PATH=" + Prefix() + "/" COLLISION_LIBDIR "/pkgconfig"}));
  EXPECT_EQ(OutputOf(program, world), in_c);
}

TEST_F(InstalledTest, TheLibraryShowsItsInterfaceAndNothingElse) {
  const Outcome symbols = RunToEnd({"nm", "-D", "--defined-only", Library()});
  ExpectSuccess(symbols);
  std::istringstream lines(symbols.out);
  int shown = 0;
  for (std::string address, kind, name; lines >> address >> kind >> name; ++shown) {
    const bool is_ours = name.starts_with("collision_") || name == "COLLISION_0" ||
                         Contains(name, "9collision6client");
    EXPECT_TRUE(is_ours) << name;
    EXPECT_FALSE(Contains(name, "14Implementation4") || Contains(name, "2v1")) << name;
  }
  EXPECT_GT(shown, 100);
}

TEST_F(InstalledTest, TheLibraryNeedsNoProtobuf) {
  const Outcome needed = RunToEnd({"readelf", "-d", Library()});
  ExpectSuccess(needed);
  EXPECT_TRUE(Contains(needed.out, "libddsc")) << needed.out;
  EXPECT_FALSE(Contains(needed.out, "protobuf")) << needed.out;
  EXPECT_TRUE(Contains(needed.out, "[libcollision.so.0]")) << needed.out;
}

// The header serves every C and C++ that a compiler still knows.
TEST_F(InstalledTest, TheHeaderInCIsPlainC) {
  for (const char* standard : {"c90", "c99", "c11", "c17", "c++98", "c++11", "c++20"}) {
    const std::string language = Contains(standard, "++") ? "c++" : "c";
    ExpectSuccess(RunToEnd({"/bin/sh", "-c",
                            "echo '#include <collision/collision.h>' | cc -x " + language +
                                " -std=" + standard + " -pedantic-errors -Wall -Wextra -Werror" +
                                " -fsyntax-only -I" + Prefix() + "/include -"}));
  }
}

std::set<std::string> LinesOf(const std::string& text) {
  std::set<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.insert(line);
  return lines;
}

// Goal:   a program that was linked with the version before runs with this one; whoever changes the
//         binary interface knows it.
// Method: all exported symbols, and the sizes of all types that cross the interface by value, are
//         those of the file that was recorded.
TEST_F(InstalledTest, TheBinaryInterfaceIsTheRecordedOne) {
  const Outcome symbols = RunToEnd({"nm", "-D", "--defined-only", Library()});
  ExpectSuccess(symbols);
  std::set<std::string> now = LinesOf(RunToEnd({Program("interface-sizes")}).out);
  for (const std::string& line : LinesOf(symbols.out)) {
    const std::string name = line.substr(line.rfind(' ') + 1);
    if (name != "COLLISION_0") now.insert("symbol " + name);
  }
  std::string text;
  for (const std::string& line : now) text += line + "\n";
  std::ostringstream recorded;
  recorded << std::ifstream(std::string(COLLISION_SOURCE_DIR) + "/client/packaging/interface.txt")
                  .rdbuf();
  const std::set<std::string> before = LinesOf(recorded.str());
  std::string changes;
  for (const std::string& line : before)
    changes += now.contains(line) ? "" : "gone: " + line + "\n";
  for (const std::string& line : now) changes += before.contains(line) ? "" : "new: " + line + "\n";
  EXPECT_EQ(changes, "")
      << "what is gone breaks programs that were linked before: raise SOVERSION of the library and "
         "the name of its package, unless no version with it was released; then "
         "client/packaging/interface.txt is:\n"
      << text;
}

}  // namespace
}  // namespace collision::system_test
