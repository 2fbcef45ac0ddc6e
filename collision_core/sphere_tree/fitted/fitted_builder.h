// The fitted builder of sphere trees: balls that touch the surface from inside.
#pragma once

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/sphere_tree.h"
#include "collision_core/sphere_tree/tree_options.h"

namespace collision::sphere_tree {

/// Builds a tree with certified radii and signed distances. `kind` says whether the mesh is open or
/// closed. Deterministic. Takes about n log n time, 60 to 100 µs a triangle. Requires
/// IsWellFormed(mesh).
///
/// Why balls from inside. A ball may reach beyond the surface by r + s. On a patch of width w, a
/// ball about the patch itself does so by w / 2; a ball that touches it from inside, with its
/// centre at depth d, by w² / 8d or less. So centres are sought inside. A ball at c needs the
/// overshoot |x − c| + s(c) to contain a point x of the surface, and a ball's overshoot is the
/// largest that a point of its part needs: a k-centre problem with that cost (CoverSearch). The
/// search starts from the balls that touch the surface in some pieces and contain no surface
/// (shrinking balls), and bisects the overshoot for which a greedy cover exists. Then it repeats
/// these steps: assign each piece to the ball that needs the least overshoot for it; move a ball's
/// farthest pieces to balls that contain them already; move each centre; split the worst ball while
/// there are fewer than eight. What remains comes from sharp edges: a right-angled edge of length L
/// needs an overshoot of 0.354 L with any ball. An open surface has balls about the surface itself.
///
/// Parts. A node's part is whole triangles and halves of large ones (FittedPieces), each in *one*
/// child: so a fan round a corner, or copies upon each other, are shared out like anything else.
/// Where a ball fits to 5 % of its part's width the children keep its centre, and nothing is
/// searched. The first 700 nodes get their eight balls by way of three groups, so that a cut of any
/// size is even.
///
/// Certification. The search is in plain doubles and may be wrong. Afterwards radii are rounded up,
/// with kHalvingError for corners of halves. A centre is inside if its exact winding number says
/// so, or if it lies in the empty ball of its parent's centre. For a centre inside, certainly no
/// triangle is nearer than −`signed_distance`; for any other centre, `signed_distance` is an upper
/// bound of the distance. It may exceed the best bound by the larger of 1/256 of the overshoot and
/// 1/4096 of the part's width: near the medial axis thousands of triangles are nearly equally far,
/// and this slack saves measuring them.
///
/// Overshoot (max, mean) of a cut through this tree, divided by that of BuildCircumscribedOctree()
/// with as many balls, for five test meshes; in parentheses that number of balls, the finest level
/// of that octree with at most 700; in brackets the same ratio for BuildOctree():
///
///   cow (378)         0.12, 0.17   [0.35, 0.30]
///   fandisk (175)     0.25, 0.24   [0.39, 0.42]   sharp edges everywhere
///   homer (328)       0.08, 0.10   [0.22, 0.20]
///   rocker-arm (440)  0.11, 0.21   [0.31, 0.35]
///   spot (690)        0.13, 0.09   [0.33, 0.14]
SphereTree BuildFitted(const geometry::TriangleMesh& mesh, const ShapeOptions& options,
                       SurfaceKind kind);

}  // namespace collision::sphere_tree
