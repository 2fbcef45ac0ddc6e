// collisionctl sphere-tree: how well the sphere tree of a mesh fits it. It needs no service.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "client/mesh/mesh_file.h"

namespace collision::client {

struct SphereTreeOptions {
  std::string mesh;
  MeshFileOptions frame;
  std::string builder = "fitted";
  std::uint32_t levels = 13;
  std::string report;  ///< Empty: text, unless something is exported to standard output.
  std::string format;  ///< Of the export; empty: none.
  std::string output;  ///< Of the export; empty: standard output.
  std::string picture;
  std::optional<std::uint32_t> level;  ///< Of picture and export.
};

/// Adds the subcommand. `options` outlives `app`.
CLI::App* AddSphereTreeCommand(CLI::App* app, SphereTreeOptions* options);

/// Returns the exit code; errors are printed on standard error.
int RunSphereTree(const SphereTreeOptions& options);

}  // namespace collision::client
