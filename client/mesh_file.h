// Meshes from files: OBJ, STL, PLY, glTF, through assimp where it is installed.
#pragma once

#include <memory>
#include <string>

#include "client/shape.h"

namespace collision::client {

enum class UpAxis { kX, kY, kZ };

/// What a file does not say, or says in a way nobody reads: stated, never guessed.
struct MeshFileOptions {
  double unit_m = 0;       ///< One unit of the file in metres, > 0; required.
  UpAxis up = UpAxis::kZ;  ///< The file's axis that is the body's +z; the others follow cyclically.
  Vector3 reference_m{};   ///< The reference point in the body's axes, after scaling.
};

/// What was read, for people.
struct MeshFileReport {
  std::size_t faces = 0;      ///< In the file.
  std::size_t split = 0;      ///< With more than three corners, cut into triangles.
  std::size_t dropped = 0;    ///< Degenerate.
  std::size_t triangles = 0;  ///< Of the shape.
  bool closed = false;
  double radius_m = 0;
  /// "ship.obj: 620 triangles (12 faces split, 0 degenerate faces dropped), closed, radius 8.31 m"
  std::string Text(const std::string& path) const;
};

/// Whether mesh files can be read in this build.
bool MeshFilesSupported();

/// Throws std::invalid_argument (options), std::runtime_error with the file's name and the cause: no
/// such file, format unknown, truncated or malformed, no triangles, not finite, an index out of
/// range, too many, too large or small for the unit stated.
std::shared_ptr<const Shape> LoadShape(const std::string& path, const MeshFileOptions& options,
                                       MeshFileReport* report);

}  // namespace collision::client
