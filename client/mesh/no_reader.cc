#include <stdexcept>

#include "client/mesh/reader.h"

namespace collision::client {

bool ReaderSupported() { return false; }

FilePolygons ReadPolygons(const std::string&, MeshFormat, const std::string&, const MeshScan&) {
  throw std::runtime_error("this build reads no mesh files: assimp was not found");
}

}  // namespace collision::client
