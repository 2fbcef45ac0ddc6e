// Goal:   a recording gets its name, and moves former ones on, only when the service works.
#include "server/service/program/recording_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "server/config/config.h"

namespace collision::server {
namespace {

class RecordingFileTest : public testing::Test {
 protected:
  RecordingFileTest() {
    std::filesystem::create_directories(folder_);
    std::ofstream(file_) << "former";
  }
  ~RecordingFileTest() override { std::filesystem::remove_all(folder_); }

  bool IsThere(const std::string& after) const { return std::filesystem::exists(file_ + after); }

  std::string FirstLineOf(const std::string& after) const {
    std::string line;
    std::getline(std::ifstream(file_ + after), line);
    return line;
  }

  const std::string folder_ = testing::TempDir() + "recording_file." + std::to_string(getpid());
  const std::string file_ = folder_ + "/run.rec";
};

TEST_F(RecordingFileTest, ReplacesNothingUntilItIsKept) {
  {
    const RecordingFile recording(file_);
    EXPECT_NE(recording.Open(CompleteConfig({}), {}), nullptr);
    EXPECT_TRUE(IsThere(".new"));
  }
  EXPECT_FALSE(IsThere(".new") || IsThere(".1"));
  EXPECT_EQ(FirstLineOf(""), "former");
  {
    RecordingFile recording(file_);
    const auto writer = recording.Open(CompleteConfig({}), {});
    recording.Keep();
  }
  EXPECT_FALSE(IsThere(".new"));
  EXPECT_EQ(FirstLineOf(".1"), "former");
  EXPECT_EQ(RecordingReader(file_).config().agents_max(), CompleteConfig({}).agents_max());
}

TEST_F(RecordingFileTest, IsCalledByItsName) {
  try {
    RecordingFile(folder_ + "/none/run.rec").Open(CompleteConfig({}), {});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              folder_ + "/none/run.rec: cannot be written: No such file or directory");
  }
  EXPECT_EQ(RecordingFile("").Open(CompleteConfig({}), {}), nullptr);
}

}  // namespace
}  // namespace collision::server
