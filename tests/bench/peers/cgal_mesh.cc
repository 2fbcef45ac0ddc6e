// CGAL: its trees of boxes of one mesh, traversed together, with its exact predicates.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>

#include <memory>

#include "tests/bench/pairs/peers.h"

namespace collision::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

class Cgal {
 public:
  explicit Cgal(const PlainMesh& mesh) {
    std::vector<Mesh::Vertex_index> of;
    for (const auto& p : mesh.vertices) of.push_back(mesh_.add_vertex({p[0], p[1], p[2]}));
    for (const auto& t : mesh.triangles) {
      // Where the mesh is no manifold a triangle stays away: answers would show it.
      mesh_.add_face(of[t[0]], of[t[1]], of[t[2]]);
    }
    detection_.add_mesh(mesh_);
    detection_.add_mesh(mesh_);
  }

  bool Touching(const PlainPose& at) {
    const auto& r = at.rotation;
    const auto& p = at.offset;
    detection_.set_transformation(
        1, Kernel::Aff_transformation_3(r[0][0], r[0][1], r[0][2], p[0], r[1][0], r[1][1], r[1][2],
                                        p[1], r[2][0], r[2][1], r[2][2], p[2]));
    return !detection_.get_all_intersections(0).empty();
  }

 private:
  Mesh mesh_;
  CGAL::Rigid_triangle_mesh_collision_detection<Mesh> detection_;
};

}  // namespace

PairMethods CgalMesh(const PlainMesh& mesh) {
  const auto cgal = std::make_shared<Cgal>(mesh);
  const auto ask = [cgal](const PlainPose& at) { return Plain(cgal->Touching(at)); };
  return {{.name = "CGAL",
           .task = Task::kDecision,
           .limited_by = "nothing: exact predicates; the posed corners are rounded to doubles",
           .ask = ask}};
}

}  // namespace collision::bench
