#include "server/shapes/tree_cache.h"

#include <google/protobuf/stubs/logging.h>
#include <spdlog/fmt/fmt.h>

#include <utility>

#include "collision_core/shape/shape.h"
#include "collision_core/sphere_tree/tree_check.h"
#include "idl/sha256.h"
#include "idl/tree_message.h"
#include "server/process/logging.h"

namespace collision::server {
namespace {

constexpr std::uint32_t kTreeFormat = 1;

/// How much of the recipe's hash a file's name holds. Two recipes share a name only if their first
/// 64 bits are equal; the file then says which recipe it is.
constexpr std::size_t kRecipeBytesInName = 8;

constexpr std::uint32_t kProbeCells =
    12;  ///< Along an edge of the mesh that distinguishes builders.

std::string HexText(std::string_view bytes) {
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

std::string Checksum(const std::string& content_hash, const std::string& recipe_bytes,
                     const std::string& tree) {
  Sha256Hasher hasher;
  hasher.Add(content_hash);
  hasher.Add(recipe_bytes);
  hasher.Add(tree);
  return hasher.Digest();
}

/// Closed, bumpy, uneven, with a sharp rim: something of everything that builders look at. Only
/// products and sums, so that it is the same everywhere.
geometry::TriangleMesh Probe() {
  geometry::TriangleMesh mesh;
  constexpr std::uint32_t n = kProbeCells;
  for (const double side : {-1.0, 1.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (std::uint32_t i = 0; i <= n; ++i) {
        const double x = 2.0 * i / n - 1, y = 1.5 * j / n - 0.75;
        const double rim = (1 - x * x) * (0.5625 - y * y);
        mesh.vertices.emplace_back(x, y, side * rim * (1 + 0.5 * side * x * y + 0.25 * y));
      }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = first + j * (n + 1) + i, b = a + n + 1;
        geometry::Triangle lower = {a, a + 1, b + 1}, upper = {a, b + 1, b};
        if (side < 0) std::swap(lower[1], lower[2]), std::swap(upper[1], upper[2]);
        mesh.triangles.push_back(lower);
        mesh.triangles.push_back(upper);
      }
    }
  }
  DropDegenerate(&mesh);
  return mesh;
}

}  // namespace

std::string BuilderFingerprint(const sphere_tree::ShapeOptions& options) {
  return Sha256(ToMessage(shape::Shape::Build(Probe(), options)->tree()).SerializeAsString());
}

TreeCache::TreeCache(const std::string& folder, std::uint64_t bytes_max,
                     const sphere_tree::ShapeOptions& options)
    : recipe_(RecipeOf(options)), folder_(folder, bytes_max) {
  recipe_.set_builder_fingerprint(BuilderFingerprint(options));
  recipe_bytes_ = recipe_.SerializeAsString();
  counters_.removed = folder_.removed();
  counters_.bytes = folder_.bytes();
}

std::string TreeCache::NameOf(const std::string& content_hash) const {
  const std::string recipe = Sha256(std::to_string(kTreeFormat) + recipe_bytes_);
  return HexText(content_hash) + "-" + HexText(recipe.substr(0, kRecipeBytesInName));
}

std::optional<sphere_tree::SphereTree> TreeCache::Load(const std::string& content_hash,
                                                       const geometry::TriangleMesh& mesh) {
  const std::string name = NameOf(content_hash);
  const std::lock_guard lock(folder_mutex_);
  std::string fault;
  std::optional<sphere_tree::SphereTree> tree;
  const std::optional<std::string> bytes = folder_.Read(name, &fault);
  if (bytes) tree = Read(*bytes, content_hash, mesh, &fault);
  if (tree) {
    Count(&TreeCacheCounters::hits);
  } else if (fault.empty()) {
    Count(&TreeCacheCounters::misses);
  } else {
    Count(&TreeCacheCounters::discarded);
    Log(spdlog::level::warn, "tree cache",
        fmt::format("{}/{}.tree: {}; the tree is built anew", folder_.path(), name, fault));
  }
  return tree;
}

std::optional<sphere_tree::SphereTree> TreeCache::Read(const std::string& bytes,
                                                       const std::string& content_hash,
                                                       const geometry::TriangleMesh& mesh,
                                                       std::string* fault) const {
  const google::protobuf::LogSilencer silent;  // *fault reports it.
  v1::TreeFile file;
  if (!file.ParseFromString(bytes)) {
    *fault = "cut off, or not a tree file";
  } else if (file.format() != kTreeFormat) {
    *fault = fmt::format("format {}; allowed: {}", file.format(), kTreeFormat);
  } else if (file.content_hash() != content_hash) {
    *fault = "it holds the tree of another shape";
  } else if (file.recipe().SerializeAsString() != recipe_bytes_) {
    *fault = "another builder or other options made it";
  } else if (file.checksum() != Checksum(content_hash, recipe_bytes_, file.tree())) {
    *fault = "damaged: wrong checksum";
  } else {
    v1::SphereTree message;
    std::optional<sphere_tree::SphereTree> tree;
    if (message.ParseFromString(file.tree())) tree = FromMessage(message);
    const auto refusal = tree ? RefusalOf(*tree, mesh) : std::optional<std::string>("not a tree");
    if (!refusal) return tree;
    *fault = "damaged: " + *refusal;
  }
  return std::nullopt;
}

void TreeCache::Store(const std::string& content_hash, const sphere_tree::SphereTree& tree) {
  v1::TreeFile file;
  file.set_format(kTreeFormat);
  file.set_content_hash(content_hash);
  *file.mutable_recipe() = recipe_;
  file.set_tree(ToMessage(tree).SerializeAsString());
  file.set_checksum(Checksum(content_hash, recipe_bytes_, file.tree()));
  const std::string name = NameOf(content_hash);
  const std::string bytes = file.SerializeAsString();
  const std::lock_guard lock(folder_mutex_);
  std::string fault;
  const bool is_stored = folder_.Write(name, bytes, &fault);
  Count(is_stored ? &TreeCacheCounters::stored : &TreeCacheCounters::failed);
  if (is_stored) return;
  Log(spdlog::level::warn, "tree cache",
      fmt::format("{}/{}.tree: {}; the tree is not kept", folder_.path(), name, fault));
}

void TreeCache::Count(std::uint64_t TreeCacheCounters::*counter) {
  const std::lock_guard lock(counters_mutex_);
  ++(counters_.*counter);
  counters_.removed = folder_.removed();
  counters_.bytes = folder_.bytes();
}

TreeCacheCounters TreeCache::counters() const {
  const std::lock_guard lock(counters_mutex_);
  return counters_;
}

}  // namespace collision::server
