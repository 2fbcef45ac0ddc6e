// The polygons of a mesh file, as a library reads them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/mesh/scan.h"
#include "collision/types.h"

namespace collision::client {

/// Faces with any number of corners, in the file's unit and axes. Nothing is merged, cut or
/// dropped.
struct FilePolygons {
  std::vector<Vector3> vertices;
  std::vector<std::uint32_t> corners;  ///< Of all faces, one after the other.
  std::vector<std::uint32_t> sizes;    ///< Corners of each face, >= 3.
};

/// Whether this build has such a library.
bool ReaderSupported();

/// Reads all faces of a file whose bytes are `text` and whose scan is `scan`; a mesh that its nodes
/// place several times appears several times. Throws std::runtime_error with the cause.
FilePolygons ReadPolygons(const std::string& path, MeshFormat format, const std::string& text,
                          const MeshScan& scan);

}  // namespace collision::client
