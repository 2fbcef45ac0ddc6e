// Queries to a whole surface, answered through its tree.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/numeric/interval.h"
#include "collision_core/sphere_tree/sphere_tree.h"

namespace collision::sphere_tree {

/// Answers queries about one surface through its tree. The mesh and the tree must outlive it. Not
/// for use by several threads at once: it keeps its buffers.
///
/// Distance. Best first through the tree. A triangle that a bound in plain doubles puts beyond the
/// best one is skipped, others get an interval. The upper end is the distance to a point of the
/// triangle that is given by weights, in intervals. The lower end holds for any direction n: the
/// triangle lies behind the plane perpendicular to n through its foremost corner. So n need not be
/// exact; three choices of n make the bound tight: towards the nearest point, along the triangle's
/// normal, and perpendicular to an edge.
///
/// Winding number. A ray leaves the point along +x or −x, towards the nearer end of the surface.
/// Each triangle that it crosses counts +1 where the ray leaves the solid and −1 where it enters.
/// Three exact orientation signs in the yz-plane decide whether it crosses. Where one of them is
/// zero, the point is perturbed symbolically, by an infinitesimal along +y and a smaller one along
/// +z: the winding number is constant near a point off the surface, and the perturbed ray meets no
/// edge. One exact orientation sign in space decides whether the crossing lies ahead.
class SurfaceQuery {
 public:
  SurfaceQuery(const geometry::TriangleMesh& mesh, const SphereTree& tree)
      : mesh_(mesh), tree_(tree) {}

  /// The distance of a point to the surface, certified: best first through the tree.
  /// `known_upper`: an upper bound of it, if one is known.
  numeric::Interval DistanceTo(const Eigen::Vector3d& point, double known_upper);

  /// The winding number of a closed surface about a point: exact. nullopt if the point lies on the
  /// surface, or so near to the rim of a triangle that its distance is not certainly positive, or
  /// where tiny coordinates (below about 1e-95) underflow.
  std::optional<int> WindingNumberAt(const Eigen::Vector3d& point);

  /// Nodes and triangles examined so far, in all queries.
  std::uint64_t work() const { return work_; }

 private:
  struct Candidate {
    double lower;
    NodeIndex node;
    bool operator<(const Candidate& other) const { return lower > other.lower; }
  };

  void TryLeaf(const SphereNode& leaf, const Eigen::Vector3d& point, numeric::Interval* best);

  /// Size of a direct-mapped cache of the triangles that a query has measured. An evicted triangle
  /// is measured again; a look-up costs the same however many there are.
  static constexpr std::size_t kCacheSize = 256;

  const geometry::TriangleMesh& mesh_;
  const SphereTree& tree_;
  std::vector<Candidate> heap_;
  std::uint64_t work_ = 0;
  std::array<ElementIndex, kCacheSize> measured_;
  std::vector<std::pair<ElementIndex, int>> passed_;  ///< By the ray: triangles, with their signs.
  std::vector<NodeIndex> stack_;
};

}  // namespace collision::sphere_tree
