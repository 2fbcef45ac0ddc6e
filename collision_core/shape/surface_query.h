// Questions to a whole surface, answered through its tree.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "collision_core/numeric/interval.h"
#include "collision_core/shape/sphere_tree.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

/// Asks one surface. Not for several threads at once: it keeps its buffers. The mesh and the tree
/// must outlive it.
class SurfaceQuery {
 public:
  SurfaceQuery(const TriangleMesh& mesh, const SphereTree& tree) : mesh_(mesh), tree_(tree) {}

  /// The distance of a point to the surface, certified: best first through the tree.
  /// `known_upper`: an upper bound of it, if one is known.
  Interval DistanceTo(const Eigen::Vector3d& point, double known_upper);

  /// The winding number of a closed surface about a point: exact, or nullopt if the point lies on
  /// the surface or too near to tell.
  ///
  /// Counts the triangles, with their signs, that a ray from the point along ±x passes. In the plane
  /// across, "passes" is three exact orientation signs. Where one is zero, the ray is moved by
  /// infinitely little along +y, and by infinitely less along +z: the winding number is constant
  /// about a point that is not on the surface, and so every triangle may be asked about the same
  /// moved ray, which meets no edge.
  std::optional<int> WindingNumberAt(const Eigen::Vector3d& point);

  /// Nodes and triangles looked at so far, in all questions.
  std::uint64_t work() const { return work_; }

 private:
  struct Candidate {
    double lower;
    std::uint32_t node;
    bool operator<(const Candidate& other) const { return lower > other.lower; }
  };

  void TryLeaf(const SphereNode& leaf, const Eigen::Vector3d& point, Interval* best);

  /// Places for the triangles that a question measured. A later one takes an earlier one's place, and
  /// a triangle that lost its place is measured again: so a look costs the same however many there are.
  static constexpr std::size_t kPlaces = 256;
  static constexpr std::uint32_t kNone = 0xffffffff;

  const TriangleMesh& mesh_;
  const SphereTree& tree_;
  std::vector<Candidate> heap_;
  std::uint64_t work_ = 0;
  std::array<std::uint32_t, kPlaces> measured_;
  std::vector<std::pair<std::uint32_t, int>> passed_;  ///< By the ray: triangles, with their signs.
  std::vector<std::uint32_t> stack_;
};

}  // namespace collision
