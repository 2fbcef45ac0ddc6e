// Goal:   the log says what was flown, to the last bit, in the form that the README states.
#include "client/simulators/motion_log.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <vector>

#include "client/shape.h"

namespace collision::client {
namespace {

class MotionLogTest : public testing::Test {
 protected:
  ~MotionLogTest() override { std::remove(path_.c_str()); }

  std::vector<std::string> Lines() const {
    std::ifstream file(path_);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  std::string path_ = testing::TempDir() + "motion_log_test_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name();
};

std::shared_ptr<const Shape> Tetrahedron(double size) {
  return Shape::Make({{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
                      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
}

TEST_F(MotionLogTest, WritesEveryRecord) {
  MotionLog log(path_);
  log.Agent("ball", 0.1);
  log.Piece("ball", {5, 7, {{{1, 2, 3, 4}, {0.1, 0, 0, 0}, {-1, 0, 0, 1e300}}}});
  log.Turn("ball", {5, 7, {0, 0, 0, 1}, {0.1, 0, 2}, {0, -0.5, 0}});
  log.Jump("ball", 7);
  log.Close();
  EXPECT_EQ(Lines(), (std::vector<std::string>{
                         "motion-log 2", "agent ball 0.10000000000000001",
                         "piece ball 5 7 1 2 3 4 0.10000000000000001 0 0 0 -1 0 0 "
                         "1.0000000000000001e+300",
                         "turn ball 5 7 0 0 0 1 0.10000000000000001 0 2 0 -0.5 0", "jump ball 7"}));
}

TEST_F(MotionLogTest, EqualShapesAreWrittenOnceBeforeTheirAgents) {
  MotionLog log(path_);
  log.Agent("ball", 2);
  log.Agent("a", 1, Tetrahedron(1));
  log.Agent("b", 1, Tetrahedron(1));
  log.Agent("c", 3, Tetrahedron(3));
  log.Close();
  const auto lines = Lines();
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[1], "agent ball 2");
  EXPECT_EQ(lines[2], "mesh mesh-1 4 4 0 0 0 1 0 0 0 1 0 0 0 1 0 2 1 0 1 3 0 3 2 1 2 3");
  EXPECT_EQ(lines[3], "agent a 1 mesh-1");
  EXPECT_EQ(lines[4], "agent b 1 mesh-1");
  EXPECT_EQ(lines[5].substr(0, 17), "mesh mesh-2 4 4 0");
  EXPECT_EQ(lines[6], "agent c 3 mesh-2");
}

TEST_F(MotionLogTest, NoPathNoFileAndABadPathIsNamed) {
  MotionLog log("");
  log.Agent("a", 1, Tetrahedron(1));
  log.Turn("a", {});
  EXPECT_NO_THROW(log.Close());
  EXPECT_THROW(MotionLog("no/such/folder/log"), std::runtime_error);
}

}  // namespace
}  // namespace collision::client
