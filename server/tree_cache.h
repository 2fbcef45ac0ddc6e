// Sphere trees that were built before, on disk: building a large one takes a minute, reading it a
// second.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/sphere_tree.h"
#include "collision_core/sphere_tree/tree_options.h"
#include "idl/sphere_tree.pb.h"
#include "server/tree_folder.h"

namespace collision::server {

struct TreeCacheCounters {
  std::uint64_t hits = 0;       ///< Trees that were read, not built.
  std::uint64_t misses = 0;     ///< Trees that were not there.
  std::uint64_t discarded = 0;  ///< Files that were there and are not what their name says.
  std::uint64_t stored = 0;
  std::uint64_t failed = 0;   ///< Trees that could not be stored.
  std::uint64_t removed = 0;  ///< Files, to make room.
  std::uint64_t bytes = 0;    ///< Of all its files, when it was last looked.
};

/// A folder with one file (TreeFile of idl/sphere_tree.proto) per shape and recipe, named after both.
/// Whatever else a file holds, cut off, damaged, of another format, another shape or another
/// builder, is counted, told in the log, built anew and replaced; no file can do more harm than cost
/// the time to build. What a tree says of distances cannot be proved again for less than building
/// it: there the file is believed if its SHA-256 is right. That guards against accidents; against
/// people who may write into the folder only its permissions do.
///
/// Several processes may share a folder: files appear whole (written aside, renamed) and are only
/// replaced by their like. The folder's size is bounded; what was used least lately goes first.
///
/// All functions are for any thread.
class TreeCache {
 public:
  /// Makes the folder if need be, and makes it fit `bytes_max`. Throws std::runtime_error, with the
  /// folder and the cause, if there can be none.
  TreeCache(const std::string& folder, std::uint64_t bytes_max,
            const sphere_tree::ShapeOptions& options);

  /// The tree that these options make of this mesh, which is what the bytes of that hash describe;
  /// nullopt: it is to be built.
  std::optional<sphere_tree::SphereTree> Load(const std::string& content_hash,
                                              const geometry::TriangleMesh& mesh);

  /// Keeps a tree for Load(). It never fails: what cannot be kept is counted and told.
  void Store(const std::string& content_hash, const sphere_tree::SphereTree& tree);

  TreeCacheCounters counters() const;

 private:
  std::string NameOf(const std::string& content_hash) const;
  std::optional<sphere_tree::SphereTree> Read(const std::string& bytes,
                                              const std::string& content_hash,
                                              const geometry::TriangleMesh& mesh,
                                              std::string* fault) const;
  /// With the folder's own numbers. The caller holds the folder.
  void Count(std::uint64_t TreeCacheCounters::*counter);

  v1::TreeRecipe recipe_;
  std::string recipe_bytes_;
  std::mutex folder_mutex_;
  TreeFolder folder_;  ///< Guarded by it.
  mutable std::mutex counters_mutex_;
  TreeCacheCounters counters_;  ///< Guarded by it: who counts need not wait for the disk.
};

/// What a builder makes of a fixed mesh, as a hash. Takes some milliseconds.
std::string BuilderFingerprint(const sphere_tree::ShapeOptions& options);

}  // namespace collision::server
