// Goal:   the meshes of the scenes are what the service is shown off with: closed, not convex, no
//         face through another, as large and as fine as promised.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "client/mesh/mesh_file.h"
#include "client/programs/simulators/motion/rigid_motion.h"
#include "collision/shape.h"

namespace collision::client {
namespace {

struct Face {
  std::array<Vector3, 3> corners;
  std::array<std::uint32_t, 3> indices;
};

std::shared_ptr<const Shape> Load(const std::string& name) {
  MeshFileOptions options;
  options.unit_m = 1;
  options.up = UpAxis::kZ;
  MeshFileReport report;
  auto shape = LoadShape(std::string(COLLISION_SCENES_DIR) + "/" + name, options, &report);
  EXPECT_EQ(report.dropped, 0u);
  EXPECT_EQ(report.triangles, shape->triangles().indices.size());
  return shape;
}

std::vector<Face> FacesOf(const Shape& shape) {
  std::vector<Face> faces;
  // Corners at one place are one corner, whatever the reader made of them.
  std::map<Vector3, std::uint32_t> places;
  for (const auto& triangle : shape.triangles().indices) {
    Face face;
    for (int i = 0; i < 3; ++i) {
      face.corners[i] = shape.triangles().vertices_m[triangle[i]];
      face.indices[i] =
          places.emplace(face.corners[i], static_cast<std::uint32_t>(places.size())).first->second;
    }
    faces.push_back(face);
  }
  return faces;
}

// Six times the volume of the tetrahedron.
double Volume6(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return Dot(Difference(b, a), Cross(Difference(c, a), Difference(d, a)));
}

bool SharesCorner(const Face& face, std::uint32_t a, std::uint32_t b) {
  return std::count(face.indices.begin(), face.indices.end(), a) > 0 ||
         std::count(face.indices.begin(), face.indices.end(), b) > 0;
}

bool Pierces(const Vector3& a, const Vector3& b, const Face& face) {
  const auto& [p, q, r] = face.corners;
  if (Volume6(a, p, q, r) * Volume6(b, p, q, r) >= 0) return false;
  const double u = Volume6(a, b, p, q), v = Volume6(a, b, q, r), w = Volume6(a, b, r, p);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

void ExpectNoFaceThroughAnother(const std::vector<Face>& faces) {
  for (const Face& face : faces) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      for (const Face& other : faces) {
        if (SharesCorner(other, face.indices[i], face.indices[j])) continue;
        ASSERT_FALSE(Pierces(face.corners[i], face.corners[j], other));
      }
    }
  }
}

// How far a vertex lies outside of a face's plane; 0 for a convex solid.
double GreatestConcavity(const std::vector<Face>& faces) {
  double greatest = 0;
  for (const Face& face : faces) {
    const Vector3 across = Cross(Difference(face.corners[1], face.corners[0]),
                                 Difference(face.corners[2], face.corners[0]));
    for (const Face& other : faces) {
      for (const Vector3& corner : other.corners) {
        greatest =
            std::max(greatest, Dot(across, Difference(corner, face.corners[0])) / Norm(across));
      }
    }
  }
  return greatest;
}

double Volume(const std::vector<Face>& faces) {
  double sum = 0;
  for (const auto& [corners, indices] : faces) {
    sum += Dot(corners[0], Cross(corners[1], corners[2])) / 6;
  }
  return sum;
}

double Length(const Shape& shape, int axis) {
  double least = 1e9, greatest = -1e9;
  for (const Vector3& vertex : shape.triangles().vertices_m) {
    least = std::min(least, vertex[axis]);
    greatest = std::max(greatest, vertex[axis]);
  }
  return greatest - least;
}

TEST(SceneMeshes, SpaceshipIsClosedAndOfItsSize) {
  if (!MeshFilesSupported()) return;
  const auto shape = Load("spaceship.obj");
  const auto faces = FacesOf(*shape);
  EXPECT_TRUE(shape->closed());
  EXPECT_GE(faces.size(), 500u);
  EXPECT_NEAR(Length(*shape, 0), 8, 0.5);
  EXPECT_LE(shape->radius_m(), 5);
  EXPECT_GT(Volume(faces), 10) << "seen from outside its faces are anticlockwise";
  EXPECT_GT(GreatestConcavity(faces), 1);
  ExpectNoFaceThroughAnother(faces);
}

TEST(SceneMeshes, DroneShipIsClosedAndOfItsSize) {
  if (!MeshFilesSupported()) return;
  const auto shape = Load("drone-ship.obj");
  const auto faces = FacesOf(*shape);
  EXPECT_TRUE(shape->closed());
  EXPECT_GE(faces.size(), 100u);
  EXPECT_NEAR(Length(*shape, 0), 2, 0.1);
  EXPECT_LE(shape->radius_m(), 1.4);
  EXPECT_GT(Volume(faces), 0.3);
  EXPECT_GT(GreatestConcavity(faces), 0.3);
  ExpectNoFaceThroughAnother(faces);
}

}  // namespace
}  // namespace collision::client
