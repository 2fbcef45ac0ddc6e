// The options with which a simulator flies a mesh.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "client/mesh_file.h"

namespace collision::client {

struct MeshOptions {
  std::string file;  ///< Empty: the agents are balls.
  MeshFileOptions frame;
};

/// Adds --mesh FILE, --mesh-unit METRES and --mesh-up x|y|z (both required with --mesh) and --mesh-centre.
void AddMeshOptions(CLI::App* app, MeshOptions* options);

/// Unit, up-axis and centre alone, under these names.
void AddMeshFrameOptions(CLI::App* app, const std::string& unit, const std::string& up,
                         const std::string& centre, MeshFileOptions* options);

/// The mesh of --mesh, null without one; prints what was read, unless `quiet`. Throws
/// BadInput, with the file's name, where LoadShape() throws.
std::shared_ptr<const Shape> LoadMesh(const MeshOptions& options, bool quiet = false);

}  // namespace collision::client
