// Goal:   files stay readable, finished, and free of the machine they were written on.
// Method: read every file of the project; each finding is first tried on a text that has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/source/source_tree.h"

namespace collision::source {
namespace {

constexpr int kLinesMax = 450;
constexpr int kColumnsMax = 100;

// Built from pieces, so that this file does not find itself.
const std::string kLeftovers = std::string("\\b(TO") + "DO|FIX" + "ME|X" + "XX)\\b";
const std::string kMachinePaths =
    std::string("(^|[^A-Za-z0-9_.}])/(wo") + "rk|ho" + "me|ro" + "ot|fa" + "rm)/";
const std::string kWeakTests =
    std::string("DISAB") + "LED_|GTEST_" + "SKIP|sleep_" + "for|sleep_" + "until|\\busle" + "ep\\b";

bool Finds(const std::string& pattern, const std::string& text) {
  return std::regex_search(text, std::regex(pattern));
}

void ExpectNowhere(const std::string& pattern, const std::vector<SourceFile>& files) {
  const std::regex compiled(pattern);
  for (const SourceFile& file : files) {
    std::smatch match;
    if (std::regex_search(file.text, match, compiled)) {
      ADD_FAILURE() << file.path << ":" << CountLines(match.prefix()) + 1 << ": " << match.str();
    }
  }
}

/// The code of a line: what stands before a comment.
std::string CodeOf(const std::string& line) { return line.substr(0, line.find("//")); }

/// The lines, counted from 1, that have outside a statement that declares a constant: a negative
/// power of two or of ten, or one of two digits; a number with three decimals or more; a multiple
/// of the unit roundoff.
std::vector<int> UnnamedEpsilons(const std::string& text) {
  static const std::regex epsilon(
      "\\b0[xX][0-9a-fA-F.]+p(-[0-9]|\\+?[0-9]{2})|\\b[0-9][0-9.]*e(-[0-9]|\\+?[0-9]{2})|"
      "(^|[^0-9a-fA-FxX])[0-9]*\\.[0-9]{2,}[1-9]|\\b[0-9.]+\\s*\\*\\s*(numeric::)?"
      "kUnitRoundoff\\b");
  static const std::regex end("[;{}]\\s*$");
  std::vector<int> found;
  std::istringstream lines(text);
  std::string line, statement;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string code = CodeOf(line);
    statement += code;
    const bool declares = statement.find("constexpr ") != std::string::npos;
    if (!declares && std::regex_search(code, epsilon)) found.push_back(number);
    if (std::regex_search(code, end)) statement.clear();
  }
  return found;
}

/// Characters of a line of UTF-8: all bytes but those that go on with a character.
int CountColumns(const std::string& line) {
  return static_cast<int>(std::count_if(line.begin(), line.end(), [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
  }));
}

/// The numbers of the lines of `text` that are wider than `kColumnsMax`.
std::vector<int> WideLines(const std::string& text) {
  std::vector<int> wide;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (CountColumns(line) > kColumnsMax) wide.push_back(number);
  }
  return wide;
}

/// Markdown with empty lines in place of those that cannot be wrapped: rows of tables, blocks of
/// code, and links without a space.
std::string WrappableLines(const std::string& markdown) {
  const std::regex unwrappable(R"(\s*\|.*|\s*([-*] )?!?\[[^\]]*\]\(\S*)");
  std::string wrappable;
  std::istringstream lines(markdown);
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    const bool fence = line.rfind("```", 0) == 0;
    if (!code && !fence && !std::regex_match(line, unwrappable)) wrappable += line;
    wrappable += '\n';
    if (fence) code = !code;
  }
  return wrappable;
}

/// Every text that is written by hand and can be wrapped.
std::vector<SourceFile> FilesWithColumns() {
  std::vector<SourceFile> files =
      SourceFiles({".h", ".cc", ".idl", ".proto", ".textproto", ".service", ".md"});
  for (SourceFile& file : SourceFiles({".txt"})) {
    if (file.path.find("CMakeLists") != std::string::npos) files.push_back(std::move(file));
  }
  for (SourceFile& script : Scripts()) files.push_back(std::move(script));
  for (const char* path : {"README.md", "CHANGELOG.md", "CMakeLists.txt"}) {
    files.push_back({path, ReadFile(path)});
  }
  const std::regex markdown("\\.md$");
  for (SourceFile& file : files) {
    if (std::regex_search(file.path, markdown)) file.text = WrappableLines(file.text);
  }
  return files;
}

TEST(Style, TheFindingsFind) {
  EXPECT_TRUE(Finds(kLeftovers, std::string("// TO") + "DO: later"));
  EXPECT_FALSE(Finds(kLeftovers, "a TODOS list"));
  EXPECT_TRUE(Finds(kMachinePaths, std::string("open(\"/ho") + "me/me/data.csv\")"));
  EXPECT_FALSE(Finds(kMachinePaths, std::string("the frame") + "work/ of home/"));
  EXPECT_TRUE(Finds(kWeakTests, std::string("std::this_thread::sleep_") + "for(1s)"));
  const std::string named = "constexpr double kA = 1e-9,\n    kB = 0x1p-50;  // 0x1p-53\n// 1e-3\n";
  EXPECT_TRUE(UnnamedEpsilons(named).empty());
  EXPECT_EQ(UnnamedEpsilons(named + "x *= 1 +\n    0x1p-50f;\nif (y > 2.5e-3 * z) {\n"),
            (std::vector<int>{5, 6}));
  for (const char* number :
       {"1e-9", "0x1p-30", "1.001", "1.0000001", "0.999", ".9999", "0.001", "0.005", ".0005",
        "1e18", "2.5e+30", "0x1p+60", "0x1p100", "20.001", "0.125", "3.14159", "5 * kUnitRoundoff",
        "12 * numeric::kUnitRoundoff"}) {
    EXPECT_EQ(UnnamedEpsilons(std::string("x *= ") + number + ";\n"), std::vector<int>{1})
        << number;
  }
  for (const char* number : {"0.5", "0.98", "1.05", "1.0", "0.0", "1e3", "0x1p+3", "0x1.921fp+0",
                             "100", "0.500", "kErrorOfGap * kUnitRoundoff"}) {
    EXPECT_TRUE(UnnamedEpsilons(std::string("x *= ") + number + ";\n").empty()) << number;
  }
  EXPECT_EQ(CountLines("a\nb\n"), 2);
  EXPECT_EQ(CountColumns("½ τ² ≥ x"), 8);
}

TEST(Style, WideLinesAreFound) {
  const std::string wide(kColumnsMax + 1, 'x');
  EXPECT_EQ(WideLines("short\n" + wide + "\n"), std::vector<int>{2});
  EXPECT_TRUE(WideLines(wide.substr(1) + "\n").empty());
  EXPECT_EQ(WideLines(WrappableLines("|" + wide + "|\n```\n" + wide + "\n```\n" + wide + "\n")),
            std::vector<int>{5});
  EXPECT_TRUE(WideLines(WrappableLines("![a figure](" + wide + ")\n")).empty());
}

TEST(Style, FilesAreOfReadableLength) {
  for (const SourceFile& file : SourceFiles({".h", ".cc"})) {
    EXPECT_LT(CountLines(file.text), kLinesMax) << file.path;
  }
}

TEST(Style, ScriptsAreFound) {
  std::vector<std::string> paths;
  for (const SourceFile& script : Scripts()) paths.push_back(script.path);
  EXPECT_NE(std::find(paths.begin(), paths.end(), "tests/mutants/mutants"), paths.end());
}

// clang-format breaks code at this column, but leaves comments as they are.
TEST(Style, LinesAreAtMostOneHundredColumnsWide) {
  for (const SourceFile& file : FilesWithColumns()) {
    for (const int number : WideLines(file.text)) ADD_FAILURE() << file.path << ":" << number;
  }
}

// A margin is a named constant, with what it covers beside it.
TEST(Style, NoEpsilonOfTheCoreIsUnnamed) {
  for (const SourceFile& file : SourceFiles({".h", ".cc"})) {
    if (file.path.rfind("collision_core/", 0) != 0) continue;
    for (const int line : UnnamedEpsilons(file.text)) ADD_FAILURE() << file.path << ":" << line;
  }
}

TEST(Style, TheUnitRoundoffHasOneDefinition) {
  int definitions = 0;
  for (const SourceFile& file : SourceFiles({".h", ".cc"})) {
    if (file.path.rfind("collision_core/", 0) != 0) continue;
    std::istringstream lines(file.text);
    for (std::string line; std::getline(lines, line);) {
      if (!Finds("\\b0x1p-53\\b", CodeOf(line))) continue;
      EXPECT_EQ(file.path, "collision_core/numeric/allowances.h") << line;
      ++definitions;
    }
  }
  EXPECT_EQ(definitions, 1);
}

TEST(Style, NothingIsLeftOver) {
  ExpectNowhere(kLeftovers,
                SourceFiles({".h", ".cc", ".idl", ".proto", ".textproto", ".txt", ".md"}));
}

TEST(Style, NoFileNamesTheMachineItWasWrittenOn) {
  ExpectNowhere(kMachinePaths, SourceFiles({".h", ".cc", ".idl", ".proto", ".textproto", ".txt",
                                            ".md", ".xml", ".service"}));
}

TEST(Style, NoTestSleepsOrIsSwitchedOff) {
  std::vector<SourceFile> tests;
  for (SourceFile& file : SourceFiles({".h", ".cc"})) {
    if (file.path.rfind("tests/", 0) == 0) tests.push_back(std::move(file));
  }
  ASSERT_FALSE(tests.empty());
  ExpectNowhere(kWeakTests, tests);
}

}  // namespace
}  // namespace collision::source
