#include <cmath>
#include <stdexcept>

#include "client/mesh/mesh_file.h"
#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "server/shapes/shape_builder.h"
#include "tests/fuzz/scratch_file.h"
#include "tests/fuzz/targets.h"

namespace collision::fuzz {
namespace {

constexpr const char* kNames[] = {"a.obj", "a.stl", "a.ply", "a.gltf", "a.glb"};
constexpr std::size_t kTrianglesBuilt = 64;

/// What the client makes of a file, the service takes: the same bytes, a body within the radius.
void CheckTaken(const client::Shape& shape) {
  Require(std::isfinite(shape.radius_m()) && shape.radius_m() > 0, "radius ", shape.radius_m());
  if (shape.triangles().indices.size() > kTrianglesBuilt) return;
  const server::BuiltShape built =
      server::BuildShape(shape.hash(), shape.bytes(), {.triangles_max = kTrianglesBuilt});
  Require(built.shape != nullptr, "the service refuses what the client made: ", built.refusal);
  Require(built.dropped == 0, "the client left degenerate triangles");
  Require(built.shape->facts().radius <= shape.radius_m() * (1 + 1e-9), "reaches as far as ",
          built.shape->facts().radius, ", reported as ", shape.radius_m());
  Require(built.shape->closed() == shape.closed(), "closed to one only");
}

}  // namespace

void FuzzMeshFile(Bytes bytes) {
  if (bytes.empty() || !client::MeshFilesSupported()) return;
  const ScratchFile file(kNames[bytes[0] % std::size(kNames)], bytes.subspan(1));
  client::MeshFileReport report;
  std::shared_ptr<const client::Shape> shape;
  try {
    shape = client::LoadShape(file.path(), {.unit_m = 1, .up = client::UpAxis::kY}, &report);
  } catch (const std::runtime_error& error) {
    Require(std::string(error.what()).find(file.path()) != std::string::npos,
            "an error that does not name its file: ", error.what());
    return;
  }
  Require(report.triangles == shape->triangles().indices.size(),
          "triangles told: ", report.triangles);
  CheckTaken(*shape);
}

}  // namespace collision::fuzz
