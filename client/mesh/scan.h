// Scans a mesh file's bytes before assimp reads them: assimp silently leaves out what is cut off or
// has an invalid index, and may read beyond the end.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace collision::client {

enum class MeshFormat { kObj, kStl, kPly, kGltf, kGlb };

/// What a complete and sound file contains; assimp must find as much.
struct MeshScan {
  std::uint64_t faces = 0;  ///< With three corners or more.
  std::uint64_t thin = 0;   ///< Faces with fewer corners: they have no area.
  /// OBJ: only its vertices and faces, for assimp, which fails at some other lines (a face of two
  /// corners after an odd material) and opens files that they name.
  std::string plain;
};

/// Each throws std::runtime_error with the cause and the line or byte: malformed, truncated, an
/// index out of range, no faces.
MeshScan ScanObj(std::string_view text);
MeshScan ScanStl(std::string_view text);
MeshScan ScanPly(std::string_view text);

/// `path` leads to the buffers in files beside it.
MeshScan ScanGltf(std::string_view text, const std::string& path);
MeshScan ScanGlb(std::string_view text, const std::string& path);

}  // namespace collision::client
