// A mesh's sphere tree as the service would build it, and how well its balls fit.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "client/mesh/mesh_file.h"
#include "collision_core/shape/shape.h"
#include "idl/sphere_tree.pb.h"

namespace collision::client {

/// Number of levels of a tree, the root's included.
inline constexpr std::uint32_t kTreeLevelsMin = 1;
inline constexpr std::uint32_t kTreeLevelsMax = 24;

struct MeshTree {
  std::string file;
  MeshFileReport read;  ///< What was read and repaired.
  std::string content_hash;
  sphere_tree::ShapeOptions options;
  std::shared_ptr<const collision::shape::Shape> shape;
  double build_seconds = 0;

  const sphere_tree::SphereTree& tree() const { return shape->tree(); }
  /// Of the box [m].
  double diagonal() const { return (shape->facts().upper - shape->facts().lower).norm(); }
};

/// Reads the mesh and builds its tree. On a terminal it prints on standard error how long it has
/// been building, from the second second on. Throws what LoadShape() throws.
MeshTree BuildMeshTree(const std::string& file, const MeshFileOptions& frame,
                       const sphere_tree::ShapeOptions& options);

/// "octree" or "fitted".
const char* BuilderName(sphere_tree::TreeBuilder builder);

/// Every level, and the cuts of at most 8, 64 and 512 balls, with what building took.
v1::TreeReport ReportOf(const MeshTree& mesh_tree);

/// The report for people.
std::string ReportText(const MeshTree& mesh_tree, const v1::TreeReport& report);

/// The last level of no more than `balls_max` balls.
std::uint32_t LevelWithin(const sphere_tree::SphereTree& tree, std::size_t balls_max);

}  // namespace collision::client
