// Meshes from files: OBJ, STL, PLY, glTF, through assimp where it is installed.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client/shape.h"

namespace collision::client {

enum class UpAxis { kX, kY, kZ };

/// Bytes of a mesh file; five million triangles as text take about half of it.
inline constexpr std::size_t kMeshFileBytesMax = std::size_t{1} << 30;

/// What is said of a mesh that is too large to be held, or for what is to be made of it.
inline constexpr const char* kNoMemoryText = "not enough memory for this mesh";

/// What a file does not say, or says in a way nobody reads: stated, never guessed. That holds for
/// glTF as well, which is metres and y up by definition: unit 1, UpAxis::kY.
struct MeshFileOptions {
  double unit_m = 0;  ///< One unit of the file in metres, > 0; required.
  /// The file's axis that is the body's +z; the others follow cyclically. Required.
  std::optional<UpAxis> up = {};
  Vector3 reference_m{};  ///< The reference point in the body's axes, after scaling.
  bool centre = false;    ///< The reference point is the centre of the mesh's box instead.
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

/// Reads all faces of a file, as its nodes place them. The ending says the format: obj, stl, ply,
/// gltf, glb. Coordinates have the 24 bits of a float, as the library holds them. Skins, morphs and
/// animations are not applied; points and lines are left out. A text that is cut off between two faces
/// is a smaller mesh, in an OBJ file (open, most likely: see the report).
/// Throws std::invalid_argument (options), std::runtime_error with the file's name and the cause: no
/// such file, format unknown, truncated or malformed, no triangles, not finite, an index out of
/// range, too many, too large or small for the unit stated, not enough memory.
std::shared_ptr<const Shape> LoadShape(const std::string& path, const MeshFileOptions& options,
                                       MeshFileReport* report);

}  // namespace collision::client
