// Goal:   real meshes load, and their facts are right.
// Method: all meshes of the data set; closed or open as its README says, faces as the files have.
#include <gtest/gtest.h>

#include <fstream>

#include "client/mesh/mesh_file.h"

namespace collision::client {
namespace {

struct Expected {
  const char* name;
  std::size_t triangles;
  std::size_t split;
  bool closed;
};

TEST(MeshData, MeshesLoadAsTheReadmeDescribes) {
  ASSERT_TRUE(MeshFilesSupported());
  for (const Expected& expected : {Expected{"cow", 5804, 0, true},
                                   {"fandisk", 12946, 0, true},
                                   {"homer", 12000, 0, true},
                                   {"rocker-arm", 20088, 0, true},
                                   {"spot", 5856, 0, true},
                                   {"stanford-bunny", 69451, 0, false},
                                   {"suzanne", 968, 468, false},
                                   {"teapot", 6320, 0, false},
                                   {"woody", 1267, 0, false}}) {
    const std::string path = std::string(COLLISION_DATA_DIR "/meshes/") + expected.name + ".obj";
    MeshFileReport report;
    const auto shape = LoadShape(path, {.unit_m = 0.01, .up = UpAxis::kY, .centre = true}, &report);
    EXPECT_EQ(report.triangles + report.dropped, expected.triangles) << expected.name;
    EXPECT_EQ(report.split, expected.split) << expected.name;
    EXPECT_EQ(shape->closed(), expected.closed) << expected.name;
    std::ifstream file(path);
    std::size_t faces = 0;
    for (std::string line; std::getline(file, line);) faces += line.rfind("f ", 0) == 0;
    EXPECT_EQ(report.faces, faces) << expected.name;
  }
}

}  // namespace
}  // namespace collision::client
