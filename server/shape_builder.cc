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
  if (!content->solids.empty()) {
    // Left out, they would be contacts that nobody hears of.
    *refusal =
        std::to_string(content->solids.size()) + " convex solids; allowed: 0, triangles only";
    return std::nullopt;
  }
  return MeshOf(*content);
}

/// Read or built: the same tree.
void GiveTree(const std::string& hash, TriangleMesh mesh, const BuildOptions& options,
              BuiltShape* built) {
  std::optional<SphereTree> cached;
  if (options.cache) cached = options.cache->Load(hash, mesh);
  built->from_cache = cached.has_value();
  if (cached) {
    built->shape = Shape::FromTree(std::move(mesh), std::move(*cached));
    return;
  }
  built->shape = Shape::Build(std::move(mesh), options.tree);
  if (options.cache) options.cache->Store(hash, built->shape->tree());
}

}  // namespace

BuildOptions BuildOptionsOf(const v1::Config& complete) {
  BuildOptions options{.triangles_max = complete.shape_triangles_max()};
  if (complete.tree_builder() == v1::Config::FITTED) options.tree.builder = TreeBuilder::kFitted;
  return options;
}

BuiltShape BuildShape(const std::string& hash, std::string bytes, const BuildOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  BuiltShape built;
  std::optional<TriangleMesh> mesh = Decode(std::move(bytes), &built.refusal);
  if (!mesh) return built;
  if (auto refusal = RefusalOf(*mesh, options.triangles_max)) {
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
  GiveTree(hash, std::move(*mesh), options, &built);
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
  BuiltShape built = BuildShape(hash, std::move(started.mapped()), options_);
  microseconds_ += static_cast<std::uint64_t>(built.microseconds);
  return built;
}

void InlineShapeBuilder::Forget(const std::string& hash) {
  started_.erase(hash);
  std::erase(finished_, hash);
}

ShapeBuilderCounters InlineShapeBuilder::counters() const {
  return {.building = started_.size(),
          .microseconds = microseconds_,
          .cache = options_.cache ? options_.cache->counters() : TreeCacheCounters{}};
}

}  // namespace collision::server
