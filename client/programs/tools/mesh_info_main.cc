// mesh-info: tells whether a mesh file is fit to be an agent's shape.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "client/mesh/mesh_file.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/mesh_option.h"

namespace collision::client {
namespace {

constexpr const char* kFooter = R"(
Examples:
  mesh-info ship.obj --mesh-unit 1 --mesh-up z          metres, z upwards
  mesh-info part.stl --mesh-unit 0.001 --mesh-up z      millimetres
  mesh-info drone.glb --mesh-unit 1 --mesh-up y         glTF is metres and y upwards by definition

An open surface has no inside: only crossing triangles are a contact.
Exit codes: 0 fit, 2 usage, 65 the mesh is refused (the reason is printed).)";

void Print(const Shape& shape) {
  Vector3 lower = shape.triangles().vertices_m.front(), upper = lower;
  for (const Vector3& p : shape.triangles().vertices_m) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], p[i]);
      upper[i] = std::max(upper[i], p[i]);
    }
  }
  for (int i = 0; i < 3; ++i) std::printf("%c %.6g to %.6g m\n", "xyz"[i], lower[i], upper[i]);
  std::printf("%zu vertices, travels as %zu bytes\nhash %s\n", shape.triangles().vertices_m.size(),
              shape.bytes().size(), HexText(shape.hash()).c_str());
}

int Main(int argc, char** argv) {
  CLI::App app("Reads a mesh file as the simulators do, and prints the resulting shape.",
               "mesh-info");
  std::string file;
  MeshFileOptions options;
  app.add_option("file", file, "OBJ, STL, PLY, glTF or GLB")->required();
  AddRequiredMeshFrameOptions(&app, &options);
  app.footer(kFooter);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  try {
    MeshFileReport report;
    const auto shape = LoadShape(file, options, &report);
    std::printf("%s\n", report.Text(file).c_str());
    Print(*shape);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mesh-info: %s\n", error.what());
    return kExitBadData;
  }
}

}  // namespace
}  // namespace collision::client

int main(int argc, char** argv) { return collision::client::Main(argc, argv); }
