// What is in a mesh file, read by a library, before anything is made of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "client/mesh/scan.h"
#include "client/types.h"

namespace collision::client {

/// Faces with any number of corners, in the file's unit and axes. Nothing is merged, cut or dropped.
struct FilePolygons {
  std::vector<Vector3> vertices;
  std::vector<std::uint32_t> corners;  ///< Of all faces, one after the other.
  std::vector<std::uint32_t> sizes;    ///< Corners of each face, >= 3.
};

/// Whether there is such a library in this build.
bool ReaderSupported();

/// Reads all faces of a file, whose bytes are `text` and in which a scan found `scan`; meshes that
/// its nodes place several times come several times. Throws std::runtime_error with the cause.
FilePolygons ReadPolygons(const std::string& path, MeshFormat format, const std::string& text,
                          const MeshScan& scan);

}  // namespace collision::client
