// Goal:   files are there whole or not at all, the folder stays within its bound, and files of
//         other programs stay as they are.
// Method: a folder of a few bytes, with files aged by hand.
#include "server/shapes/tree_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

namespace collision::server {
namespace {

namespace fs = std::filesystem;

class TreeFolderTest : public testing::Test {
 protected:
  TreeFolderTest() { fs::remove_all(path_); }
  ~TreeFolderTest() override { fs::remove_all(path_); }

  std::string File(const std::string& name) const { return path_ + "/" + name; }
  void MakeFile(const std::string& name, const std::string& bytes) const {
    fs::create_directories(path_);
    std::ofstream(File(name)) << bytes;
  }
  void Age(const std::string& name, int minutes) const {
    fs::last_write_time(File(name),
                        fs::file_time_type::clock::now() - std::chrono::minutes(minutes));
  }

  const std::string path_ = testing::TempDir() + "tree_folder_test/" +
                            testing::UnitTest::GetInstance()->current_test_info()->name();
  std::string fault_;
};

TEST_F(TreeFolderTest, ReadsWhatWasWritten) {
  TreeFolder folder(path_, 100);
  const std::string bytes("a\0\n\xff", 4);
  ASSERT_TRUE(folder.Write("x", bytes, &fault_)) << fault_;
  EXPECT_EQ(folder.Read("x", &fault_), bytes);
  EXPECT_EQ(folder.bytes(), 4u);
  EXPECT_EQ(TreeFolder(path_, 100).Read("x", &fault_), bytes);
}

TEST_F(TreeFolderTest, AMissingFileIsNoFault) {
  fault_ = "old";
  EXPECT_EQ(TreeFolder(path_, 100).Read("x", &fault_), std::nullopt);
  EXPECT_EQ(fault_, "");
}

TEST_F(TreeFolderTest, TheFileUsedLeastLatelyMakesRoom) {
  TreeFolder folder(path_, 10);
  ASSERT_TRUE(folder.Write("a", "1234", &fault_));
  ASSERT_TRUE(folder.Write("b", "1234", &fault_));
  Age("a.tree", 20);
  Age("b.tree", 10);
  ASSERT_TRUE(folder.Read("a", &fault_));  // now b is the one used least lately
  ASSERT_TRUE(folder.Write("c", "1234", &fault_));
  EXPECT_TRUE(folder.Read("a", &fault_));
  EXPECT_FALSE(folder.Read("b", &fault_));
  EXPECT_TRUE(folder.Read("c", &fault_));
  EXPECT_EQ(folder.removed(), 1u);
  EXPECT_EQ(folder.bytes(), 8u);
}

TEST_F(TreeFolderTest, AFolderThatIsExactlyFullLosesNothing) {
  TreeFolder folder(path_, 8);
  ASSERT_TRUE(folder.Write("a", "1234", &fault_));
  ASSERT_TRUE(folder.Write("b", "1234", &fault_));
  EXPECT_EQ(folder.removed(), 0u);
  EXPECT_EQ(folder.bytes(), 8u);
  EXPECT_TRUE(folder.Read("a", &fault_));
}

// Goal:   however small the files are, their number is bounded, and the least used go first.
TEST_F(TreeFolderTest, TheNumberOfFilesIsBounded) {
  MakeFile("old.tree", "1");
  MakeFile("older.tree", "1");
  Age("old.tree", 1);
  Age("older.tree", 2);
  TreeFolder folder(path_, 1000, 3);
  ASSERT_TRUE(folder.Write("a", "1", &fault_));
  EXPECT_EQ(folder.removed(), 0u);
  ASSERT_TRUE(folder.Write("a", "12", &fault_));
  EXPECT_EQ(folder.removed(), 0u) << "it replaces the one before";
  EXPECT_EQ(folder.bytes(), 4u);
  ASSERT_TRUE(folder.Read("older", &fault_)) << "used now";
  ASSERT_TRUE(folder.Write("b", "1", &fault_));
  EXPECT_FALSE(folder.Read("old", &fault_));
  EXPECT_TRUE(folder.Read("older", &fault_));
  EXPECT_EQ(folder.removed(), 1u);
}

// Goal:   the files of another process count, within so many writes.
TEST_F(TreeFolderTest, FilesOfOthersAreFound) {
  TreeFolder folder(path_, 1000, 2), other(path_, 1000, 2);
  ASSERT_TRUE(other.Write("b", "1", &fault_));
  ASSERT_TRUE(other.Write("c", "1", &fault_));
  for (std::uint64_t i = 0; i < kWritesPerListing; ++i) {
    ASSERT_TRUE(folder.Write("a", "1", &fault_));
  }
  EXPECT_EQ(folder.removed(), 1u);
  EXPECT_EQ(folder.bytes(), 2u);
}

TEST_F(TreeFolderTest, AFileOfTheWholeSizeFitsAndALargerOneDoesNot) {
  TreeFolder folder(path_, 4);
  EXPECT_TRUE(folder.Write("a", "1234", &fault_));
  EXPECT_EQ(folder.removed(), 0u);
  EXPECT_FALSE(folder.Write("b", "12345", &fault_));
  EXPECT_NE(fault_.find("allowed: up to 4"), std::string::npos) << fault_;
  EXPECT_TRUE(folder.Read("a", &fault_));
  MakeFile("c.tree", "12345");
  EXPECT_FALSE(folder.Read("c", &fault_));
  EXPECT_NE(fault_, "");
}

TEST_F(TreeFolderTest, OnlyItsOwnFilesAreCountedOrRemoved) {
  MakeFile("notes.txt", std::string(50, 'x'));
  MakeFile(".x.1.1.tree.aside", "left behind");
  MakeFile(".y.1.1.tree.aside", "being written");
  Age(".x.1.1.tree.aside", 61);
  Age(".y.1.1.tree.aside", 59);
  const TreeFolder folder(path_, 10);
  EXPECT_EQ(folder.bytes(), 0u);
  EXPECT_TRUE(fs::exists(File("notes.txt")));
  EXPECT_FALSE(fs::exists(File(".x.1.1.tree.aside")));
  EXPECT_TRUE(fs::exists(File(".y.1.1.tree.aside")));
}

TEST_F(TreeFolderTest, FollowsNoLinkAndReadsNoFolder) {
  MakeFile("secret", "s");
  fs::create_symlink(File("secret"), File("link.tree"));
  fs::create_directory(File("folder.tree"));
  const TreeFolder folder(path_, 100);
  for (const char* name : {"link", "folder"}) {
    EXPECT_EQ(folder.Read(name, &fault_), std::nullopt) << name;
    EXPECT_NE(fault_, "") << name;
  }
}

TEST_F(TreeFolderTest, APlaceThatIsNoFolderThrows) {
  MakeFile("file", "");
  EXPECT_THROW(TreeFolder(File("file"), 100), std::runtime_error);
}

}  // namespace
}  // namespace collision::server
