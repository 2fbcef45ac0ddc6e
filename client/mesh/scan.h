// A look at a mesh file's bytes before the library reads them: the library leaves out in silence what
// is cut off or points to nowhere, or reads beyond the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace collision::client {

enum class MeshFormat { kObj, kStl, kPly, kGltf, kGlb };

/// What a whole and sound file holds; the library must find as much.
struct MeshScan {
  std::uint64_t faces = 0;  ///< With three corners or more.
  std::uint64_t thin = 0;   ///< Faces with fewer: they have no area.
  /// OBJ: its vertices and faces alone, for the library. It falls over other lines (a face of two
  /// corners after an odd material) and opens files that they name.
  std::string plain;
};

/// Each throws std::runtime_error with the cause, the line or the byte: malformed, cut off, an index
/// out of range, no faces.
MeshScan ScanObj(std::string_view text);
MeshScan ScanStl(std::string_view text);
MeshScan ScanPly(std::string_view text);

/// `path` leads to the buffers in files beside it.
MeshScan ScanGltf(std::string_view text, const std::string& path);
MeshScan ScanGlb(std::string_view text, const std::string& path);

}  // namespace collision::client
