// Sphere trees on disk: building a large one takes a minute, reading it a second.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/sphere_tree.h"
#include "collision_core/sphere_tree/tree_options.h"
#include "idl/sphere_tree.pb.h"
#include "server/shapes/tree_folder.h"
#include "server/shapes/tree_store.h"

namespace collision::server {

/// A folder with one file per shape and recipe (TreeFile of idl/sphere_tree.proto), named after
/// both.
///
/// The recipe is the builder, its options, and a hash of what this builder makes of a fixed mesh,
/// so that another version of the builder, or arithmetic that differs, never uses these files. A
/// file is used if format, hash and recipe are the ones wanted, the checksum is right, and the tree
/// has the structure of a tree of this mesh (collision_core/sphere_tree/tree_check.h). Any other
/// file is counted, logged, built anew and replaced: it costs the time to build and nothing else.
///
/// The distances in a tree are trusted, since proving them again costs as much as building. The
/// checksum guards against accidents, only the permissions of the folder against attackers.
///
/// Several processes may share a folder: files appear whole (written aside, renamed) and are
/// replaced only by their like. The size of the folder is bounded (`tree_cache_mb`); the files used
/// least lately are removed first. Trouble with the disk after the start costs only the time to
/// build.
class TreeCache final : public TreeStore {
 public:
  /// Makes the folder if it is missing, and removes files until it fits `bytes_max`. Throws
  /// std::runtime_error, with the folder and the cause, if it cannot be made or read.
  TreeCache(const std::string& folder, std::uint64_t bytes_max,
            const sphere_tree::ShapeOptions& options);

  std::optional<sphere_tree::SphereTree> Load(const std::string& content_hash,
                                              const geometry::TriangleMesh& mesh) override;
  void Store(const std::string& content_hash, const sphere_tree::SphereTree& tree) override;
  TreeCacheCounters counters() const override;

 private:
  std::string NameOf(const std::string& content_hash) const;
  std::optional<sphere_tree::SphereTree> Read(const std::string& bytes,
                                              const std::string& content_hash,
                                              const geometry::TriangleMesh& mesh,
                                              std::string* fault) const;
  /// Also takes over the numbers of the folder. Requires that the caller holds folder_mutex_.
  void Count(std::uint64_t TreeCacheCounters::*counter);

  v1::TreeRecipe recipe_;
  std::string recipe_bytes_;
  std::mutex folder_mutex_;
  TreeFolder folder_;  ///< Guarded by it.
  mutable std::mutex counters_mutex_;
  TreeCacheCounters counters_;  ///< Guarded by it, so that counters() need not wait for the disk.
};

/// A hash of what a builder makes of a fixed mesh. Takes some milliseconds.
std::string BuilderFingerprint(const sphere_tree::ShapeOptions& options);

}  // namespace collision::server
