// Where sphere trees are kept that were built before.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/sphere_tree.h"

namespace collision::server {

struct TreeCacheCounters {
  std::uint64_t hits = 0;       ///< Trees that were read, not built.
  std::uint64_t misses = 0;     ///< Trees that were not there.
  std::uint64_t discarded = 0;  ///< Files that are not what their name says.
  std::uint64_t stored = 0;
  std::uint64_t failed = 0;   ///< Trees that could not be stored.
  std::uint64_t removed = 0;  ///< Files, to make room.
  std::uint64_t bytes = 0;    ///< Of all files, when they were counted last.
};

/// Keeps the trees that one builder makes with one set of options. Implementation: the TreeCache, a
/// folder on disk. All functions may be called from any thread.
class TreeStore {
 public:
  virtual ~TreeStore() = default;

  /// The tree of this mesh, which is what the bytes of that hash describe; nullopt: it has to be
  /// built.
  virtual std::optional<sphere_tree::SphereTree> Load(const std::string& content_hash,
                                                      const geometry::TriangleMesh& mesh) = 0;

  /// Keeps a tree for Load(). It does not throw: what cannot be kept is counted and logged.
  virtual void Store(const std::string& content_hash, const sphere_tree::SphereTree& tree) = 0;

  virtual TreeCacheCounters counters() const = 0;
};

}  // namespace collision::server
