// Goal:   what the README shows is what is there.
// Method: its simulator is compiled as client/examples; the two texts must agree line by line.
#include <gtest/gtest.h>

#include "tests/source/source_tree.h"

namespace collision::source {
namespace {

constexpr const char* kExample = "client/examples/cpp/ten_lines.cc";

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

}  // namespace
}  // namespace collision::source
