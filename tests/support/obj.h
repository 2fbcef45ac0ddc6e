// A minimal reader of Wavefront OBJ for tests: vertices and faces, nothing else.
#pragma once

#include <fstream>
#include <sstream>
#include <string>

#include "collision_core/geometry/mesh/triangle_mesh.h"

namespace collision {

/// No faces if the file cannot be read. A corner is "7", "7/1/3" or, from the end, "-1".
inline geometry::PolygonMesh ReadObj(const std::string& path) {
  geometry::PolygonMesh mesh;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Eigen::Vector3d p;
      words >> p.x() >> p.y() >> p.z();
      mesh.vertices.push_back(p);
    } else if (word == "f") {
      mesh.sizes.push_back(0);
      while (words >> word) {
        const int index = std::stoi(word);
        const auto vertices = static_cast<int>(mesh.vertices.size());
        mesh.corners.push_back(
            static_cast<std::uint32_t>(index < 0 ? vertices + index : index - 1));
        ++mesh.sizes.back();
      }
    }
  }
  return mesh;
}

}  // namespace collision
