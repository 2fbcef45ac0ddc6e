// Goal:   the log contains the motion flown, to the last bit, in the format of the README.
#include "client/programs/simulators/motion/motion_log.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <vector>

#include "collision/shape.h"

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
  log.Assembly("ball", "balls");
  log.Assembly("ball", "");
  log.Class("ball", "round");
  log.Class("ball", "");
  log.Margin("ball", 0.25);
  log.Margin("ball", 0);
  log.Piece("ball", {5, 7, {{{1, 2, 3, 4}, {0.1, 0, 0, 0}, {-1, 0, 0, 1e300}}}});
  log.Turn("ball", {5, 7, {0, 0, 0, 1}, {0.1, 0, 2}, {0, -0.5, 0}});
  log.Jump("ball", 7);
  log.Close();
  EXPECT_EQ(Lines(),
            (std::vector<std::string>{"motion-log 5", "agent ball 0.1", "assembly ball balls",
                                      "class ball round", "margin ball 0.25",
                                      "piece ball 5 7 1 2 3 4 0.1 0 0 0 -1 0 0 1e+300",
                                      "turn ball 5 7 0 0 0 1 0.1 0 2 0 -0.5 0", "jump ball 7"}));
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
  std::istringstream mesh(lines[2]);
  std::string kind, name;
  std::size_t vertices = 0, triangles = 0;
  mesh >> kind >> name >> vertices >> triangles;
  EXPECT_EQ(kind + " " + name, "mesh shape-1");
  ASSERT_EQ(vertices, 4u);
  ASSERT_EQ(triangles, 4u);
  Triangles read;
  read.vertices_m.resize(vertices);
  read.indices.resize(triangles);
  for (Vector3& vertex : read.vertices_m) mesh >> vertex[0] >> vertex[1] >> vertex[2];
  for (auto& triangle : read.indices) mesh >> triangle[0] >> triangle[1] >> triangle[2];
  EXPECT_TRUE(!mesh.fail() && mesh.eof());
  EXPECT_EQ(read.vertices_m, Tetrahedron(1)->triangles().vertices_m);
  EXPECT_EQ(read.indices, Tetrahedron(1)->triangles().indices);
  EXPECT_EQ(lines[3], "agent a 1 shape-1");
  EXPECT_EQ(lines[4], "agent b 1 shape-1");
  EXPECT_EQ(lines[5].substr(0, 18), "mesh shape-2 4 4 0");
  EXPECT_EQ(lines[6], "agent c 3 shape-2");
}

// Goal:   a shape with solids has one line for each solid, after the line of its triangles.
TEST_F(MotionLogTest, SolidsAreWrittenWithTheirDimensions) {
  const auto ball = Shape::Make({.solids = {Solid::Ball(0.5)}});
  const auto mixed = Shape::Make(
      {.triangles = Tetrahedron(1)->triangles(),
       .solids = {Solid::Capsule(0.1, 0.4).At({1, 2, 3}, {0, 0, 2, 0}),
                  Solid::Box({1, 2, 3}).Rounded(0.25), Solid::Hull({{1, 0, 0}, {0, 0, 2}})}});
  MotionLog log(path_);
  log.Agent("a", 0.5, ball);
  log.Agent("b", 9, mixed);
  log.Agent("c", 9,
            Shape::Make({.solids = {Solid::Ellipsoid({1, 2, 3}), Solid::Cylinder(1, 2),
                                    Solid::Cone(0.5, 1).Rounded(0.25)}}));
  log.Agent("floor", HalfSpace{{0, 0.6, 0.8}, -2});
  log.Close();
  const auto lines = Lines();
  ASSERT_GE(lines.size(), 8u);
  EXPECT_EQ(lines[1], "solid shape-1 ball 0.5 0 0 0 1 0 0 0");
  EXPECT_EQ(lines[2], "agent a 0.5 shape-1");
  EXPECT_EQ(lines[3].substr(0, 17), "mesh shape-2 4 4 ");
  EXPECT_EQ(lines[4], "solid shape-2 capsule 0.1 1 2 3 0 0 2 0 0.4");
  EXPECT_EQ(lines[5], "solid shape-2 box 0.25 0 0 0 1 0 0 0 1 2 3");
  EXPECT_EQ(lines[6], "solid shape-2 hull 0 0 0 0 1 0 0 0 2 1 0 0 0 0 2");
  EXPECT_EQ(lines[7], "agent b 9 shape-2");
  ASSERT_EQ(lines.size(), 13u);
  EXPECT_EQ(lines[8], "solid shape-3 ellipsoid 0 0 0 0 1 0 0 0 1 2 3");
  EXPECT_EQ(lines[9], "solid shape-3 cylinder 0 0 0 0 1 0 0 0 1 2");
  EXPECT_EQ(lines[10], "solid shape-3 cone 0.25 0 0 0 1 0 0 0 0.5 1");
  EXPECT_EQ(lines[12], "half-space floor 0 0.6 0.8 -2");
}

TEST_F(MotionLogTest, WithoutAPathNoFileAndABadPathIsReported) {
  MotionLog log("");
  log.Agent("a", 1, Tetrahedron(1));
  log.Turn("a", {});
  EXPECT_NO_THROW(log.Close());
  EXPECT_THROW(MotionLog("no/such/folder/log"), std::runtime_error);
}

}  // namespace
}  // namespace collision::client
