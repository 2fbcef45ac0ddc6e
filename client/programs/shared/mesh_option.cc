#include "client/programs/shared/mesh_option.h"

#include <cstdio>
#include <utility>

#include "client/programs/shared/command_line.h"
#include "client/programs/shared/solid_file.h"

namespace collision::client {
namespace {

constexpr double kUnitMax = 1e12;  ///< [m]

/// Null without --mesh.
std::shared_ptr<const Shape> LoadMesh(const MeshOptions& options, bool quiet) {
  if (options.file.empty()) return nullptr;
  MeshFileReport report;
  std::shared_ptr<const Shape> shape;
  try {
    shape = LoadShape(options.file, options.frame, &report);
  } catch (const std::exception& error) {
    throw BadInput(error.what());
  }
  if (quiet) return shape;
  std::printf("%s\n", report.Text(options.file).c_str());
  std::fflush(stdout);
  return shape;
}

}  // namespace

void AddMeshFrameOptions(CLI::App* app, MeshFileOptions* options) {
  app->add_option("--mesh-unit", options->unit_m, "One unit of the mesh file in metres")
      ->check(Finite(kUnitMax, false));
  const auto set = [options](const std::string& axis) {
    options->up = axis == "x" ? UpAxis::kX : axis == "y" ? UpAxis::kY : UpAxis::kZ;
  };
  app->add_option_function<std::string>("--mesh-up", set, "The file's axis that points up")
      ->check(OneOf({"x", "y", "z"}));
  app->add_flag("--mesh-centre", options->centre,
                "The reference point is the centre of the mesh's box, not the file's origin");
}

void AddRequiredMeshFrameOptions(CLI::App* app, MeshFileOptions* options) {
  AddMeshFrameOptions(app, options);
  for (const char* name : {"--mesh-unit", "--mesh-up"}) app->get_option(name)->required();
}

void AddMeshOptions(CLI::App* app, MeshOptions* options) {
  auto* mesh =
      app->add_option("--mesh", options->file, "Shape of the agents: OBJ, STL, PLY, glTF or GLB");
  AddMeshFrameOptions(app, &options->frame);
  app->add_option(
      "--solids", options->solids,
      "Convex solids, part of the shape beside --mesh: protobuf text (idl/solids.proto)");
  mesh->needs("--mesh-unit");
  mesh->needs("--mesh-up");
  for (const char* name : {"--mesh-unit", "--mesh-up", "--mesh-centre"}) {
    app->get_option(name)->needs(mesh);
  }
}

std::shared_ptr<const Shape> LoadAgentShape(const MeshOptions& options, bool quiet) {
  const auto mesh = LoadMesh(options, quiet);
  if (options.solids.empty()) return mesh;
  Geometry geometry;
  if (mesh) geometry.triangles = mesh->triangles();
  geometry.solids = ReadSolids(options.solids);
  std::shared_ptr<const Shape> shape;
  try {
    shape = Shape::Make(std::move(geometry));
  } catch (const std::exception& error) {
    throw BadInput(options.solids + ": " + error.what());
  }
  if (quiet) return shape;
  std::printf("%s: %zu convex solids, radius with them %.3g m\n", options.solids.c_str(),
              shape->solids().size(), shape->radius_m());
  std::fflush(stdout);
  return shape;
}

}  // namespace collision::client
