// Shapes from mesh files: OBJ, STL, PLY, glTF, read by assimp where it is installed.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "collision/shape.h"

namespace collision::client {

enum class UpAxis { kX, kY, kZ };

/// Maximum size of a mesh file in bytes; five million triangles as text take about half of it.
inline constexpr std::size_t kMeshFileBytesMax = std::size_t{1} << 30;

/// The cause in an error about a mesh that does not fit into the memory.
inline constexpr const char* kNoMemoryText = "not enough memory for this mesh";

/// What a file does not say reliably: the caller states it, the library never guesses. That holds
/// for glTF as well, which is metres and y up by definition: unit 1, UpAxis::kY.
struct MeshFileOptions {
  double unit_m = 0;  ///< One unit of the file in metres, > 0; required.
  /// The file's axis that is the body's +z; the others follow cyclically. Required.
  std::optional<UpAxis> up = {};
  Vector3 reference_m{};  ///< The reference point in the body's axes, after scaling.
  bool centre = false;    ///< The reference point is the centre of the mesh's box instead.
};

/// What was read and repaired, for people.
struct MeshFileReport {
  std::size_t faces = 0;      ///< In the file.
  std::size_t split = 0;      ///< Faces with more than three corners, cut into triangles.
  std::size_t dropped = 0;    ///< Degenerate faces.
  std::size_t triangles = 0;  ///< Of the shape.
  bool closed = false;
  double radius_m = 0;
  /// "ship.obj: 620 triangles (12 faces split, 0 degenerate faces dropped), closed, radius 8.31 m"
  std::string Text(const std::string& path) const;
};

/// Whether mesh files can be read in this build.
bool MeshFilesSupported();

/// Reads all faces of a file, as its nodes place them. The ending of the name tells the format:
/// obj, stl, ply, gltf, glb. Coordinates have the 24 bits of a float, as assimp holds them. Skins,
/// morphs and animations are not applied; points and lines are left out. An OBJ file has no end
/// mark: one that is cut off between two faces is a smaller mesh (most likely an open one: see the
/// report). `report` may be null.
///
/// Throws std::invalid_argument for options, and std::runtime_error with the file's name and the
/// cause: no such file, unknown format, truncated or malformed, no triangles, not finite, an index
/// out of range, too many triangles, too large or small in the stated unit, not enough memory.
std::shared_ptr<const Shape> LoadShape(const std::string& path, const MeshFileOptions& options,
                                       MeshFileReport* report);

}  // namespace collision::client
