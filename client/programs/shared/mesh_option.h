// The options that give a simulator's agents a mesh, convex solids, or both.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "client/mesh/mesh_file.h"

namespace collision::client {

struct MeshOptions {
  std::string file;  ///< Empty: no triangles.
  MeshFileOptions frame;
  std::string solids;  ///< A file (idl/solids.proto); empty: none. Neither: the agents are balls.
};

/// Adds --mesh FILE, --mesh-unit METRES and --mesh-up x|y|z (both required with --mesh),
/// --mesh-centre and --solids FILE.
void AddMeshOptions(CLI::App* app, MeshOptions* options);

/// Adds --mesh-unit, --mesh-up and --mesh-centre alone.
void AddMeshFrameOptions(CLI::App* app, MeshFileOptions* options);

/// The same for a program that has no use without a mesh: unit and up-axis are required.
void AddRequiredMeshFrameOptions(CLI::App* app, MeshFileOptions* options);

/// The mesh of --mesh and the solids of --solids as one shape; null without either. Prints what was
/// read, unless `quiet`. Throws BadInput with the file's name where LoadShape(), ReadSolids() or
/// Shape::Make() throws.
std::shared_ptr<const Shape> LoadAgentShape(const MeshOptions& options, bool quiet = false);

}  // namespace collision::client
