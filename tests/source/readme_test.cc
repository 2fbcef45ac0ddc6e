// Goal:   what the README shows is what is there.
// Method: its simulator is compiled as client/example; the two texts must agree line by line.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "tests/source/source_tree.h"

namespace collision::source {
namespace {

constexpr const char* kExample = "client/example/ten_lines.cc";

/// The first block of `language` after the first mention of `mark`.
std::string CodeBlockAfter(const std::string& text, const std::string& mark,
                           const std::string& language) {
  const std::string fence = "```" + language + "\n";
  const auto fence_at = text.find(fence, std::min(text.find(mark), text.size()));
  if (fence_at == std::string::npos) return "";
  const auto begin = fence_at + fence.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

TEST(Readme, SimulatorIsTheExampleThatIsCompiled) {
  const std::string block = CodeBlockAfter(ReadFile("README.md"), kExample, "cpp");
  ASSERT_FALSE(block.empty()) << "README.md shows no block of C++ after naming " << kExample;
  EXPECT_EQ(block, ReadFile(kExample));
}

TEST(Readme, FilesItNamesExist) {
  const std::string readme = ReadFile("README.md");
  const std::regex link(R"(\]\(([A-Za-z0-9_./-]+)\))");
  int links = 0;
  for (std::sregex_iterator it(readme.begin(), readme.end(), link), end; it != end; ++it, ++links) {
    EXPECT_NO_THROW(ReadFile((*it)[1])) << (*it)[1];
  }
  EXPECT_GT(links, 0);
}

TEST(Readme, PagesOfTheClientLinkToFilesThatExist) {
  const std::regex link(R"(\]\(([A-Za-z0-9_./-]+)\))");
  int links = 0;
  for (const SourceFile& page : SourceFiles({".md"})) {
    if (page.path.rfind("client/", 0) != 0) continue;
    const std::filesystem::path folder = std::filesystem::path(page.path).parent_path();
    for (std::sregex_iterator it(page.text.begin(), page.text.end(), link), end; it != end; ++it) {
      const std::string path = (folder / (*it)[1].str()).lexically_normal().generic_string();
      EXPECT_NO_THROW(ReadFile(path)) << page.path << ": " << path;
      ++links;
    }
  }
  EXPECT_GT(links, 5);
}

}  // namespace
}  // namespace collision::source
