#include "client/mesh/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <utility>

#include "client/library/validation.h"
#include "client/mesh/reader.h"
#include "client/mesh/scan.h"
#include "collision_core/geometry/mesh/triangle_mesh.h"

namespace collision::client {
namespace {

std::string NumberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// Rounds up to four digits, so that the printed radius is large enough as an option.
double RoundedUp(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 3);
  return std::ceil(value / unit) * unit;
}

void RequireOptions(const MeshFileOptions& options) {
  if (!(options.unit_m > 0) || !std::isfinite(options.unit_m)) {
    throw std::invalid_argument("unit_m: " + NumberText(options.unit_m) +
                                ", allowed: a finite number > 0, one unit of the file in metres");
  }
  if (!options.up) {
    throw std::invalid_argument(
        "up: not stated, allowed: the file's axis x, y or z that points up");
  }
  for (const double value : options.reference_m) {
    if (std::abs(value) <= kRadiusMax) continue;
    throw std::invalid_argument("reference_m: " + NumberText(value) + ", allowed: within " +
                                NumberText(kRadiusMax));
  }
}

MeshFormat FormatOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".obj") return MeshFormat::kObj;
  if (ending == ".stl") return MeshFormat::kStl;
  if (ending == ".ply") return MeshFormat::kPly;
  if (ending == ".gltf") return MeshFormat::kGltf;
  if (ending == ".glb") return MeshFormat::kGlb;
  throw std::runtime_error("format \"" + ending +
                           "\" is unknown, allowed: .obj, .stl, .ply, .gltf, .glb");
}

std::string Contents(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw std::runtime_error("no such file");
  const auto size = std::filesystem::file_size(path, error);
  if (!error && size > kMeshFileBytesMax) {
    throw std::runtime_error(std::to_string(size) + " bytes, allowed: up to " +
                             std::to_string(kMeshFileBytesMax));
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(error ? 0 : size, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (error || !file) throw std::runtime_error("cannot be read");
  if (text.empty()) throw std::runtime_error("the file is empty");
  return text;
}

MeshScan Scan(const std::string& text, MeshFormat format, const std::string& path) {
  switch (format) {
    case MeshFormat::kObj:
      return ScanObj(text);
    case MeshFormat::kStl:
      return ScanStl(text);
    case MeshFormat::kPly:
      return ScanPly(text);
    case MeshFormat::kGltf:
      return ScanGltf(text, path);
    case MeshFormat::kGlb:
      return ScanGlb(text, path);
  }
  return {};
}

/// A cyclic permutation of the axes is a rotation, so nothing is mirrored.
Vector3 InBodyAxes(const Vector3& p, UpAxis up) {
  switch (up) {
    case UpAxis::kX:
      return {p[1], p[2], p[0]};
    case UpAxis::kY:
      return {p[2], p[0], p[1]};
    case UpAxis::kZ:
      break;
  }
  return p;
}

Vector3 BoxCentre(const FilePolygons& polygons) {
  Vector3 lower = polygons.vertices[polygons.corners.front()], upper = lower;
  for (const std::uint32_t corner : polygons.corners) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], polygons.vertices[corner][i]);
      upper[i] = std::max(upper[i], polygons.vertices[corner][i]);
    }
  }
  return {(lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, (lower[2] + upper[2]) / 2};
}

geometry::PolygonMesh InBodyFrame(FilePolygons polygons, const MeshFileOptions& options) {
  for (Vector3& p : polygons.vertices) {
    p = InBodyAxes(p, *options.up);
    for (double& x : p) x *= options.unit_m;
  }
  const Vector3 origin = options.centre ? BoxCentre(polygons) : options.reference_m;
  geometry::PolygonMesh mesh;
  mesh.vertices.reserve(polygons.vertices.size());
  for (const Vector3& p : polygons.vertices) {
    mesh.vertices.emplace_back(p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]);
  }
  mesh.corners = std::move(polygons.corners);
  mesh.sizes = std::move(polygons.sizes);
  return mesh;
}

std::shared_ptr<const Shape> MakeShape(const geometry::PolygonMesh& polygons,
                                       MeshFileReport* report) {
  if (const auto refusal = RefusalOf(polygons, kShapeTrianglesMax)) {
    throw std::runtime_error(*refusal);
  }
  geometry::MeshRepair repair;
  const geometry::TriangleMesh mesh = Triangulate(polygons, &repair);
  if (mesh.triangles.empty()) {
    throw std::runtime_error("all " + std::to_string(report->dropped + repair.dropped) +
                             " faces are degenerate: none has an area");
  }
  Triangles triangles;
  for (const auto& v : mesh.vertices) triangles.vertices_m.push_back({v.x(), v.y(), v.z()});
  triangles.indices = mesh.triangles;
  auto shape = Shape::Make(std::move(triangles));
  report->split = repair.split;
  report->dropped += repair.dropped + shape->dropped();
  report->triangles = shape->triangles().indices.size();
  report->closed = shape->closed();
  report->radius_m = shape->radius_m();
  return shape;
}

std::shared_ptr<const Shape> Load(const std::string& path, const MeshFileOptions& options,
                                  MeshFileReport* report) {
  const MeshFormat format = FormatOf(path);
  std::string text = Contents(path);
  const MeshScan scan = Scan(text, format, path);
  if (format == MeshFormat::kObj) text = scan.plain;
  FilePolygons polygons = ReadPolygons(path, format, text, scan);
  if (polygons.sizes.empty()) throw std::runtime_error("no faces in its scene");
  report->faces = polygons.sizes.size() + scan.thin;
  report->dropped = scan.thin;
  return MakeShape(InBodyFrame(std::move(polygons), options), report);
}

}  // namespace

std::string MeshFileReport::Text(const std::string& path) const {
  return path + ": " + std::to_string(triangles) + " triangles (" + std::to_string(split) +
         " faces split, " + std::to_string(dropped) + " degenerate faces dropped), " +
         (closed ? "closed" : "open: a surface without inside") + ", radius " +
         NumberText(RoundedUp(radius_m)) + " m";
}

bool MeshFilesSupported() { return ReaderSupported(); }

std::shared_ptr<const Shape> LoadShape(const std::string& path, const MeshFileOptions& options,
                                       MeshFileReport* report) {
  RequireOptions(options);
  MeshFileReport read;
  try {
    auto shape = Load(path, options, &read);
    if (report != nullptr) *report = read;
    return shape;
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(path + ": " + kNoMemoryText);
  } catch (const std::length_error&) {
    throw std::runtime_error(path + ": " + kNoMemoryText);
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace collision::client
