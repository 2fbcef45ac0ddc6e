#include <assimp/scene.h>

#include <Eigen/Dense>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "client/library/validation.h"
#include "client/mesh/reader.h"

namespace collision::client {
namespace {

constexpr int kNodeDepthMax = 512;
/// Some formats have a vertex for each corner of each triangle, and vertices without a face.
constexpr std::size_t kVerticesMax = 4 * kShapeTrianglesMax;

const char* Ending(MeshFormat format) {
  switch (format) {
    case MeshFormat::kObj:
      return "obj";
    case MeshFormat::kStl:
      return "stl";
    case MeshFormat::kPly:
      return "ply";
    case MeshFormat::kGltf:
      return "gltf";
    case MeshFormat::kGlb:
      return "glb";
  }
  return "";
}

Eigen::Matrix4d MatrixOf(const aiMatrix4x4& m) {
  Eigen::Matrix4d matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return matrix;
}

/// Collects all meshes of the scene, each as often as the nodes name it.
class Collector {
 public:
  explicit Collector(const aiScene& scene) : scene_(scene) {}

  void Node(const aiNode& node, const Eigen::Matrix4d& parent, int depth) {
    if (depth > kNodeDepthMax) throw std::runtime_error("its nodes are nested too deeply");
    const Eigen::Matrix4d matrix = parent * MatrixOf(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) Mesh(*scene_.mMeshes[node.mMeshes[i]], matrix);
    for (unsigned i = 0; i < node.mNumChildren; ++i) Node(*node.mChildren[i], matrix, depth + 1);
  }

  FilePolygons Take() { return std::move(polygons_); }

 private:
  void Mesh(const aiMesh& mesh, const Eigen::Matrix4d& matrix) {
    const std::size_t first = polygons_.vertices.size();
    if (first + mesh.mNumVertices > kVerticesMax) {
      throw std::runtime_error("more than " + std::to_string(kVerticesMax) + " vertices");
    }
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& v = mesh.mVertices[i];
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
        throw std::runtime_error(
            "a vertex's coordinate is not a finite number (of a float's range)");
      }
      const Eigen::Vector4d p = matrix * Eigen::Vector4d(v.x, v.y, v.z, 1);
      polygons_.vertices.push_back({p.x(), p.y(), p.z()});
    }
    // A mirrored part has its outside on the other side.
    const bool mirrored = matrix.topLeftCorner<3, 3>().determinant() < 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) Face(mesh.mFaces[i], mesh, first, mirrored);
  }

  /// Skips points and lines.
  void Face(const aiFace& face, const aiMesh& mesh, std::size_t first, bool mirrored) {
    if (face.mNumIndices < 3) return;
    if (polygons_.sizes.size() == kShapeTrianglesMax) {
      throw std::runtime_error("more than " + std::to_string(kShapeTrianglesMax) + " faces");
    }
    for (unsigned i = 0; i < face.mNumIndices; ++i) {
      const unsigned index = face.mIndices[mirrored ? face.mNumIndices - 1 - i : i];
      if (index >= mesh.mNumVertices) {
        throw std::runtime_error("a face names vertex " + std::to_string(index) +
                                 ", allowed: 0 to " + std::to_string(mesh.mNumVertices) + " - 1");
      }
      polygons_.corners.push_back(static_cast<std::uint32_t>(first + index));
    }
    polygons_.sizes.push_back(face.mNumIndices);
  }

  const aiScene& scene_;
  FilePolygons polygons_;
};

/// Throws unless assimp found all that the file contains: it silently leaves out malformed parts.
void RequireAll(const aiScene& scene, const MeshScan& scan) {
  std::uint64_t faces = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    for (unsigned j = 0; j < mesh.mNumFaces; ++j) faces += mesh.mFaces[j].mNumIndices >= 3;
  }
  if (faces == scan.faces) return;
  throw std::runtime_error("only " + std::to_string(faces) + " of its " +
                           std::to_string(scan.faces) +
                           " faces can be read: an index is out of range, or it is malformed");
}

}  // namespace

bool ReaderSupported() { return true; }

FilePolygons ReadPolygons(const std::string& path, MeshFormat format, const std::string& text,
                          const MeshScan& scan) {
  Assimp::Importer importer;
  // No post-processing, which silently merges, drops and cuts. A glTF file may refer to other
  // files.
  const aiScene* const scene =
      format == MeshFormat::kGltf
          ? importer.ReadFile(path, 0)
          : importer.ReadFileFromMemory(text.data(), text.size(), 0, Ending(format));
  if (scene == nullptr || scene->mRootNode == nullptr) {
    // For example std::bad_alloc.
    if (const std::exception_ptr& cause = importer.GetException()) std::rethrow_exception(cause);
    throw std::runtime_error(importer.GetErrorString());
  }
  RequireAll(*scene, scan);
  Collector collector(*scene);
  collector.Node(*scene->mRootNode, Eigen::Matrix4d::Identity(), 0);
  return collector.Take();
}

}  // namespace collision::client
