// Goal:   a text of solids becomes its shape, with its mesh if it has one; an error names file,
//         place and cause.
// Method: files written here; the scene's own.
#include "client/programs/shared/solid_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "client/programs/shared/command_line.h"
#include "client/programs/shared/mesh_option.h"
#include "collision/shape.h"

namespace collision::client {
namespace {

class SolidFileTest : public testing::Test {
 protected:
  ~SolidFileTest() override { std::remove(path_.c_str()); }

  std::string Write(const std::string& text) const {
    std::ofstream(path_) << text;
    return path_;
  }

  std::string Error(const std::string& text) const {
    try {
      LoadAgentShape({.file = {}, .frame = {}, .solids = Write(text)}, true);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "no error";
  }

  std::string path_ = testing::TempDir() + "solid_file_test_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(SolidFileTest, ReadsEachKind) {
  const auto solids = ReadSolids(Write(R"(
      solids { ball { radius_m: 2 } rounding_m: 1 }
      solids { capsule { radius_m: 1 half_length_m: 3 } position_m { x: 4 y: 5 z: 6 } }
      solids { box { half_extents_m { x: 1 y: 2 z: 3 } } orientation { x: 1 } }
      solids { ellipsoid { half_axes_m { x: 1 y: 2 z: 3 } } }
      solids { hull { points_m { x: 1 } points_m { y: 2 } } rounding_m: 0.5 })"));
  ASSERT_EQ(solids.size(), 5u);
  EXPECT_EQ(solids[0].kind, Solid::Kind::kBall);
  EXPECT_EQ(solids[0].rounding_m, 3);
  EXPECT_EQ(solids[1].half_extents_m, (Vector3{0, 0, 3}));
  EXPECT_EQ(solids[1].position_m, (Vector3{4, 5, 6}));
  EXPECT_EQ(solids[1].orientation, (Quaternion{1, 0, 0, 0}));
  EXPECT_EQ(solids[2].half_extents_m, (Vector3{1, 2, 3}));
  EXPECT_EQ(solids[2].orientation, (Quaternion{0, 1, 0, 0}));
  EXPECT_EQ(solids[3].kind, Solid::Kind::kEllipsoid);
  EXPECT_EQ(solids[4].points_m, (std::vector<Vector3>{{1, 0, 0}, {0, 2, 0}}));
}

TEST_F(SolidFileTest, AnErrorNamesPlaceAndCause) {
  EXPECT_EQ(Error("solids {\n ball { radius_cm: 2 } }").rfind(path_ + ":2:", 0), 0u)
      << Error("solids {\n ball { radius_cm: 2 } }");
  EXPECT_EQ(Error(""), path_ + ": solids: 0, allowed: 1 or more");
  EXPECT_EQ(
      Error("solids { ball { radius_m: 1 } } solids { rounding_m: 1 }"),
      path_ +
          ": solids[1]: core: missing, allowed: ball, capsule, box, ellipsoid, cylinder, cone "
          "or hull");
  EXPECT_EQ(Error("solids { ball { radius_m: -1 } }"),
            path_ + ": solids[0] (ball): radius_m: -1, allowed: 0 to 1e+07 m");
  std::remove(path_.c_str());
  EXPECT_THROW(ReadSolids(path_), BadInput);
}

TEST_F(SolidFileTest, ALengthThatIsMissingOrOutOfRangeIsNamedAsInTheFile) {
  const std::string range = ", allowed: 0 to 1e+07 m";
  const auto error = [this](const std::string& second) {
    return Error("solids { ball { radius_m: 1 } } solids { " + second + " }").substr(path_.size());
  };
  EXPECT_EQ(error("ball {}"), ": solids[1] (ball): radius_m: missing" + range);
  EXPECT_EQ(error("capsule { radius_m: 1 }"),
            ": solids[1] (capsule): half_length_m: missing" + range);
  EXPECT_EQ(error("cone { radius_m: 1 half_length_m: nan }"),
            ": solids[1] (cone): half_length_m: nan" + range);
  EXPECT_EQ(error("cylinder { half_length_m: 1 }"),
            ": solids[1] (cylinder): radius_m: missing" + range);
  EXPECT_EQ(error("box { half_extents_m { x: 1 z: 1 } }"),
            ": solids[1] (box): half_extents_m.y: missing" + range);
  EXPECT_EQ(error("ellipsoid {}"), ": solids[1] (ellipsoid): half_axes_m.x: missing" + range);
  EXPECT_EQ(error("ellipsoid { half_axes_m { x: 1 y: 1 z: 2e7 } }"),
            ": solids[1] (ellipsoid): half_axes_m.z: 2e+07" + range);
  EXPECT_EQ(error("ball { radius_m: 2 } rounding_m: -1"),
            ": solids[1] (ball): rounding_m: -1.000000" + range);
  EXPECT_EQ(Error("solids { box { half_extents_m { x: 1 y: 0 z: 1 } } }"), "no error");
}

TEST_F(SolidFileTest, TheScenesDroneHasItsDeclaredRadius) {
  const std::string scenes = COLLISION_SCENES_DIR;
  const auto shape =
      LoadAgentShape({.file = {}, .frame = {}, .solids = scenes + "/drone-arms.txtpb"}, true);
  EXPECT_EQ(shape->solids().size(), 10u);
  const double reach = std::sqrt(2 * 0.45 * 0.45 + 0.03 * 0.03) + 0.13;
  EXPECT_GE(shape->radius_m(), reach * (1 - 1e-12));
  EXPECT_LE(shape->radius_m(), reach * (1 + 1e-9));
  const auto both = LoadAgentShape({.file = scenes + "/drone-ship.obj",
                                    .frame = {.unit_m = 1, .up = UpAxis::kZ},
                                    .solids = scenes + "/drone-arms.txtpb"},
                                   true);
  EXPECT_EQ(both->solids().size(), 10u);
  EXPECT_GT(both->triangles().indices.size(), 0u);
  EXPECT_EQ(LoadAgentShape({}, true), nullptr);
}

}  // namespace
}  // namespace collision::client
