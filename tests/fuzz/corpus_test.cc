// Goal:   no input that a fuzzer ever found interesting, and none that ever broke anything, breaks
//         anything in this build: every compiler, every sanitizer, without libFuzzer.
// Method: each file of corpus/TARGET and found/TARGET through the target's function.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/targets.h"

namespace collision::fuzz {
namespace {

constexpr std::uintmax_t kBytesMax = 4096;

std::vector<std::filesystem::path> FilesIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::uint8_t> ContentOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class Corpus : public testing::TestWithParam<Target> {
 protected:
  static void RunAll(const std::filesystem::path& folder) {
    for (const auto& path : FilesIn(folder)) {
      const std::vector<std::uint8_t> bytes = ContentOf(path);
      EXPECT_LE(bytes.size(), kBytesMax) << path;
      EXPECT_NO_THROW(GetParam().run(bytes)) << path;
    }
  }
  const std::filesystem::path root_ = COLLISION_FUZZ_DIR;
};

TEST_P(Corpus, BreaksNothing) {
  EXPECT_FALSE(FilesIn(root_ / "corpus" / GetParam().name).empty());
  RunAll(root_ / "corpus" / GetParam().name);
}

TEST_P(Corpus, WhatOnceBrokeSomethingDoesNotAnyMore) { RunAll(root_ / "found" / GetParam().name); }

TEST_P(Corpus, NothingAtAllIsAnInput) { EXPECT_NO_THROW(GetParam().run({})); }

INSTANTIATE_TEST_SUITE_P(Of, Corpus, testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace collision::fuzz
