#include "server/shape_builder.h"

#include <chrono>
#include <optional>
#include <stdexcept>
#include <utility>

#include "idl/shape_bytes.h"

namespace collision::server {
namespace {

TriangleMesh MeshOf(const ShapeContent& content) {
  TriangleMesh mesh;
  mesh.vertices.reserve(content.vertices.size());
  for (const auto& [x, y, z] : content.vertices) mesh.vertices.emplace_back(x, y, z);
  mesh.triangles.assign(content.triangles.begin(), content.triangles.end());
  return mesh;
}

/// The mesh, or why there is none. What it was made from is gone afterwards: shapes are large.
std::optional<TriangleMesh> Decode(std::string bytes, std::string* refusal) {
  const std::optional<ShapeContent> content = DecodeShape(bytes, refusal);
  if (!content) return std::nullopt;
  return MeshOf(*content);
}

}  // namespace

BuiltShape BuildShape(std::string bytes, std::size_t triangles_max) {
  const auto start = std::chrono::steady_clock::now();
  BuiltShape built;
  std::optional<TriangleMesh> mesh = Decode(std::move(bytes), &built.refusal);
  if (!mesh) return built;
  if (auto refusal = RefusalOf(*mesh, triangles_max)) {
    built.refusal = std::move(*refusal);
    return built;
  }
  const std::size_t triangles = mesh->triangles.size();
  built.dropped = DropDegenerate(&*mesh);
  if (mesh->triangles.empty()) {
    built.refusal = "all of its " + std::to_string(triangles) +
                    " triangles are degenerate; at least 1 with an area is needed";
    return built;
  }
  built.shape = Shape::Build(std::move(*mesh));
  built.microseconds = std::chrono::duration_cast<std::chrono::microseconds>(
                           std::chrono::steady_clock::now() - start)
                           .count();
  return built;
}

void InlineShapeBuilder::Start(const std::string& hash, std::string bytes) {
  started_[hash] = std::move(bytes);
  finished_.push_back(hash);
}

std::vector<std::string> InlineShapeBuilder::TakeFinished() { return std::exchange(finished_, {}); }

BuiltShape InlineShapeBuilder::Await(const std::string& hash) {
  auto started = started_.extract(hash);
  if (started.empty()) throw std::logic_error("a shape is awaited that was not started");
  std::erase(finished_, hash);
  BuiltShape built = BuildShape(std::move(started.mapped()), triangles_max_);
  microseconds_ += static_cast<std::uint64_t>(built.microseconds);
  return built;
}

void InlineShapeBuilder::Forget(const std::string& hash) {
  started_.erase(hash);
  std::erase(finished_, hash);
}

ShapeBuilderCounters InlineShapeBuilder::counters() const {
  return {.building = started_.size(), .microseconds = microseconds_};
}

}  // namespace collision::server
